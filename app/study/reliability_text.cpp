#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "app/study/reliability.hpp"
#include "text/csv_table.hpp"

namespace voussoir {
namespace {

using Json = nlohmann::ordered_json;

constexpr double least_counted = 0.005;  // importance of a key that is named

// by drawn key, whose components are summed
std::vector<double> by_key(const DrawnKeys& drawn, const std::vector<double>& components) {
  std::vector<double> sums;
  std::size_t component = 0;
  for (const DrawnKey& key : drawn.keys) {
    sums.push_back(0);
    for (std::size_t k = 0; k < key.components(); ++k)
      sums.back() += components[component++];
  }
  return sums;
}

Json shares_json(const DrawnKeys& drawn, const std::vector<double>& components) {
  const std::vector<double> shares = by_key(drawn, components);
  Json json = Json::object();
  for (std::size_t k = 0; k < drawn.keys.size(); ++k)
    json[drawn.keys[k].key] = shares[k];
  return json;
}

// "clay.friction_deg 64 %, rough.friction_deg 36 %", the largest first
std::string shares_text(const DrawnKeys& drawn, const std::vector<double>& components, const char* word) {
  const std::vector<double> shares = by_key(drawn, components);
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < shares.size(); ++k)
    if (shares[k] >= least_counted) order.push_back(k);
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return shares[a] > shares[b]; });
  std::vector<std::string> texts;
  for (const std::size_t k : order)
    texts.push_back(fmt::format("{}{} {:.0f} %", short_name(drawn.keys[k].key), word, 100 * shares[k]));
  return fmt::format("{}", fmt::join(texts, ", "));
}

Json point_json(const DrawnKeys& drawn, const ReliabilityFound& found, std::size_t p) {
  const DesignPoint& point = found.points[p];
  Json values = Json::object();
  const std::vector<std::string> keys = drawn.scene_keys();
  for (std::size_t k = 0; k < keys.size(); ++k)
    values[keys[k]] = found.point_values[p][k];
  Json pieces = Json::array();
  for (const FailedHalfSpace& piece : point.pieces)
    pieces.push_back({{"direction", piece.direction}, {"distance", piece.distance}});
  return {{"beta", point.beta}, {"u", point.u},
          {"values", values},   {"importances", shares_json(drawn, found.importances[p])},
          {"mode", point.mode}, {"g", point.g},
          {"pieces", pieces},   {"iterations", point.iterations}};
}

std::map<std::string, int> answers_by_purpose(const ReliabilityFound& found) {
  std::map<std::string, int> counts;
  for (const ReliabilityRow& row : found.rows)
    ++counts[row.purpose];
  return counts;
}

}  // namespace

std::string reliability_json(const StudyPlan& plan, const Sweep& sweep, const ReliabilityFound& found) {
  const DrawnKeys& drawn = *sweep.drawn;
  Json json = {{"schema", "voussoir.reliability"},
               {"schema_version", 1},
               {"name", sweep.name},
               {"quantity", plan.quantity},
               {sweep.fails->below ? "fails_below" : "fails_above", sweep.fails->limit},
               {"method", sweep.reliability->method == ReliabilityMethod::form ? "form" : "importance"},
               {"seed", drawn.seed}};
  for (const DrawnKey& key : drawn.keys)
    json["keys"].push_back({{"key", key.key}, {"law", law_text(key)}, {"unit", key.pole ? "deg" : key.unit}});
  for (const CorrelatedPair& pair : drawn.correlated)
    json["correlation"].push_back(
        {{"components", {pair.a, pair.b}}, {"of_values", pair.of_values}, {"of_normals", pair.of_normals}});
  json["shared_draws"] = sharing_text(drawn);
  json["g_at_medians"] = found.g_at_medians;
  json["medians_fail"] = found.medians_fail;
  if (!found.variance_shares.empty()) json["variance_shares_at_medians"] = shares_json(drawn, found.variance_shares);
  json["failure"] = found.failure;
  json["warnings"] = found.warnings;
  if (found.failure.empty()) {
    json["beta"] = found.points.front().beta;
    if (found.first_order)
      json["first_order"] = {{"probability", *found.first_order}, {"checked", found.sampled.has_value()}};
    if (found.second_order)
      json["second_order"] = {{"breitung", found.second_order->breitung},
                              {"hohenbichler", found.second_order->hohenbichler},
                              {"curvatures", found.second_order->curvatures}};
    for (std::size_t p = 0; p < found.points.size(); ++p)
      json["design_points"].push_back(point_json(drawn, found, p));
    if (found.sampled)
      json["sampled"] = {{"probability", found.sampled->probability},
                         {"standard_error", found.sampled->error},
                         {"low", found.sampled->low},
                         {"high", found.sampled->high},
                         {"confidence", 0.95},
                         {"rows", found.sampled->rows},
                         {"without_answer", found.sampled->unanswered},
                         {"target_reached", found.sampled->reached}};
  }
  json["pilot_rows"] = found.pilots;
  json["answers"] = answers_by_purpose(found);
  return json.dump(2) + "\n";
}

std::string reliability_csv(const StudyPlan& plan, const Sweep& sweep, const ReliabilityFound& found) {
  const DrawnKeys& drawn = *sweep.drawn;
  std::vector<std::string> header{"answer", "purpose"};
  const std::vector<std::string> keys = drawn.scene_keys(), units = drawn.units();
  for (std::size_t k = 0; k < keys.size(); ++k)
    header.push_back(with_unit(keys[k], units[k]));
  for (std::size_t k = 0; k < drawn.components(); ++k)
    header.push_back(fmt::format("u{}", k + 1));
  header.insert(header.end(), {plan.quantity, "error_bar", "mode", "status", "weight"});
  std::string text = csv_line(header) + "\n";
  std::size_t weighted = 0;
  for (std::size_t r = 0; r < found.rows.size(); ++r) {
    const ReliabilityRow& row = found.rows[r];
    text += fmt::format("{},{}", r + 1, row.purpose);
    for (const double value : row.values)
      text += fmt::format(",{}", value);
    for (const double u : row.u)
      text += fmt::format(",{}", u);
    text += fmt::format(",{},{},{},{},", csv_cell(row.answer.value), csv_cell(row.answer.error_bar),
                        csv_cell(row.answer.mode), csv_cell(row.answer.status));
    if (row.purpose == "importance" && found.sampled)
      text += fmt::format("{}", found.sampled->history[weighted++].weight);
    text += "\n";
  }
  return text;
}

std::vector<std::string> reliability_lines(const Sweep& sweep, const ReliabilityFound& found) {
  const DrawnKeys& drawn = *sweep.drawn;
  std::string line = fmt::format("reliability '{}': ", sweep.name);
  if (!found.failure.empty()) return {line + "no probability: " + found.failure};
  const DesignPoint& nearest = found.points.front();
  if (found.sampled)
    line += fmt::format("p = {:.3g} (95 %: {:.3g} to {:.3g}), beta {:.4g}", found.sampled->probability,
                        found.sampled->low, found.sampled->high, nearest.beta);
  else if (found.first_order)
    line += fmt::format("beta {:.4g}, p = {:.3g} to first order; not checked", nearest.beta, *found.first_order);
  else
    line += fmt::format("beta {:.4g}; more than two pieces hold the design point: no first-order probability",
                        nearest.beta);
  const std::vector<std::string> keys = drawn.scene_keys(), units = drawn.units();
  line += " at ";
  for (std::size_t k = 0; k < keys.size(); ++k)
    line += fmt::format("{}{} {:.4g}{}", k ? ", " : "", short_name(keys[k]), found.point_values.front()[k],
                        units[k].empty() || units[k] == "1" ? "" : " " + units[k]);
  std::vector<std::string> lines{line};

  lines.push_back(fmt::format("  {}{}", shares_text(drawn, found.importances.front(), " counts"),
                              nearest.mode.empty() ? "" : "; mechanism: " + nearest.mode));
  if (!found.variance_shares.empty())
    lines.push_back("  of the variance at the medians: " + shares_text(drawn, found.variance_shares, ""));
  const std::size_t answers = found.rows.size();
  if (found.sampled)
    lines.push_back(
        fmt::format("  {} answers, {} of them importance sampling; {} design point{}, sought by {} pilot rows{}",
                    answers, found.sampled->rows, found.points.size(), found.points.size() == 1 ? "" : "s",
                    found.pilots, found.rows.back().answer.failed ? "; both are single trials at the limit" : ""));
  else
    lines.push_back(
        fmt::format("  {} answers; other mechanisms were not looked for (method = \"importance\" does)", answers));
  if (found.sampled && found.first_order) {
    std::string orders = fmt::format("  to first order {:.3g}", *found.first_order);
    if (found.second_order) orders += fmt::format(", to second order {:.3g}", found.second_order->hohenbichler);
    lines.push_back(orders);
  }
  if (const std::string shared = sharing_text(drawn); !shared.empty()) lines.push_back("  " + shared);
  for (const std::string& warning : found.warnings)
    lines.push_back("  " + warning);
  return lines;
}

}  // namespace voussoir
