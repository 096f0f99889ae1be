#include "app/study/found.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/key_blocks/mass_values.hpp"
#include "core/output/json_parts.hpp"
#include "core/scene/node.hpp"
#include "text/csv_table.hpp"
#include "text/plain_text.hpp"
#include "text/read_file.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

// more than any scene has
constexpr std::size_t most_columns = 100'000;

// the finite numbers of a column on the path to the result, without a search's rejected trials; empty if there is no
// such column
std::vector<double> column_of(const fs::path& history, const std::string& name) {
  const std::string text = read_file(history, largest_history);
  CsvReader reader(text, most_columns);
  const std::optional<std::size_t> place = reader.find(name), trial = reader.find("trial");
  std::vector<double> column;
  for (CsvRow row; place && reader.next(row);) {
    if (trial && row.cells[*trial].text != "0") continue;
    const std::string& cell = row.cells[*place].text;
    double number = 0;
    if (std::from_chars(cell.data(), cell.data() + cell.size(), number).ec == std::errc{} && std::isfinite(number))
      column.push_back(number);
  }
  return column;
}

std::optional<Value> taken(const fs::path& history, const HistoryQuantity& wanted) {
  const std::vector<double> column = column_of(history, wanted.column);
  if (column.empty()) return std::nullopt;
  switch (wanted.take) {
    case Take::largest:
      return Value{*std::max_element(column.begin(), column.end()), wanted.unit, {}, ""};
    case Take::smallest:
      return Value{*std::min_element(column.begin(), column.end()), wanted.unit, {}, ""};
    case Take::last:
      return Value{column.back(), wanted.unit, {}, ""};
  }
  return std::nullopt;
}

std::optional<Value> value_of(const nlohmann::json& values, const std::string& name) {
  if (!values.contains(name) || !values.at(name).at("value").is_number()) return std::nullopt;
  const nlohmann::json& entry = values.at(name);
  Value value{entry.at("value"), entry.at("unit"), {}, ""};
  if (entry.contains("error_bar") && entry.at("error_bar").is_number())
    value.error_bar = entry.at("error_bar").get<double>();
  value.divides = entry.value("divides", "");
  value.found_by = entry.value("found_by", "");
  for (auto& [key, number] : {std::pair{"bracket", &value.bracket}, {"bracket_middle", &value.bracket_middle}})
    if (entry.contains(key) && entry.at(key).is_number()) *number = entry.at(key).get<double>();
  return value;
}

RunFound found_in_json(const nlohmann::json& results, const fs::path& folder, const StudyPlan& plan) {
  RunFound found;
  const nlohmann::json program = results.value("program", nlohmann::json::object());
  found.origins = origins_of(program.value("origins", nlohmann::json::array()));
  if (results.contains("warnings"))
    for (const nlohmann::json& warning : results.at("warnings"))
      found.warnings.push_back(printable(warning.get<std::string>()));
  if (results.contains("counters")) {  // limit analysis takes no steps
    found.contact_evaluations = results.at("counters").at("contact_evaluations");
    found.steps = results.at("counters").at("steps");
    const nlohmann::json& seconds = results.at("timing").at("seconds");
    if (seconds.is_number()) found.seconds = seconds;
  }
  const std::string status = results.at("status");
  if (status != "done" &&
      !(plan.wide_brackets && results.at("values").contains(plan.quantity) && status == "incomplete")) {
    found.status = printable(status + ": " + results.at("message").get<std::string>());
    return found;
  }
  found.result =
      plan.history ? taken(folder / "history.csv", *plan.history) : value_of(results.at("values"), plan.quantity);
  if (!found.result)
    found.status = plan.history ? fmt::format("no column {} with numbers in history.csv", plan.history->column)
                   : results.at("schema") == "voussoir.blocks_values" ? "no block can move"
                                                                      : "no value of this name";
  return found;
}

}  // namespace

std::optional<std::string> missing_quantity(const fs::path& folder, const StudyPlan& plan) {
  const std::string& wanted = plan.history ? plan.history->column : plan.quantity;
  std::vector<std::string> names;
  try {
    const nlohmann::json results = nlohmann::json::parse(read_file(folder / "results.json", largest_results));
    if (results.at("status") != "done") return std::nullopt;
    if (plan.history) {
      const std::string text = read_file(folder / "history.csv", largest_history);
      const CsvReader reader(text, most_columns);
      for (const CsvCell& cell : reader.header())
        names.push_back(cell.text);
    } else {
      // a mass in which nothing moves has no factor
      if (results.at("schema") == "voussoir.blocks_values") names = names_of_mass_values();
      for (const auto& [name, value] : results.at("values").items())
        if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  } catch (const std::exception&) {
    return std::nullopt;  // damaged: its row reports it
  }
  if (std::find(names.begin(), names.end(), wanted) != names.end()) return "";
  return fmt::format("no run has {} '{}'; {}", plan.history ? "a column of history.csv" : "a value of results.json",
                     wanted, suggestion(wanted, names));
}

RunFound found_in(const fs::path& folder, const StudyPlan& plan) {
  const auto damaged = [&](const char* name) {
    return RunFound{.status = fmt::format("'{}' is damaged: remove it and study again", (folder / name).string())};
  };
  try {
    return found_in_json(nlohmann::json::parse(read_file(folder / "results.json", largest_results)), folder, plan);
  } catch (const nlohmann::json::exception&) {
    return damaged("results.json");
  } catch (const FileFault&) {
    return damaged("history.csv");
  } catch (const ReadFault& fault) {
    return {.status = fmt::format("results of '{}': {}", folder.string(), fault.what())};
  }
}

}  // namespace voussoir
