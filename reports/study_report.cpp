#include "reports/study_report.hpp"
#include "text/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace voussoir::reports {
namespace {

// s: study.csv has no finer resolution, and the figure's axis is a logarithm
constexpr double shortest_time = 1e-3;

double to_number(const std::string& text, const char* column, std::size_t line) {
  try {
    std::size_t used = 0;
    const double value = std::stod(text, &used);
    if (used == text.size()) return value;
  } catch (const std::exception&) {
  }
  throw std::runtime_error(fmt::format("study.csv, line {}: {} is '{}', not a number", line, column, text));
}

bool dominates(const StudyPoint& one, const StudyPoint& other, CostUnit unit) {
  const double error = one.relative_error_upper, other_error = other.relative_error_upper;
  const double cost = cost_of(one, unit), other_cost = cost_of(other, unit);
  return cost <= other_cost && error <= other_error && (cost < other_cost || error < other_error);
}

void mark_pareto_front(Study& study) {
  const CostUnit unit = cost_unit(study);
  for (StudyPoint& point : study.points)
    point.pareto = std::none_of(study.points.begin(), study.points.end(), [&](const StudyPoint& other) {
      return other.row.quantity == point.row.quantity && dominates(other, point, unit);
    });
}

Recommendation recommend(const Study& study, const std::string& quantity, double level) {
  const CostUnit unit = cost_unit(study);
  Recommendation best{quantity, level, std::nullopt};
  for (const StudyPoint& point : study.points) {
    if (point.row.quantity != quantity || point.relative_error_upper > level) continue;
    if (!best.cheapest || cost_of(point, unit) < cost_of(*best.cheapest, unit)) best.cheapest = point;
  }
  return best;
}

// by the error only: an error bar may follow a law of its own. Errors at the floor are off the line.
SweepOrder order_of(const Study& study, const std::string& quantity, const std::string& sweep) {
  SweepOrder found{quantity, sweep, "", std::nullopt};
  std::vector<KnobError> settings;
  for (const StudyPoint& point : study.points) {
    if (point.row.quantity != quantity || point.row.sweep != sweep) continue;
    found.key = point.row.key;
    const std::optional<double> value = point.row.number();
    if (value && *value > 0.0 && point.relative_error > relative_error_floor)
      settings.push_back({*value, point.relative_error});
  }
  found.order = observed_order(settings);
  return found;
}

// sweeps over numbers, not over words, nor the pairs that were extrapolated
bool has_an_order(const Study& study, const std::string& quantity, const std::string& sweep) {
  return std::any_of(study.points.begin(), study.points.end(), [&](const StudyPoint& point) {
    return point.row.quantity == quantity && point.row.sweep == sweep && point.row.number().has_value();
  });
}

// the promise of a level in a scene; empty for any other setting
std::optional<double> promise_of(const StudyRow& row) {
  if (row.key != level_key) return std::nullopt;
  for (std::size_t k = 0; k < accuracy_levels.size(); ++k)
    if (row.value == accuracy_levels[k]) return accuracy_promises[k];
  throw std::runtime_error(fmt::format("study.csv: there is no accuracy level '{}'", row.value));
}

// text from a csv file within a markdown table
std::string cell(const std::string& text) {
  std::string safe;
  for (const char character : text) {
    if (character == '|' || character == '*' || character == '<' || character == '`') safe += '\\';
    safe += character == '\n' ? ' ' : character;
  }
  return safe;
}

std::string setting(const StudyRow& row) {
  if (row.key.empty()) return "the scene as it is";
  const std::string unit = row.unit.empty() || row.unit == "1" ? "" : " " + row.unit;
  return fmt::format("`{} = {}`{}", row.key, row.value, unit);
}

std::string floored_percent(double fraction) {
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
                        cell(point.row.sweep), floored_percent(point.relative_error),
                        floored_percent(point.relative_error_upper), point.row.contact_evaluations, point.row.steps,
                        point.row.seconds);
  }
  return text;
}

std::string order_text(const ObservedOrder& order) {
  return fmt::format("{:.3f} ± {:.1g}", order.order, order.uncertainty);
}

std::string order_table(const Study& study, const std::string& quantity) {
  std::string text;
  for (const SweepOrder& entry : study.orders) {
    if (entry.quantity != quantity) continue;
    text += fmt::format("| {} | `{}` | ", cell(entry.sweep), entry.key);
    if (entry.order)
      text += fmt::format("{} | {} | {:g} to {:g} |\n", order_text(*entry.order), entry.order->count,
                          entry.order->coarsest, entry.order->finest);
    else
      text += "none: the error does not fall with it | | |\n";
  }
  if (text.empty()) return "";
  return "Observed order: error ~ value^order, by regression over the settings that converge, with two "
         "standard errors.\n\n| sweep | key | order | settings | from coarse to fine |\n|---|---|--:|--:|---|\n" +
         text + "\n";
}

std::string point_table(const Study& study, const std::string& quantity) {
  std::string text =
      "| sweep | setting | result | error | with error bar | contact evaluations | steps | seconds | Pareto front |\n"
      "|---|---|--:|--:|--:|--:|--:|--:|---|\n";
  for (const StudyPoint& point : study.points) {
    if (point.row.quantity != quantity) continue;
    text += fmt::format("| {} | {} | {:.7g} {} | {} | {} | {} | {} | {:.3g} | {} |\n", cell(point.row.sweep),
                        setting(point.row), *point.row.result, cell(point.row.result_unit),
                        floored_percent(point.relative_error), floored_percent(point.relative_error_upper),
                        point.row.contact_evaluations, point.row.steps, point.row.seconds, point.pareto ? "yes" : "");
  }
  return text;
}

std::vector<std::string> texts_of(const std::vector<CsvCell>& cells) {
  std::vector<std::string> texts;
  for (const CsvCell& cell : cells)
    texts.push_back(cell.text);
  return texts;
}

}  // namespace

std::vector<StudyRow> read_study(std::string_view csv) {
  const CsvTable table = parse_csv(csv);
  const std::vector<std::string> expected{"sweep",  "key",       "value",       "unit",   "quantity",
                                          "result", "error_bar", "result_unit", "status", "contact_evaluations",
                                          "steps",  "seconds"};
  const std::vector<std::string> found = texts_of(table.header);
  if (found != expected)
    throw std::runtime_error(
        fmt::format("study.csv has the columns '{}', expected '{}'", csv_line(found), csv_line(expected)));
  if (table.rows.empty()) throw std::runtime_error("study.csv has no rows");

  std::vector<StudyRow> rows;
  for (const CsvRow& line : table.rows) {
    const std::vector<std::string> record = texts_of(line.cells);
    const auto optional_number = [&](std::size_t column) -> std::optional<double> {
      if (record[column].empty()) return std::nullopt;
      const double value = to_number(record[column], expected[column].c_str(), line.line);
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

  mark_pareto_front(study);
  for (const std::string& quantity : study.quantities) {
    for (const double level : accuracy_promises)
      study.recommendations.push_back(recommend(study, quantity, level));
    for (const std::string& sweep : sweeps_of(study, quantity))
      if (has_an_order(study, quantity, sweep)) study.orders.push_back(order_of(study, quantity, sweep));
  }
  return study;
}

std::optional<double> StudyRow::number() const {
  double read = 0.0;
  const char* const end_of_text = value.data() + value.size();
  const auto [end, error] = std::from_chars(value.data(), end_of_text, read);
  const bool whole = error == std::errc{} && end == end_of_text;
  return whole && std::isfinite(read) ? std::optional(read) : std::nullopt;
}

CostUnit cost_unit(const Study& study) {
  const bool touches = std::any_of(study.points.begin(), study.points.end(),
                                   [](const StudyPoint& point) { return point.row.contact_evaluations > 0; });
  return touches ? CostUnit::contact_evaluations : CostUnit::steps;
}

const char* name_of(CostUnit unit) {
  return unit == CostUnit::steps ? "steps" : "contact evaluations";
}

double cost_of(const StudyPoint& point, CostUnit unit) {
  return static_cast<double>(unit == CostUnit::steps ? point.row.steps : point.row.contact_evaluations);
}

const StudyPoint* default_point(const Study& study, std::string_view quantity) {
  for (const StudyPoint& point : study.points)
    if (point.row.quantity == quantity && point.row.sweep == default_sweep) return &point;
  return nullptr;
}

std::string broken_promises(const Study& study) {
  std::string text;
  const auto add = [&](const StudyRow& row, const std::string& what) {
    text += fmt::format("{}level {} of {} {}", text.empty() ? "" : "; ", row.value, row.quantity, what);
  };
  for (const StudyPoint& point : study.points)
    if (const std::optional<double> promise = promise_of(point.row); promise && point.relative_error_upper > *promise)
      add(point.row,
          fmt::format("promises {:g} % and is {:.2g} % off", 100.0 * *promise, 100.0 * point.relative_error_upper));
  for (const StudyRow& row : study.failed)
    if (promise_of(row)) add(row, "failed: " + row.status);
  return text;
}

std::string study_points_csv(const Study& study) {
  std::string text =
      "quantity,sweep,key,value,contact_evaluations,relative_error,relative_error_upper,steps,seconds,pareto\n";
  for (const StudyPoint& point : study.points)
    text +=
        csv_line({point.row.quantity, point.row.sweep, point.row.key, point.row.value,
                  std::to_string(std::max(point.row.contact_evaluations, 1LL)), fmt::format("{}", point.relative_error),
                  fmt::format("{}", point.relative_error_upper), std::to_string(point.row.steps),
                  fmt::format("{}", std::max(point.row.seconds, shortest_time)), point.pareto ? "yes" : "no"}) +
        "\n";
  return text;
}

std::string study_markdown(const Study& study) {
  std::string text;
  for (const std::string& quantity : study.quantities) {
    text += fmt::format("### Accuracy and cost of {}\n\n", cell(quantity));
    text += fmt::format(
        "Cheapest setting that reaches each accuracy; cost is counted in {}, and a setting reaches an "
        "accuracy when its error plus its error bar does.\n\n",
        name_of(cost_unit(study)));
    text += recommendation_table(study, quantity);
    text += fmt::format(
        "\n![Error of {} against cost: one curve per sweep, settings on the Pareto front are ringed, "
        "bars reach up to error plus error bar. Errors below {:g} are drawn there.]({})\n\n",
        cell(quantity), relative_error_floor, study_figure_name(quantity));
    text += order_table(study, quantity) + point_table(study, quantity) + "\n";
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

nlohmann::json point_json(const StudyPoint& point, CostUnit unit) {
  return {{"sweep", point.row.sweep},
          {"key", point.row.key},
          {"value", point.row.value},
          {"unit", point.row.unit},
          {"relative_error", point.relative_error},
          {"relative_error_upper", point.relative_error_upper},
          {"cost", cost_of(point, unit)},
          {"contact_evaluations", point.row.contact_evaluations},
          {"steps", point.row.steps},
          {"seconds", point.row.seconds}};
}

nlohmann::json study_json(const Study& study) {
  const CostUnit unit = cost_unit(study);
  nlohmann::json json{{"cost_unit", name_of(unit)},
                      {"default", nullptr},
                      {"recommendations", nlohmann::json::array()},
                      {"points", nlohmann::json::array()},
                      {"pareto", nlohmann::json::array()},
                      {"orders", nlohmann::json::array()},
                      {"levels", nlohmann::json::array()},
                      {"failed", nlohmann::json::array()}};
  json["quantity"] = study.quantities.empty() ? "" : study.quantities.front();
  if (!study.quantities.empty())
    if (const StudyPoint* point = default_point(study, study.quantities.front()))
      json["default"] = point_json(*point, unit);
  for (const Recommendation& entry : study.recommendations)
    json["recommendations"].push_back(
        {{"level", entry.level}, {"cheapest", entry.cheapest ? point_json(*entry.cheapest, unit) : nlohmann::json()}});
  for (const StudyPoint& point : study.points)
    json["points"].push_back(point_json(point, unit));
  for (const StudyPoint& point : study.points)
    if (point.pareto) json["pareto"].push_back(point_json(point, unit));
  for (const SweepOrder& entry : study.orders) {
    nlohmann::json item{{"sweep", entry.sweep}, {"key", entry.key}, {"order", nullptr}};
    if (entry.order) {
      item["order"] = entry.order->order;
      item["uncertainty"] = entry.order->uncertainty;
      item["count"] = entry.order->count;
    }
    json["orders"].push_back(item);
  }
  for (const StudyPoint& point : study.points)
    if (const std::optional<double> promise = promise_of(point.row)) {
      json["levels"].push_back(point_json(point, unit));
      json["levels"].back()["promise"] = *promise;
    }
  for (const StudyRow& row : study.failed)
    json["failed"].push_back(
        {{"sweep", row.sweep}, {"key", row.key}, {"value", row.value}, {"unit", row.unit}, {"status", row.status}});
  return json;
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
