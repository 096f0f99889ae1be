#include "verification/verdicts.hpp"
#include "text/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace voussoir::verification {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

std::string plural(int number, std::string_view singular, std::string_view plural_form) {
  return fmt::format("{} {}", number, number == 1 ? singular : plural_form);
}

// a table cell in markdown must not contain a bar or a line end
std::string cell(std::string text) {
  std::string safe;
  for (const char character : text) {
    if (character == '|') safe += '\\';
    safe += character == '\n' ? ' ' : character;
  }
  return safe;
}

void read_listed_case(const fs::path& folder, const std::string& name, Verdicts& verdicts) {
  CaseStatus status{name, CaseState::not_run};
  const fs::path path = folder / (name + ".json");
  if (fs::exists(path)) {
    try {
      CaseFile file = read_case_file(path);
      if (file.case_name != name) throw std::runtime_error("the file is of case '" + file.case_name + "'");
      for (const auto& [test, message] : file.failures)
        verdicts.failures.push_back({name, test + ": " + message});
      if (!file.rows.empty()) status.state = CaseState::run;
      verdicts.rows.insert(verdicts.rows.end(), file.rows.begin(), file.rows.end());
    } catch (const std::exception& problem) {
      verdicts.failures.push_back({name, problem.what()});
    }
  }
  verdicts.cases.push_back(status);
}

}  // namespace

Verdicts collect(const fs::path& folder, const std::vector<std::string>& cases,
                 const std::vector<std::string>& not_modelled, const std::string& commit) {
  Verdicts verdicts{commit, {}, {}, {}, {}, {}};
  std::set<std::string> listed;
  for (const std::string& name : cases) {
    if (listed.insert(name).second)
      read_listed_case(folder, name, verdicts);
    else
      verdicts.failures.push_back({name, "the case is listed twice"});
  }
  for (const std::string& name : not_modelled) {
    if (!listed.insert(name).second) verdicts.failures.push_back({name, "both a case and not yet modelled"});
    verdicts.cases.push_back({name, CaseState::not_modelled});
    if (fs::exists(folder / (name + ".json")))
      verdicts.failures.push_back({name, "has verdict rows although it is listed as not yet modelled"});
  }

  // rows that no list names: a removed or misspelt case, which would otherwise vanish from the table
  std::vector<std::string> extra;
  if (fs::exists(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".json" && !listed.contains(entry.path().stem().string()))
        extra.push_back(entry.path().stem().string());
  std::sort(extra.begin(), extra.end());
  for (const std::string& name : extra)
    verdicts.failures.push_back(
        {name, fmt::format("verdict rows of a case that the build does not list; remove {}.json or list it", name)});
  return verdicts;
}

Counts count(const Verdicts& verdicts) {
  Counts counts;
  for (const Row& row : verdicts.rows)
    ++(row.check.kind == Kind::reported ? counts.reported : passed(row) ? counts.passed : counts.failed);
  counts.failed += static_cast<int>(verdicts.failures.size());
  for (const CaseStatus& status : verdicts.cases)
    counts.not_run += status.state == CaseState::not_run;
  return counts;
}

bool all_good(const Verdicts& verdicts) {
  const Counts counts = count(verdicts);
  return counts.failed == 0 && counts.not_run == 0 && counts.passed > 0;
}

const Moved* move_of(const Verdicts& verdicts, const Row& row) {
  for (const Moved& moved : verdicts.moved)
    if (moved.case_name == row.case_name && moved.quantity == row.check.quantity) return &moved;
  return nullptr;
}

std::string show_moved(const Moved* moved) {
  if (!moved) return "";
  if (moved->gone) return "gone, was " + show(moved->before);
  std::string text = moved->value ? fmt::format("was {:.9g}", moved->before) : "";
  if (moved->cost)
    text += fmt::format("{}{:+d} evaluations", text.empty() ? "" : ", ",
                        moved->evaluations_now - moved->evaluations_before);
  return text;
}

bool all_announced(const Verdicts& verdicts) {
  return std::all_of(verdicts.moved.begin(), verdicts.moved.end(), [](const Moved& moved) { return moved.announced; });
}

std::string one_line(const Verdicts& verdicts) {
  const Counts counts = count(verdicts);
  std::string text = fmt::format("{} passed, {} failed, {} not run", plural(counts.passed, "check", "checks"),
                                 counts.failed, plural(counts.not_run, "case", "cases"));
  if (!verdicts.moved.empty())
    text += fmt::format(", {} moved since {}", plural(static_cast<int>(verdicts.moved.size()), "row", "rows"),
                        verdicts.compared_with);
  return text;
}

const std::vector<VerdictGroup>& verdict_groups() {
  static const std::vector<VerdictGroup> groups{
      {"Verification",
       "Against closed forms, identities and limits: are the equations solved right?",
       {Kind::exact, Kind::limit}},
      {"Validation", "Against numbers published by others, with their uncertainty.", {Kind::published}},
      {"Drift", "Against our own earlier value: it shows \"moved\", never \"right\".", {Kind::drift}},
      {"Reported", "Numbers without a target; never judged.", {Kind::reported}}};
  return groups;
}

bool belongs_to(const Row& row, const VerdictGroup& group) {
  return std::find(group.kinds.begin(), group.kinds.end(), row.check.kind) != group.kinds.end();
}

std::string_view name_of(CaseState state) {
  switch (state) {
    case CaseState::run:
      return "run";
    case CaseState::not_run:
      return "not run";
    case CaseState::not_modelled:
      return "not yet modelled";
  }
  throw std::invalid_argument("a value outside CaseState");
}

std::string show(double value) {
  // fmt compares the number that it prints: under floating-point traps a NaN would end the program
  return std::isnan(value) ? "nan" : fmt::format("{:.6g}", value);
}

std::string show_expected(const Check& check) {
  switch (check.tolerance.bound) {
    case Bound::at_most:
      return "≤ " + show(check.expected);
    case Bound::at_least:
      return "≥ " + show(check.expected);
    case Bound::both:
      break;
  }
  return show(check.expected);
}

std::string verdict_markdown(const Verdicts& verdicts) {
  std::string text = fmt::format("# Verdicts\n\n{}. Commit {}.\n", one_line(verdicts), verdicts.commit);

  std::string open;
  for (const CaseStatus& status : verdicts.cases)
    if (status.state != CaseState::run) open += fmt::format("| {} | **{}** |\n", status.name, name_of(status.state));
  if (!open.empty()) text += "\n## Cases without rows\n\n| case | state |\n|---|---|\n" + open;

  if (!verdicts.failures.empty()) {
    text += "\n## Failures outside a check\n\n| case | failure |\n|---|---|\n";
    for (const Failure& failure : verdicts.failures)
      text += fmt::format("| {} | **FAILED** {} |\n", failure.case_name, cell(failure.message));
  }

  std::string gone;
  for (const Moved& moved : verdicts.moved)
    if (moved.gone)
      gone += fmt::format("| {} | {} | {} |\n", moved.case_name, cell(moved.quantity), show_moved(&moved));
  if (!gone.empty())
    text += fmt::format("\n## Rows of {} that are gone\n\n| case | quantity | change |\n|---|---|---|\n",
                        verdicts.compared_with) +
            gone;
  const std::string since = verdicts.compared_with.empty() ? "moved" : "moved since " + verdicts.compared_with;

  for (const VerdictGroup& group : verdict_groups()) {
    const bool judged = group.kinds.front() != Kind::reported;
    std::string lines;
    for (const Row& row : verdicts.rows) {
      if (!belongs_to(row, group)) continue;
      const Check& check = row.check;
      if (judged)
        lines += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.3g} | {} |\n", row.case_name,
                             cell(check.quantity), cell(check.unit), name_of(check.kind), show_expected(check),
                             show(row.computed), show(error_of(row)), show(width(check.expected, check.tolerance)),
                             fmt::format("{:.3g}", margin(row.computed, check)), passed(row) ? "passed" : "**FAILED**",
                             row.cost.contact_evaluations, row.cost.seconds, show_moved(move_of(verdicts, row)));
      else
        lines += fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.case_name, cell(check.quantity), cell(check.unit),
                             show(row.computed), cell(check.because), show_moved(move_of(verdicts, row)));
    }
    if (lines.empty()) continue;
    text += fmt::format("\n## {}\n\n{}\n\n", group.title, group.explanation);
    text += judged ? "| case | quantity | unit | kind | expected | computed | error | tolerance | margin | verdict | "
                     "contact evaluations | seconds | " +
                         since + " |\n|---|---|---|---|--:|--:|--:|--:|--:|---|--:|--:|---|\n"
                   : "| case | quantity | unit | value | note | " + since + " |\n|---|---|---|--:|---|---|\n";
    text += lines;
  }
  return text;
}

std::string verdict_csv(const Verdicts& verdicts) {
  std::string text =
      "case,quantity,unit,kind,source,expected,computed,error,tolerance,bound,margin,verdict,because,"
      "contact_evaluations,seconds,commit\n";
  const auto full = [](double value) { return fmt::format("{}", value); };
  for (const Row& row : verdicts.rows) {
    const Check& check = row.check;
    const bool judged = check.kind != Kind::reported;
    text += csv_line({row.case_name, check.quantity, check.unit, std::string(name_of(check.kind)), check.source,
                      judged ? full(check.expected) : "", full(row.computed), judged ? full(error_of(row)) : "",
                      judged ? full(width(check.expected, check.tolerance)) : "",
                      judged ? std::string(name_of(check.tolerance.bound)) : "",
                      judged ? full(margin(row.computed, check)) : "", verdict_of(row), check.because,
                      std::to_string(row.cost.contact_evaluations), full(row.cost.seconds), row.commit}) +
            "\n";
  }
  return text;
}

json verdict_json(const Verdicts& verdicts) {
  json text{
      {"commit", verdicts.commit}, {"cases", json::array()}, {"rows", json::array()}, {"failures", json::array()}};
  for (const CaseStatus& status : verdicts.cases)
    text["cases"].push_back({{"name", status.name}, {"state", name_of(status.state)}});
  for (const Row& row : verdicts.rows)
    text["rows"].push_back(to_json(row));
  for (const Failure& failure : verdicts.failures)
    text["failures"].push_back({{"case", failure.case_name}, {"message", failure.message}});
  text["compared_with"] = verdicts.compared_with;
  text["moved"] = json::array();
  for (const Moved& moved : verdicts.moved)
    text["moved"].push_back({{"case", moved.case_name},
                             {"quantity", moved.quantity},
                             {"unit", moved.unit},
                             {"before", moved.before},
                             {"now", moved.now},
                             {"evaluations_before", moved.evaluations_before},
                             {"evaluations_now", moved.evaluations_now},
                             {"value", moved.value},
                             {"cost", moved.cost},
                             {"gone", moved.gone},
                             {"announced", moved.announced}});
  return text;
}

Verdicts verdicts_from_json(const json& text) {
  try {
    Verdicts verdicts;
    text.at("commit").get_to(verdicts.commit);
    for (const json& entry : text.at("cases")) {
      const auto state = entry.at("state").get<std::string>();
      CaseStatus status{entry.at("name").get<std::string>(), CaseState::not_run};
      for (const CaseState known : {CaseState::run, CaseState::not_modelled})
        if (state == name_of(known)) status.state = known;
      verdicts.cases.push_back(status);
    }
    for (const json& row : text.at("rows"))
      verdicts.rows.push_back(row_from_json(row));
    for (const json& entry : text.at("failures"))
      verdicts.failures.push_back({entry.at("case").get<std::string>(), entry.at("message").get<std::string>()});
    text.at("compared_with").get_to(verdicts.compared_with);
    for (const json& entry : text.at("moved"))
      verdicts.moved.push_back({entry.at("case").get<std::string>(), entry.at("quantity").get<std::string>(),
                                entry.at("unit").get<std::string>(), entry.at("before").get<double>(),
                                entry.at("now").get<double>(), entry.at("evaluations_before").get<long long>(),
                                entry.at("evaluations_now").get<long long>(), entry.at("value").get<bool>(),
                                entry.at("cost").get<bool>(), entry.at("gone").get<bool>(),
                                entry.at("announced").get<bool>()});
    return verdicts;
  } catch (const json::exception& problem) {
    throw std::runtime_error(fmt::format("the verdicts are incomplete: {}", problem.what()));
  }
}

}  // namespace voussoir::verification
