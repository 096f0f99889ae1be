#include "reports/trade.hpp"
#include "text/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

namespace voussoir::reports {
namespace {

using nlohmann::json;

// one number of one case, for a summary over all
struct Named {
  std::string name;
  double value = 0.0;
};

bool is_compared(const CaseStudy& entry) {
  const json& scene = entry.study.at("default");
  return !scene.is_null() && scene.at("cost").get<double>() > 0.0;
}

// as a multiple of the cost of the scene as it is; empty if that is too little to be measured
std::optional<double> ratio(const CaseStudy& entry, const json& point, const char* what) {
  if (!is_compared(entry)) return std::nullopt;
  const double scene = entry.study.at("default").at(what).get<double>();
  if (!(scene > 0.0)) return std::nullopt;
  return point.at(what).get<double>() / scene;
}

std::string times(const std::optional<double>& value) {
  return value ? fmt::format("× {:.3g}", *value) : std::string("–");
}

std::string percent(double fraction) {
  return fmt::format("{:.2g} %", 100.0 * fraction);
}

std::string setting(const json& point) {
  if (point.at("key") == "") return "the scene as it is";
  const std::string unit = point.at("unit");
  return fmt::format("`{} = {}`{}", point.at("key").get<std::string>(), point.at("value").get<std::string>(),
                     unit.empty() || unit == "1" ? "" : " " + unit);
}

std::string link(const CaseStudy& entry) {
  return fmt::format("[{0}](../{0}/README.md)", entry.name);
}

// "0.5 (median; 0.1 in wedge, 3 in slump)"
std::string summary(const std::vector<Named>& list) {
  const auto by_value = [](const Named& a, const Named& b) { return a.value < b.value; };
  const auto [least, most] = std::minmax_element(list.begin(), list.end(), by_value);
  std::vector<double> values;
  for (const Named& entry : list)
    values.push_back(entry.value);
  if (list.size() == 1) return fmt::format("{:.2g} ({})", values.front(), list.front().name);
  return fmt::format("{:.2g} (median; from {:.2g} in {} to {:.2g} in {})", median(values), least->value, least->name,
                     most->value, most->name);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : ", ") + word;
  return text;
}

// the cheapest setting of a level, or null
const json& cheapest(const CaseStudy& entry, std::size_t level) {
  return entry.study.at("recommendations").at(level).at("cheapest");
}

std::string reading_of_level(const std::vector<CaseStudy>& studies, std::size_t level) {
  const double accuracy = studies.front().study.at("recommendations").at(level).at("level");
  std::vector<Named> costs;
  std::vector<std::string> missed, scenes;
  for (const CaseStudy& entry : studies) {
    const json& point = cheapest(entry, level);
    if (point.is_null()) {
      missed.push_back(entry.name);
      continue;
    }
    if (const auto cost = ratio(entry, point, "cost")) costs.push_back({entry.name, *cost});
    if (is_compared(entry) && entry.study.at("default").at("relative_error_upper").get<double>() <= accuracy)
      scenes.push_back(entry.name);
  }
  std::string text = fmt::format("- **{:g} %** is reached in {} of {} cases", 100.0 * accuracy,
                                 studies.size() - missed.size(), studies.size());
  if (!costs.empty()) text += ", for this multiple of the cost of the scene as it is: " + summary(costs);
  text += fmt::format(". The unchanged scenes reach it in {}.", scenes.size());
  if (!missed.empty()) text += fmt::format(" No setting tried reaches it in {}.", joined(missed));
  return text + "\n";
}

// the cost of each further digit if both ends are reached
std::string reading_of_digits(const std::vector<CaseStudy>& studies) {
  std::vector<Named> factors;
  std::vector<std::string> free;
  for (const CaseStudy& entry : studies) {
    const json &coarse = cheapest(entry, 0), &fine = cheapest(entry, 2);
    if (coarse.is_null() || fine.is_null() || !(coarse.at("cost").get<double>() > 0.0)) continue;
    factors.push_back({entry.name, fine.at("cost").get<double>() / coarse.at("cost").get<double>()});
    if (factors.back().value == 1.0) free.push_back(entry.name);
  }
  if (factors.empty()) return "";
  std::string text = "- From 5 % to 0.1 % the cost grows by this factor: " + summary(factors) + ".";
  if (!free.empty()) text += fmt::format(" In {} the cheapest setting of all reaches both.", joined(free));
  return text + "\n";
}

std::string cheapest_table(const std::vector<CaseStudy>& studies) {
  std::string text =
      "| case | quantity | accuracy | cheapest setting | error with error bar | contact evaluations | steps | seconds "
      "|\n|---|---|--:|---|--:|--:|--:|--:|\n";
  for (const CaseStudy& entry : studies) {
    const json& scene = entry.study.at("default");
    if (scene.is_null())
      text += fmt::format("| {} | {} | | **the scene failed as it is** | | | | |\n", link(entry),
                          entry.study.at("quantity").get<std::string>());
    else
      text += fmt::format("| {} | {} | | the scene as it is | {} | {} | {} | {:.2g} |\n", link(entry),
                          entry.study.at("quantity").get<std::string>(), percent(scene.at("relative_error_upper")),
                          scene.at("contact_evaluations").get<long long>(), scene.at("steps").get<long long>(),
                          scene.at("seconds").get<double>());
    for (const json& level : entry.study.at("recommendations")) {
      const std::string accuracy = fmt::format("{:g} %", 100.0 * level.at("level").get<double>());
      const json& point = level.at("cheapest");
      if (point.is_null())
        text += fmt::format("| | | {} | **none of the settings reaches it** | | | | |\n", accuracy);
      else
        text +=
            fmt::format("| | | {} | {} | {} | {} | {} | {} |\n", accuracy, setting(point),
                        percent(point.at("relative_error_upper")), times(ratio(entry, point, "contact_evaluations")),
                        times(ratio(entry, point, "steps")), times(ratio(entry, point, "seconds")));
    }
  }
  return text;
}

std::string order_table(const std::vector<CaseStudy>& studies) {
  std::string text = "| case | sweep | key | observed order | settings |\n|---|---|---|--:|--:|\n";
  for (const CaseStudy& entry : studies)
    for (const json& order : entry.study.at("orders")) {
      text += fmt::format("| {} | {} | `{}` | ", link(entry), order.at("sweep").get<std::string>(),
                          order.at("key").get<std::string>());
      if (order.at("order").is_null())
        text += "none | |\n";
      else
        text += fmt::format("{:.3f} ± {:.1g} | {} |\n", order.at("order").get<double>(),
                            order.at("uncertainty").get<double>(), order.at("count").get<int>());
    }
  return text;
}

std::string failure_table(const std::vector<CaseStudy>& studies) {
  std::string rows;
  for (const CaseStudy& entry : studies)
    for (const json& row : entry.study.at("failed"))
      rows += fmt::format("| {} | {} | {} | {} |\n", link(entry), row.at("sweep").get<std::string>(), setting(row),
                          row.at("status").get<std::string>());
  if (rows.empty()) return "None.\n";
  return "| case | sweep | setting | failure |\n|---|---|---|---|\n" + rows;
}

std::string level_table(const std::vector<CaseStudy>& studies) {
  std::string rows;
  for (const CaseStudy& entry : studies)
    for (const json& point : entry.study.at("levels"))
      rows += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", link(entry), point.at("value").get<std::string>(),
                          percent(point.at("promise")), percent(point.at("relative_error_upper")),
                          point.at("contact_evaluations").get<long long>(), point.at("steps").get<long long>(),
                          times(ratio(entry, point, "cost")));
  if (rows.empty()) return "";
  return "### Accuracy of the levels\n\n`[accuracy] level` in a scene sets the settings that the scene does not state. "
         "Here "
         "the levels are tested on the cases' own quantities; a level that misses its promise fails `make reports`.\n\n"
         "| case | level | promised | error with error bar | contact evaluations | steps | cost, scene as it is = 1 |\n"
         "|---|---|--:|--:|--:|--:|--:|\n" +
         rows + "\n";
}

// short name of a failure; its full text is in the table of settings that failed
std::string brief_status(const json& failure) {
  const std::string status = failure.at("status");
  return fmt::format("**{}**", status.substr(0, status.find(':')));
}

// every sweep over the number of points of a joint face, or over the integrated face contact
std::string points_table(const std::vector<CaseStudy>& studies) {
  const auto is_whole = [](const json& row) {
    return row.at("key") == "contact.face" && row.at("value") == "integrated";
  };
  const auto is_one = [&](const json& row) {
    return is_whole(row) || row.at("key").get<std::string>().ends_with(".sub_contacts");
  };
  const auto points = [&](const json& row) {
    return is_whole(row) ? "integrated" : row.at("value").get<std::string>();
  };
  std::string rows;
  for (const CaseStudy& entry : studies) {
    for (const json& row : entry.study.at("failed"))
      if (is_one(row))
        rows += fmt::format("| {} | {} | {} | {} | | | |\n", link(entry), row.at("sweep").get<std::string>(),
                            points(row), brief_status(row));
    for (const json& point : entry.study.at("points"))
      if (is_one(point))
        rows += fmt::format("| {} | {} | {} | {} | {} | {} | {:.2g} |\n", link(entry),
                            point.at("sweep").get<std::string>(), points(point),
                            percent(point.at("relative_error_upper")), point.at("contact_evaluations").get<long long>(),
                            point.at("steps").get<long long>(), point.at("seconds").get<double>());
  }
  if (rows.empty()) return "";
  return "### Points along a joint face\n\nWith one point a face resists neither spin nor, as a real face does, "
         "rocking. The table compares one point, several points and the integrated face contact (`contact.face`). A "
         "contact evaluation is counted once for any number of points, so their cost shows in the seconds only.\n\n"
         "| case | sweep | points along a face | error with error bar | contact evaluations | steps | seconds |\n"
         "|---|---|--:|--:|--:|--:|--:|\n" +
         rows + "\n";
}

// sweeps over the static solution method: "static solution: local damping"
constexpr std::string_view way_to_rest = "static solution: ";

// a column for each method, a row for each case; first the error, then the cost
std::string ways_table(const std::vector<CaseStudy>& studies) {
  struct Cell {
    std::string error, cost;
  };
  std::vector<std::string> marched, newton;
  std::vector<std::map<std::string, Cell>> cells(studies.size());
  const auto add = [&](std::size_t row, const json& setting, const Cell& cell) {
    const std::string sweep = setting.at("sweep");
    if (!sweep.starts_with(way_to_rest)) return;
    std::string way = sweep.substr(way_to_rest.size());
    const bool by_increments = setting.at("key") == "static_increments";
    if (by_increments) way += ", " + setting.at("value").get<std::string>();
    std::vector<std::string>& group = by_increments ? newton : marched;
    if (std::ranges::find(group, way) == group.end()) group.push_back(way);
    cells[row][way] = cell;
  };
  for (std::size_t row = 0; row < studies.size(); ++row) {
    for (const json& point : studies[row].study.at("points"))
      add(row, point,
          {percent(point.at("relative_error_upper")),
           fmt::format("{}", point.at("contact_evaluations").get<long long>())});
    for (const json& failure : studies[row].study.at("failed"))
      add(row, failure, {brief_status(failure), "–"});
  }
  std::vector<std::string> ways = marched;
  ways.insert(ways.end(), newton.begin(), newton.end());
  if (ways.empty()) return "";
  const auto table = [&](const std::string& what, auto member) {
    std::string text = "| " + what + " |", line = "|---|";
    for (const std::string& way : ways) {
      text += " " + way + " |";
      line += "--:|";
    }
    text += "\n" + line + "\n";
    for (std::size_t row = 0; row < studies.size(); ++row) {
      if (cells[row].empty()) continue;
      text += "| " + link(studies[row]) + " |";
      for (const std::string& way : ways)
        text += " " + cells[row][way].*member + " |";
      text += "\n";
    }
    return text + "\n";
  };
  return "### Static solution methods\n\nThe same scene by dynamic relaxation, by the true motion with Cundall's "
         "damping or with dashpots only, and by the implicit static solver (Newton–Raphson), with the number of "
         "increments of a "
         "ramp of gravity or a reduction of friction. Its evaluations include those that confirm equilibrium.\n\n" +
         table("error with error bar", &Cell::error) + table("contact evaluations", &Cell::cost);
}

}  // namespace

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values.at(half) : 0.5 * (values.at(half - 1) + values.at(half));
}

std::vector<std::string> compared_cases(const std::vector<CaseStudy>& studies) {
  std::vector<std::string> names;
  for (const CaseStudy& entry : studies)
    if (is_compared(entry)) names.push_back(entry.name);
  return names;
}

std::string trade_csv(const std::vector<CaseStudy>& studies) {
  std::string text = "case,relative_cost,relative_error\n";
  for (const CaseStudy& entry : studies) {
    if (!is_compared(entry)) continue;
    std::vector<std::pair<double, double>> points;
    for (const json& point : entry.study.at("pareto"))
      points.emplace_back(*ratio(entry, point, "cost"), point.at("relative_error_upper").get<double>());
    std::sort(points.begin(), points.end());
    for (const auto& [cost, error] : points)
      text += csv_line({entry.name, fmt::format("{}", cost), fmt::format("{}", error)}) + "\n";
  }
  return text;
}

std::string trade_markdown(const std::vector<CaseStudy>& studies) {
  if (studies.empty()) return "No study has a result.\n";
  std::string text = fmt::format(
      "Every study changes one setting of a case at a time and compares the result with the case's exact reference. "
      "Below are the settings that no other beats, for {} cases. Cost is counted in contact evaluations (in steps "
      "if nothing touches) as a multiple of the cost of the scene as it is; a setting reaches an accuracy when its "
      "error and its error bar together do. Seconds are those of runs side by side.\n\n"
      "![Error, error bar included, against cost, one line for each case: the settings that no other beats. At cost 1 "
      "is the scene as it is.](trade.svg)\n\n",
      studies.size());
  for (std::size_t level = 0; level < studies.front().study.at("recommendations").size(); ++level)
    text += reading_of_level(studies, level);
  text += reading_of_digits(studies) + "\n";
  text += "### The cheapest settings\n\n" + cheapest_table(studies) + "\n" + points_table(studies) +
          ways_table(studies) + level_table(studies);
  text +=
      "### Observed orders\n\nThe slope of log error over log setting where the error falls, with two standard errors; "
      "none if it does not fall beyond its scatter: the knob has no effect, or something else limits the error.\n\n" +
      order_table(studies) + "\n";
  return text + "### Settings that failed\n\n" + failure_table(studies);
}

}  // namespace voussoir::reports
