#include "app/commands/study_found.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

namespace voussoir {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> cells_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(stream, cell, ',');)
    cells.push_back(cell);
  return cells;
}

// the finite numbers of a column; empty where there is no such column
std::vector<double> column_of(const fs::path& history, const std::string& name) {
  std::ifstream file(history);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> names = cells_of(line);
  const auto place = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  std::vector<double> column;
  while (place < names.size() && std::getline(file, line)) {
    const std::vector<std::string> cells = cells_of(line);
    double number = 0;
    if (place >= cells.size()) continue;
    const std::string& cell = cells[place];
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
  return value;
}

RunFound found_in_json(const nlohmann::json& results, const fs::path& folder, const StudyPlan& plan) {
  RunFound found;
  found.contact_evaluations = results.at("counters").at("contact_evaluations");
  found.steps = results.at("counters").at("steps");
  const nlohmann::json& seconds = results.at("timing").at("seconds");
  if (seconds.is_number()) found.seconds = seconds;
  const std::string status = results.at("status");
  if (status != "done") {
    found.status = status + ": " + results.at("message").get<std::string>();
    return found;
  }
  found.result =
      plan.history ? taken(folder / "history.csv", *plan.history) : value_of(results.at("values"), plan.quantity);
  if (!found.result)
    found.status = plan.history ? fmt::format("no column {} with numbers in history.csv", plan.history->column)
                                : "no value of this name";
  return found;
}

}  // namespace

RunFound found_in(const fs::path& folder, const StudyPlan& plan) {
  const fs::path file = folder / "results.json";
  try {
    std::ifstream stream(file);
    return found_in_json(nlohmann::json::parse(stream), folder, plan);
  } catch (const nlohmann::json::exception&) {
    return {.status = fmt::format("'{}' is damaged: remove it and study again", file.string())};
  }
}

}  // namespace voussoir
