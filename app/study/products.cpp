#include "app/study/products.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/study/keys.hpp"

namespace voussoir {
namespace {

constexpr const char* rule_of_key = "must be a key of the scene as after --set, e.g. \"time.fraction\"";

constexpr double most_rows = 100'000;
constexpr double most_drawn = 5'000'000;  // by block theory

std::optional<Fails> read_fails(const Subject& table) {
  const Node* node = table.node->find("fails");
  if (!node) return std::nullopt;
  const std::string rule = "must be a table { below = … } or { above = … }";
  if (node->kind != Node::Kind::table) refuse(table, "fails", rule);
  const Subject fails{node, key_path(table.path, "fails")};
  refuse_unknown_keys(fails, "fails");
  const std::optional<double> below = number_of(fails, "below"), above = number_of(fails, "above");
  if (below.has_value() == above.has_value()) refuse(table, "fails", rule);
  return Fails{below.has_value(), below ? *below : *above};
}

std::vector<Subject> keys_of(const Subject& table, const char* kind) {
  const std::vector<Subject> keys = tables_of(table, "keys");
  if (keys.empty()) refuse(table, "keys", "must be a list of tables, each with a key of the scene");
  for (const Subject& key : keys)
    refuse_unknown_keys(key, kind);
  return keys;
}

TiedKey named_key(const Subject& table) {
  TiedKey key{text_of(table, "key", rule_of_key), {}, ""};
  if (table.node->find("unit")) key.unit = text_of(table, "unit", "must be a text, e.g. \"deg\"");
  return key;
}

// the keys of the scene with the values of the first rows drawn
void take_rows(int rows, Sweep& sweep) {
  const std::vector<std::string> names = sweep.drawn->scene_keys(), units = sweep.drawn->units();
  for (std::size_t k = 0; k < names.size(); ++k)
    sweep.with.push_back({names[k], {}, units[k]});
  for (int row = 1; row <= rows; ++row) {
    const std::vector<double> values = sweep.drawn->row(row);
    for (std::size_t k = 0; k < names.size(); ++k)
      sweep.with[k].values.push_back(fmt::format("{}", values[k]));
  }
}

}  // namespace

Sweep read_grid(const Subject& table) {
  refuse_unknown_keys(table, "grid");
  const std::vector<Subject> keys = keys_of(table, "grid.keys");
  if (keys.size() < 2 || keys.size() > 3) refuse(table, "keys", "must be two or three; one key alone is a [[sweep]]");
  Sweep grid;
  grid.varied = Varied::grid;
  std::vector<std::vector<std::string>> values;
  std::size_t count = 1;
  for (const Subject& key : keys) {
    grid.with.push_back(named_key(key));
    values.push_back(read_values(key));
    if (values.back().size() < 2) refuse(key, "values", "must be at least two");
    grid.counts.push_back(values.back().size());
    count *= values.back().size();
    grid.key += (grid.key.empty() ? "" : ", ") + grid.with.back().key;
  }
  if (static_cast<double>(count) > most_rows)
    refuse(table, "keys", fmt::format("make {} combinations; at most {:.0f} are taken", count, most_rows));
  for (std::size_t place = 0; place < count; ++place) {
    std::string label;
    for (std::size_t k = 0, left = count, at = place; k < keys.size(); ++k) {
      left /= grid.counts[k];
      const std::string& value = values[k][at / left];
      at %= left;
      grid.with[k].values.push_back(value);
      label += (label.empty() ? "" : ", ") + shown_value(value);
    }
    grid.values.push_back(label);
  }
  grid.numbers.resize(count);
  grid.fails = read_fails(table);
  return grid;
}

Sweep read_sample(const Subject& table) {
  refuse_unknown_keys(table, "sample");
  Sweep sample;
  sample.varied = Varied::sample;
  sample.key = "row of the sample";
  sample.drawn = read_drawn_keys(table);
  const std::optional<double> count = whole_number_of(table, "rows", 2, most_drawn);
  if (!count) refuse(table, "rows", "must be the number of runs, e.g. rows = 200");
  sample.drawn->rows = static_cast<int>(*count);
  const std::string rule = "must be \"random\" or \"latin\"";
  const std::string method = table.node->find("method") ? text_of(table, "method", rule) : "random";
  if (method != "random" && method != "latin") refuse(table, "method", rule);
  if (method == "latin") make_latin(*sample.drawn);
  sample.fails = read_fails(table);
  return sample;
}

Sweep read_reliability(const Subject& table) {
  refuse_unknown_keys(table, "reliability");
  Sweep analysis;
  analysis.varied = Varied::reliability;
  analysis.key = "reliability analysis";
  analysis.drawn = read_drawn_keys(table);
  for (const DrawnKey& key : analysis.drawn->keys) {
    if (!key.pole && key.law.law == Law::seed)
      refuse(table, "keys",
             fmt::format("draw the seed of '{}', which has no order; a reliability analysis needs one: use "
                         "[[sample]]",
                         key.key));
    if ((key.law.law == Law::normal || key.law.law == Law::lognormal) && !key.pole && key.law.deviation == 0)
      refuse(table, "keys", fmt::format("give '{}' a deviation of 0: it does not scatter; write it in set", key.key));
    if (key.per != DrawnPer::property)
      refuse(table, "per", "is for samples with blocks = {}; state joint_properties for each joint instead");
  }
  analysis.fails = read_fails(table);
  if (!analysis.fails) refuse(table, "fails", "must be a table { below = … } or { above = … }: what a failure is");
  ReliabilityPlan plan;
  const std::string rule = "must be \"importance\" or \"form\"";
  const std::string method = table.node->find("method") ? text_of(table, "method", rule) : "importance";
  if (method != "importance" && method != "form") refuse(table, "method", rule);
  if (method == "form") plan.method = ReliabilityMethod::form;
  plan.target = number_of(table, "target").value_or(plan.target);
  if (!(plan.target >= 0.001 && plan.target <= 1)) refuse(table, "target", "must be from 0.001 to 1");
  plan.most_rows = static_cast<int>(whole_number_of(table, "most_rows", 50, most_drawn).value_or(plan.most_rows));
  analysis.reliability = plan;
  take_rows(3, analysis);
  return analysis;
}

void draw_rows(const Subject& table, Sweep& sample) {
  const DrawnKeys& drawn = *sample.drawn;
  const bool in_process = sample.is_drawn_in_process();
  if (!in_process && drawn.rows > most_rows)
    refuse(table, "rows",
           fmt::format("must be a whole number, 2 to {:.0f}; with blocks = {{}} up to {:.0f}", most_rows, most_drawn));
  for (const DrawnKey& key : drawn.keys)
    if (key.per != DrawnPer::property && !in_process)
      refuse(table, "per", "is for samples with blocks = {}; state joint_properties for each joint instead");
  // of rows without a run of their own the first ones tell whether a key acts
  take_rows(in_process ? std::min(drawn.rows, 3) : drawn.rows, sample);
  if (!in_process)
    for (int row = 1; row <= drawn.rows; ++row)
      sample.values.push_back(std::to_string(row));
  sample.numbers.resize(sample.values.size());
}

}  // namespace voussoir
