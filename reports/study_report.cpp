#include "reports/study_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "verification/csv.hpp"

namespace voussoir::reports {
namespace {

using verification::csv_line;
using verification::parse_csv;

double to_number(const std::string& text, const char* column, std::size_t line) {
  try {
    std::size_t used = 0;
    const double value = std::stod(text, &used);
    if (used == text.size()) return value;
  } catch (const std::exception&) {
  }
  throw std::runtime_error(fmt::format("study.csv, line {}: {} is '{}', not a number", line, column, text));
}

double cost_of(const StudyPoint& point) {
  return static_cast<double>(point.row.contact_evaluations);
}

bool dominates(const StudyPoint& one, const StudyPoint& other) {
  const double error = one.relative_error_upper, other_error = other.relative_error_upper;
  return cost_of(one) <= cost_of(other) && error <= other_error &&
         (cost_of(one) < cost_of(other) || error < other_error);
}

void mark_pareto_front(std::vector<StudyPoint>& points) {
  for (StudyPoint& point : points)
    point.pareto = std::none_of(points.begin(), points.end(), [&](const StudyPoint& other) {
      return other.row.quantity == point.row.quantity && dominates(other, point);
    });
}

Recommendation recommend(const std::vector<StudyPoint>& points, const std::string& quantity, double level) {
  Recommendation best{quantity, level, std::nullopt};
  for (const StudyPoint& point : points) {
    if (point.row.quantity != quantity || point.relative_error_upper > level) continue;
    if (!best.cheapest || cost_of(point) < cost_of(*best.cheapest)) best.cheapest = point;
  }
  return best;
}

// text from a csv file that stands in a markdown table
std::string cell(const std::string& text) {
  std::string safe;
  for (const char character : text) {
    if (character == '|' || character == '*' || character == '<' || character == '`') safe += '\\';
    safe += character == '\n' ? ' ' : character;
  }
  return safe;
}

std::string setting(const StudyRow& row) {
  const std::string unit = row.unit.empty() || row.unit == "1" ? "" : " " + row.unit;
  return fmt::format("`{} = {}`{}", row.key, row.value, unit);
}

std::string percent(double fraction) {
  return fraction <= relative_error_floor ? fmt::format("≤ {:g} %", 100.0 * relative_error_floor)
                                          : fmt::format("{:.2g} %", 100.0 * fraction);
}

std::string recommendation_table(const Study& study, const std::string& quantity) {
  std::string text =
      "| accuracy | cheapest setting | sweep | error | with error bar | contact evaluations | steps | seconds |\n"
      "|--:|---|---|--:|--:|--:|--:|--:|\n";
  for (const Recommendation& entry : study.recommendations) {
    if (entry.quantity != quantity) continue;
    if (!entry.cheapest) {
      text += fmt::format("| {:g} % | **none of the settings reaches it** | | | | | | |\n", 100.0 * entry.level);
      continue;
    }
    const StudyPoint& point = *entry.cheapest;
    text += fmt::format("| {:g} % | {} | {} | {} | {} | {} | {} | {:.3g} |\n", 100.0 * entry.level, setting(point.row),
                        cell(point.row.sweep), percent(point.relative_error), percent(point.relative_error_upper),
                        point.row.contact_evaluations, point.row.steps, point.row.seconds);
  }
  return text;
}

std::string point_table(const Study& study, const std::string& quantity) {
  std::string text =
      "| sweep | setting | result | error | with error bar | contact evaluations | steps | seconds | Pareto front |\n"
      "|---|---|--:|--:|--:|--:|--:|--:|---|\n";
  for (const StudyPoint& point : study.points) {
    if (point.row.quantity != quantity) continue;
    text += fmt::format("| {} | {} | {:.7g} {} | {} | {} | {} | {} | {:.3g} | {} |\n", cell(point.row.sweep),
                        setting(point.row), *point.row.result, cell(point.row.result_unit),
                        percent(point.relative_error), percent(point.relative_error_upper),
                        point.row.contact_evaluations, point.row.steps, point.row.seconds, point.pareto ? "yes" : "");
  }
  return text;
}

}  // namespace

std::vector<StudyRow> read_study(std::string_view csv) {
  const auto records = parse_csv(csv);
  if (records.empty()) throw std::runtime_error("study.csv is empty");
  const std::vector<std::string> expected{"sweep",  "key",       "value",       "unit",   "quantity",
                                          "result", "error_bar", "result_unit", "status", "contact_evaluations",
                                          "steps",  "seconds"};
  if (records.front() != expected)
    throw std::runtime_error(
        fmt::format("study.csv has the columns '{}', expected '{}'", csv_line(records.front()), csv_line(expected)));
  if (records.size() < 2) throw std::runtime_error("study.csv has no rows");

  std::vector<StudyRow> rows;
  for (std::size_t i = 1; i < records.size(); ++i) {
    const auto& record = records[i];
    if (record.size() != expected.size())
      throw std::runtime_error(
          fmt::format("study.csv, line {}: {} fields, expected {}", i + 1, record.size(), expected.size()));
    const auto optional_number = [&](std::size_t column) -> std::optional<double> {
      if (record[column].empty()) return std::nullopt;
      const double value = to_number(record[column], expected[column].c_str(), i + 1);
      return std::isfinite(value) ? std::optional(value) : std::nullopt;
    };
    StudyRow row{record[0],          record[1], record[2], record[3], record[4], record[7],
                 optional_number(5), 0.0,       record[8], 0,         0,         0.0};
    row.error_bar = std::abs(optional_number(6).value_or(0.0));
    row.contact_evaluations = std::llround(optional_number(9).value_or(0.0));
    row.steps = std::llround(optional_number(10).value_or(0.0));
    row.seconds = optional_number(11).value_or(0.0);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::map<std::string, Reference> read_references(const nlohmann::json& text) {
  std::map<std::string, Reference> references;
  for (const auto& [quantity, entry] : text.items())
    references[quantity] = {entry.at("value").get<double>(), entry.at("unit").get<std::string>()};
  return references;
}

Study judge_study(const std::vector<StudyRow>& rows, const std::map<std::string, Reference>& references) {
  Study study;
  const auto note_once = [](std::vector<std::string>& list, const std::string& text) {
    if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
  };

  for (const StudyRow& row : rows) {
    // a failed setting is a finding of its own: listed, never drawn, never recommended
    if (row.status != "ok" || !row.result) {
      study.failed.push_back(row);
      continue;
    }
    const auto found = references.find(row.quantity);
    if (found == references.end()) {
      note_once(study.unjudged, fmt::format("{}: the case's test writes no reference number for it", row.quantity));
      continue;
    }
    const Reference& reference = found->second;
    if (reference.unit != row.result_unit)
      throw std::runtime_error(fmt::format("{} is in '{}' in the study but in '{}' in the reference", row.quantity,
                                           row.result_unit, reference.unit));
    if (reference.value == 0.0) {
      note_once(study.unjudged, fmt::format("{}: its reference is zero, so it has no relative error", row.quantity));
      continue;
    }
    const double scale = std::abs(reference.value);
    const double error = std::abs(*row.result - reference.value) / scale;
    note_once(study.quantities, row.quantity);
    study.points.push_back({row, std::max(error, relative_error_floor),
                            std::max(error + row.error_bar / scale, relative_error_floor), false});
  }
  if (study.points.empty() && !study.unjudged.empty())
    throw std::runtime_error("nothing in the study can be judged; " + study.unjudged.front());

  mark_pareto_front(study.points);
  for (const std::string& quantity : study.quantities)
    for (const double level : accuracy_levels)
      study.recommendations.push_back(recommend(study.points, quantity, level));
  return study;
}

std::string study_points_csv(const Study& study) {
  std::string text =
      "quantity,sweep,key,value,contact_evaluations,relative_error,relative_error_upper,steps,seconds,pareto\n";
  for (const StudyPoint& point : study.points)
    text +=
        csv_line({point.row.quantity, point.row.sweep, point.row.key, point.row.value,
                  std::to_string(std::max(point.row.contact_evaluations, 1LL)), fmt::format("{}", point.relative_error),
                  fmt::format("{}", point.relative_error_upper), std::to_string(point.row.steps),
                  fmt::format("{}", point.row.seconds), point.pareto ? "yes" : "no"}) +
        "\n";
  return text;
}

std::string study_markdown(const Study& study) {
  std::string text;
  for (const std::string& quantity : study.quantities) {
    text += fmt::format("### Accuracy and cost of {}\n\n", cell(quantity));
    text +=
        "Cheapest setting that reaches each accuracy; cost is counted in contact evaluations, and a setting reaches "
        "an accuracy when its error plus its error bar does.\n\n";
    text += recommendation_table(study, quantity);
    text += fmt::format(
        "\n![Error of {} against cost: one curve per sweep, settings on the Pareto front are ringed, "
        "bars reach up to error plus error bar. Errors below {:g} are drawn there.]({})\n\n",
        cell(quantity), relative_error_floor, study_figure_name(quantity));
    text += point_table(study, quantity) + "\n";
  }
  if (!study.failed.empty()) {
    text +=
        "### Settings that failed\n\n| sweep | setting | quantity | status | contact evaluations | steps |\n"
        "|---|---|---|---|--:|--:|\n";
    for (const StudyRow& row : study.failed)
      text +=
          fmt::format("| {} | {} | {} | **{}** | {} | {} |\n", cell(row.sweep), setting(row), cell(row.quantity),
                      cell(row.status == "ok" ? "no finite result" : row.status), row.contact_evaluations, row.steps);
    text += "\n";
  }
  for (const std::string& note : study.unjudged)
    text += fmt::format("Not judged: {}.\n\n", cell(note));
  return text;
}

nlohmann::json study_recommendations(const Study& study) {
  nlohmann::json list = nlohmann::json::array();
  for (const Recommendation& entry : study.recommendations) {
    nlohmann::json item{{"quantity", entry.quantity}, {"level", entry.level}, {"reached", entry.cheapest.has_value()}};
    if (entry.cheapest) {
      const StudyPoint& point = *entry.cheapest;
      item["sweep"] = point.row.sweep;
      item["key"] = point.row.key;
      item["value"] = point.row.value;
      item["relative_error"] = point.relative_error;
      item["relative_error_upper"] = point.relative_error_upper;
      item["contact_evaluations"] = point.row.contact_evaluations;
    }
    list.push_back(item);
  }
  return list;
}

std::vector<std::string> sweeps_of(const Study& study, std::string_view quantity) {
  std::vector<std::string> sweeps;
  for (const StudyPoint& point : study.points)
    if (point.row.quantity == quantity && std::find(sweeps.begin(), sweeps.end(), point.row.sweep) == sweeps.end())
      sweeps.push_back(point.row.sweep);
  return sweeps;
}

std::string study_figure_name(std::string_view quantity) {
  std::string name = "study_";
  for (const char character : quantity)
    name += std::isalnum(static_cast<unsigned char>(character)) ? character : '_';
  return name + ".svg";
}

}  // namespace voussoir::reports
