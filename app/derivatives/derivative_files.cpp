#include "app/derivatives/derivative_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/output/atomic_file.hpp"
#include "text/csv_table.hpp"

namespace voussoir {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::size_t most_lines_of_keys = 20;
constexpr double exact = 1e-12;        // bar of answers without one
constexpr std::size_t most_still = 6;  // keys that do not move the answer, listed by name
constexpr const char* held_sentence =
    "each with all other keys of the scene held: a water keeps its level, a plane its point";

// "1 deg", "10 kPa", "0.98 kPa": a change of the key in its shown unit, whose number it multiplies
std::string shown_change(const MovingKey& key) {
  const std::size_t space = key.shown_unit.find(' ');
  const double number = space == std::string::npos ? 1 : std::stod(key.shown_unit);
  const std::string unit = space == std::string::npos ? key.shown_unit : key.shown_unit.substr(space + 1);
  return fmt::format("{:.3g}{}", number * key.usual / key.shown, unit == "1" ? "" : " " + unit);
}

std::string derivative_unit(const DerivativeTable& table, const MovingKey& key) {
  return fmt::format("{} per {}", table.answer.unit, key.shown_unit);
}

OrderedJson number_or_null(const std::optional<double>& number) {
  return number ? OrderedJson(*number) : OrderedJson();
}

std::optional<double> shown(const std::optional<double>& derivative, const MovingKey& key) {
  if (!derivative) return {};
  return *derivative * key.shown;
}

// the bar of the value, or the larger one of both sides
double bar_of(const Derivative& derivative) {
  return derivative.value ? derivative.bar : std::max(derivative.below.bar, derivative.above.bar);
}

std::string value_shown(const DerivativeRow& row) {
  const double bar = bar_of(row.derivative);
  const auto slope = [&](double derivative) {
    return std::abs(derivative) <= bar ? "0" : fmt::format("{:+.5g}", derivative * row.key.shown);
  };
  if (row.refused) return "none";
  if (!row.derivative.value)
    return fmt::format("{} | {}", slope(*row.derivative.below.value), slope(*row.derivative.above.value));
  return slope(*row.derivative.value);
}

std::string trimmed_right(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

}  // namespace

std::string derivatives_text(const DerivativeTable& table) {
  if (!table.base.value) return fmt::format("what moves the answer: {}\n", table.base.reason);
  std::string text =
      fmt::format("what moves {} {:.6g}{} ({}): derivatives, {}\n", table.answer.name, *table.base.value,
                  table.answer.unit == "1" ? "" : " " + table.answer.unit, table.base.words, held_sentence);
  std::size_t widest = 10;
  const std::size_t lines = std::min(table.rows.size(), most_lines_of_keys);
  for (std::size_t k = 0; k < lines; ++k)
    widest = std::max(widest, table.rows[k].key.key.size());
  if (lines > 0)
    text += trimmed_right(fmt::format("  {:<{}}  {:>20}  {:<8}  {:<12}  {:>12}  {:>9}", "key", widest, "derivative",
                                      "±", "per", "usual change", "moves it"));
  for (std::size_t k = 0; k < lines; ++k) {
    const DerivativeRow& row = table.rows[k];
    text += trimmed_right(fmt::format(
        "  {:<{}}  {:>20}  {:<8}  {:<12}  {:>12}  {:>9}  {}", row.key.key, widest, value_shown(row),
        row.refused ? "" : fmt::format("{:.1g}", bar_of(row.derivative) * row.key.shown), row.key.shown_unit,
        shown_change(row.key), row.refused ? "" : fmt::format("{:+.3g}", row.change), row.remark));
  }
  if (lines < table.rows.size())
    text += fmt::format("  … {} more lines that move it less: {}\n", table.rows.size() - lines, derivatives_csv_file);
  if (!table.still.empty()) {
    const std::vector<std::string> named(table.still.begin(),
                                         table.still.begin() + std::min(table.still.size(), most_still));
    text += fmt::format(
        "  do not move it{}: {}{}\n",
        table.answer.bar > exact * std::abs(*table.base.value) ? " beyond its error bar" : "", fmt::join(named, "; "),
        named.size() < table.still.size() ? fmt::format(" and {} more", table.still.size() - named.size()) : "");
  }
  if (table.unfinished) text += "  interrupted: the keys that follow are missing\n";
  return text;
}

std::string derivatives_csv(const DerivativeTable& table) {
  std::string text = "key,unit,derivative,error_bar,below,above,usual_change,change_of_answer,remark\n";
  for (const DerivativeRow& row : table.rows) {
    const Derivative& found = row.derivative;
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_cell(row.key.key), csv_cell(derivative_unit(table, row.key)),
                    csv_cell(shown(found.value, row.key)), row.refused ? "" : csv_cell(bar_of(found) * row.key.shown),
                    csv_cell(shown(found.below.value, row.key)), csv_cell(shown(found.above.value, row.key)),
                    csv_cell(shown_change(row.key)), row.refused ? "" : csv_cell(row.change), csv_cell(row.remark));
  }
  return text;
}

std::string with_derivatives(const std::string& json, const DerivativeTable& table) {
  OrderedJson whole = OrderedJson::parse(json);
  OrderedJson rows = OrderedJson::array();
  for (const DerivativeRow& row : table.rows) {
    const Derivative& found = row.derivative;
    OrderedJson entry = {{"key", row.key.key},
                         {"value", row.key.value},
                         {"key_unit", row.key.unit},
                         {"unit", derivative_unit(table, row.key)},
                         {"derivative", number_or_null(shown(found.value, row.key))}};
    if (!row.refused) entry["error_bar"] = bar_of(found) * row.key.shown;
    if (found.below.value) entry["below"] = *found.below.value * row.key.shown;
    if (found.above.value) entry["above"] = *found.above.value * row.key.shown;
    entry["usual_change"] = shown_change(row.key);
    if (!row.refused) entry["change_of_answer"] = row.change;
    if (!row.remark.empty()) entry["remark"] = row.remark;
    rows.push_back(entry);
  }
  OrderedJson object = {{"of", table.answer.name}, {"unit", table.answer.unit}};
  if (table.base.value) {
    object["value"] = *table.base.value;
    object["mechanism"] = table.base.words;
    object["held"] = held_sentence;
    object["answers"] = table.answers;
    object["complete"] = !table.unfinished;
    object["keys"] = rows;
    object["do_not_move_it"] = table.still;
    for (const TrialTangent& trial : table.way)
      object["way_to_collapse"].push_back({{"level", trial.level},
                                           {"smallest_singular_value", trial.smallest},
                                           {"second_singular_value", trial.second}});
    for (const BlockAtCollapse& motion : table.motion)
      object["motion_at_collapse"].push_back(
          {{"block", motion.block}, {"displacement", motion.displacement}, {"rotation_rad", motion.rotation}});
  } else {
    object["message"] = table.base.reason;
  }
  whole["derivatives"] = object;
  const int indent = json.starts_with("{\n  ") ? 2 : 1;
  return whole.dump(indent, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

void write_derivatives(const DerivativeTable& table, const std::filesystem::path& folder) {
  write_file(folder / derivatives_csv_file, derivatives_csv(table));
  write_file(folder / derivatives_svg_file, derivatives_svg(table));
}

}  // namespace voussoir
