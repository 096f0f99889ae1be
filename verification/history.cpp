#include "verification/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "text/csv_table.hpp"

namespace voussoir::verification {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

using Key = std::pair<std::string, std::string>;  // case, quantity

// 0.10.0 comes after 0.9.0
std::vector<int> numbers_of(const std::string& version) {
  std::vector<int> numbers;
  const char* at = version.data();
  const char* const end = at + version.size();
  while (at < end) {
    int number = 0;
    const auto [next, problem] = std::from_chars(at, end, number);
    if (problem != std::errc{} || (next < end && *next != '.'))
      throw std::runtime_error(fmt::format("'{}' is not a version such as 1.2.3", version));
    numbers.push_back(number);
    at = next < end ? next + 1 : end;
  }
  return numbers;
}

PastRow past_row(const json& line) {
  PastRow row;
  line.at("case").get_to(row.case_name);
  line.at("quantity").get_to(row.quantity);
  line.at("unit").get_to(row.unit);
  line.at("value").get_to(row.value);
  if (line.contains("error")) row.error = line.at("error").get<double>();
  line.at("contact_evaluations").get_to(row.contact_evaluations);
  line.at("seconds").get_to(row.seconds);
  return row;
}

PastVersion read_version(const fs::path& file) {
  PastVersion past{file.stem().string(), "", {}};
  std::istringstream lines(read_text(file));
  std::string text;
  for (int line = 1; std::getline(lines, text); ++line)
    try {
      const json stored = json::parse(text);
      if (line == 1)
        stored.at("math_functions").get_to(past.math_functions);
      else
        past.rows.push_back(past_row(stored));
    } catch (const json::exception& problem) {
      throw std::runtime_error(
          fmt::format("{}:{}: not a row of the history: {}", file.filename().string(), line, problem.what()));
    }
  return past;
}

std::map<Key, const PastRow*> by_key(const PastVersion& past) {
  std::map<Key, const PastRow*> rows;
  for (const PastRow& row : past.rows)
    rows[{row.case_name, row.quantity}] = &row;
  return rows;
}

double tolerance_of(const Row& row) {
  return row.check.kind == Kind::reported ? 0.0 : width(row.check.expected, row.check.tolerance);
}

bool value_moved(double before, const Row& now) {
  if (!std::isfinite(now.computed)) return true;
  const double rounding = std::max(rounding_share * std::max(std::abs(before), std::abs(now.computed)),
                                   tolerance_share * tolerance_of(now));
  return std::abs(now.computed - before) > rounding;
}

// the first section of a changelog: the next version
std::string_view newest(std::string_view changelog) {
  const auto begin = changelog.find("## ");
  if (begin == std::string_view::npos) return {};
  const auto end = changelog.find("\n## ", begin);
  return changelog.substr(begin, end == std::string_view::npos ? end : end - begin);
}

std::vector<std::string> words_in_backticks(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t open = line.find('`'); open != std::string_view::npos; open = line.find('`', open + 1)) {
    const auto close = line.find('`', open + 1);
    if (close == std::string_view::npos) break;
    words.emplace_back(line.substr(open + 1, close - open - 1));
    open = close;
  }
  return words;
}

}  // namespace

std::vector<PastVersion> read_history(const fs::path& folder) {
  std::vector<PastVersion> history;
  if (!fs::exists(folder)) return history;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".jsonl") history.push_back(read_version(entry.path()));
  std::sort(history.begin(), history.end(),
            [](const PastVersion& a, const PastVersion& b) { return numbers_of(a.version) < numbers_of(b.version); });
  return history;
}

std::string math_functions_in(std::string_view version_text) {
  constexpr std::string_view name = "math functions";
  const auto begin = version_text.find(name);
  if (begin == std::string_view::npos) return {};
  const auto first = version_text.find_first_not_of(' ', begin + name.size());
  if (first == std::string_view::npos) return {};
  return std::string(version_text.substr(first, version_text.find_first_of(", \n", first) - first));
}

std::string history_lines(const Verdicts& verdicts, const std::string& math_functions) {
  if (!all_good(verdicts)) throw std::runtime_error("a version whose checks do not all pass is not kept");
  std::string text = json{{"math_functions", math_functions}}.dump() + "\n";
  for (const Row& row : verdicts.rows) {
    if (!std::isfinite(row.computed)) continue;
    nlohmann::ordered_json line{
        {"case", row.case_name}, {"quantity", row.check.quantity}, {"unit", row.check.unit}, {"value", row.computed}};
    if (row.check.kind != Kind::reported) line["error"] = error_of(row);
    line["contact_evaluations"] = row.cost.contact_evaluations;
    line["seconds"] = row.cost.seconds;
    text += line.dump() + "\n";
  }
  return text;
}

std::vector<Moved> moved_since(const PastVersion& past, const Verdicts& verdicts) {
  std::vector<Moved> moved;
  auto left = by_key(past);
  for (const Row& row : verdicts.rows) {
    const auto found = left.find({row.case_name, row.check.quantity});
    if (found == left.end()) continue;
    const PastRow& before = *found->second;
    Moved change{row.case_name,
                 row.check.quantity,
                 row.check.unit,
                 before.value,
                 row.computed,
                 before.contact_evaluations,
                 row.cost.contact_evaluations};
    change.value = !row.check.by_the_clock && value_moved(before.value, row);
    change.cost = before.contact_evaluations != row.cost.contact_evaluations;
    if (change.value || change.cost) moved.push_back(std::move(change));
    left.erase(found);
  }
  for (const PastRow& row : past.rows)
    if (left.contains({row.case_name, row.quantity})) {
      moved.push_back({row.case_name, row.quantity, row.unit, row.value, 0.0, row.contact_evaluations, 0});
      moved.back().gone = true;
    }
  return moved;
}

std::vector<std::string> mark_announced(std::vector<Moved>& moved, std::string_view changelog) {
  std::vector<std::string> idle;
  std::istringstream lines{std::string(newest(changelog))};
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("- Moved:")) continue;
    const auto words = words_in_backticks(line);
    bool fits = false;
    for (Moved& change : moved)
      if (!words.empty() && change.case_name == words[0] && (words.size() < 2 || change.quantity == words[1]))
        fits = change.announced = true;
    if (!fits) idle.push_back(line);
  }
  return idle;
}

std::string describe(const Moved& moved, const std::string& version) {
  const std::string unit = moved.unit == "1" ? "" : " " + moved.unit;
  std::string text = fmt::format("{}: {}", moved.case_name, moved.quantity);
  if (moved.gone) return text + fmt::format(": is gone, was {:.9g}{} in {}", moved.before, unit, version);
  if (moved.value) text += fmt::format(": {:.9g}{}, was {:.9g} in {}", moved.now, unit, moved.before, version);
  if (moved.cost)
    text += fmt::format(": {} contact evaluations, were {} in {}", moved.evaluations_now, moved.evaluations_before,
                        version);
  return text;
}

std::string history_csv(const std::vector<PastVersion>& history, const Verdicts& verdicts) {
  std::string text = "case,quantity,place,version,change,moved\n";
  std::vector<std::map<Key, const PastRow*>> past;
  for (const PastVersion& version : history)
    past.push_back(by_key(version));
  const auto line = [&](const std::string& name, const std::string& quantity, std::size_t place, double change,
                        bool moved) {
    text += csv_line({name, quantity, std::to_string(place), place < history.size() ? history[place].version : "now",
                      csv_cell(change), moved ? "1" : "0"}) +
            "\n";
  };

  std::map<std::string, std::vector<long long>> costs;  // of a case, by place
  for (const Row& row : verdicts.rows) {
    auto& cost = costs.try_emplace(row.case_name, past.size() + 1).first->second;
    cost.back() = std::max(cost.back(), row.cost.contact_evaluations);
    for (std::size_t place = 0; place < past.size(); ++place) {
      const auto found = past[place].find({row.case_name, row.check.quantity});
      if (found == past[place].end()) continue;
      cost[place] = std::max(cost[place], found->second->contact_evaluations);
      if (row.check.by_the_clock || !std::isfinite(row.computed)) continue;
      const double scale = std::max(std::abs(row.computed), tolerance_of(row));
      const double change = found->second->value - row.computed;
      line(row.case_name, row.check.quantity, place, scale > 0.0 ? change / scale : change,
           value_moved(found->second->value, row));
    }
    if (!row.check.by_the_clock) line(row.case_name, row.check.quantity, past.size(), 0.0, false);
  }
  for (const CaseStatus& status : verdicts.cases)
    if (const auto found = costs.find(status.name); found != costs.end() && found->second.back() > 0)
      for (std::size_t place = 0; place < found->second.size(); ++place)
        if (const auto evaluations = static_cast<double>(found->second[place]); evaluations > 0.0)
          line(status.name, history_cost, place, evaluations / static_cast<double>(found->second.back()) - 1.0,
               found->second[place] != found->second.back());
  return text;
}

}  // namespace voussoir::verification
