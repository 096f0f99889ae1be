#include "app/study/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/limit/limit_loads.hpp"
#include "app/study/keys.hpp"
#include "app/study/products.hpp"
#include "core/scene/scene_text.hpp"
#include "core/scene/toml_text.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

std::optional<HistoryQuantity> read_history(const Subject& top) {
  const Node* node = top.node->find("history");
  if (!node) return std::nullopt;
  if (node->kind != Node::Kind::table)
    refuse(top, "history", "must be a table { column = …, take = \"largest\", unit = … }");
  const Subject table{node, "history"};
  refuse_unknown_keys(table, "history");
  HistoryQuantity quantity;
  quantity.column = text_of(table, "column", "must name a column of history.csv");
  quantity.unit = text_of(table, "unit", "must be a text, e.g. \"N\"");
  const std::string rule = "must be one of \"largest\", \"smallest\", \"last\"";
  const std::string& take = text_of(table, "take", rule);
  if (take == "largest")
    quantity.take = Take::largest;
  else if (take == "smallest")
    quantity.take = Take::smallest;
  else if (take != "last")
    refuse(table, "take", rule);
  return quantity;
}

std::vector<TiedKey> read_tied(const Subject& sweep, std::size_t count) {
  std::vector<TiedKey> tied;
  for (const Subject& table : tables_of(sweep, "with")) {
    refuse_unknown_keys(table, "with");
    tied.push_back({text_of(table, "key", "must be a key of the scene as after --set, e.g. \"time.fraction\""),
                    read_values(table)});
    if (tied.back().values.size() != count)
      refuse(table, "values",
             fmt::format("must be {} values, as many as the sweep's own: they change together", count));
  }
  return tied;
}

bool flag_of(const Subject& table, const char* key) {
  const Node* node = table.node->find(key);
  if (node && node->kind != Node::Kind::boolean) refuse(table, key, "must be true or false");
  return node && node->boolean;
}

// the options are those of `voussoir limit`, which checks their combination itself
std::optional<OtherCommand> read_limit(const Subject& table) {
  const Node* node = table.node->find("limit");
  if (!node) return std::nullopt;
  if (node->kind != Node::Kind::table)
    refuse(table, "limit",
           "must be a table, e.g. limit = { load = \"right\" }, or limit = {} for the critical friction");
  const Subject limit{node, key_path(table.path, "limit")};
  refuse_unknown_keys(limit, "limit");
  std::vector<std::string> options;
  if (node->find("load")) {
    const std::string& load = text_of(limit, "load", limit_load_rule());
    if (!limit_load(load)) refuse(limit, "load", limit_load_rule());
    options = {"--load", load};
  }
  const bool factor = flag_of(limit, "factor");
  for (const char* key : {"load", "friction"})
    if (factor && node->find(key)) refuse(limit, key, "contradicts factor = true; state one of them");
  if (node->find("load") && node->find("friction")) refuse(limit, "friction", "contradicts load; state one of them");
  if (!factor && node->find("joint"))
    refuse(limit, "joint", "names the properties that factor = true divides; state factor = true as well");
  if (factor) options.emplace_back("--factor");
  if (flag_of(limit, "cohesion")) options.emplace_back("--cohesion");
  if (flag_of(limit, "with_dilation")) options.emplace_back("--with-dilation");
  if (flag_of(limit, "decide")) options.emplace_back("--decide");
  for (const char* key : {"friction", "joint"})
    for (const std::string& name : texts_of(limit, key, "must be a list of names of joint_properties"))
      options.insert(options.end(), {fmt::format("--{}", key), name});
  return OtherCommand{"limit", options};
}

// likewise of `voussoir blocks`
std::optional<OtherCommand> read_blocks(const Subject& table) {
  const Node* node = table.node->find("blocks");
  if (!node) return std::nullopt;
  if (node->kind != Node::Kind::table)
    refuse(table, "blocks", "must be a table, e.g. blocks = { after = \"tunnel\" }, or blocks = {}");
  const Subject blocks{node, key_path(table.path, "blocks")};
  refuse_unknown_keys(blocks, "blocks");
  std::vector<std::string> options;
  for (const auto& [key, option] : {std::pair{"strength_of", "--strength-of"}, {"after", "--after"}})
    if (node->find(key))
      options.insert(options.end(), {option, text_of(blocks, key, "must name a stage of the scene")});
  if (node->find("seismic"))
    options.insert(options.end(),
                   {"--seismic", text_of(blocks, "seismic", "must be a text as after --seismic, e.g. \"0.12/180\"")});
  return OtherCommand{"blocks", options};
}

std::optional<OtherCommand> read_other(const Subject& table) {
  if (table.node->find("limit") && table.node->find("blocks"))
    refuse(table, "blocks", "contradicts limit; state one of them");
  const std::optional<OtherCommand> limit = read_limit(table);
  return limit ? limit : read_blocks(table);
}

void read_numbers(const Subject& table, Sweep& sweep) {
  for (const Node& item : table.node->find("values")->items)
    sweep.numbers.push_back(item.is_number() ? std::optional(item.number) : std::nullopt);
}

void read_extrapolation(const Subject& table, Sweep& sweep) {
  const Node* node = table.node->find("extrapolate");
  if (!node) return;
  if (node->kind != Node::Kind::table)
    refuse(table, "extrapolate", "must be a table, e.g. extrapolate = { power = 0.6666667 }");
  const Subject extrapolate{node, key_path(table.path, "extrapolate")};
  refuse_unknown_keys(extrapolate, "extrapolate");
  const Node* power = node->find("power");
  if (!power || !power->is_number() || !(power->number > 0 && power->number <= 10))
    refuse(extrapolate, "power", "must be a number above 0, at most 10");
  sweep.power = power->number;

  const bool fit = sweep.numbers.size() > 1 &&
                   std::all_of(sweep.numbers.begin(), sweep.numbers.end(), [](const auto& v) { return v && *v > 0; });
  if (!fit) refuse(table, "values", "must be at least two numbers above 0 to be extrapolated to 0");
  for (std::size_t k = 1; k < sweep.numbers.size(); ++k)
    if (*sweep.numbers[k] == *sweep.numbers[k - 1])
      refuse(table, "values", "must differ from one to the next to be extrapolated");
}

Sweep read_sweep(const Subject& table) {
  refuse_unknown_keys(table, "sweep");
  Sweep sweep;
  sweep.key = text_of(table, "key", "must be a key of the scene as after --set, e.g. \"time.fraction\"");
  if (table.node->find("unit")) sweep.unit = text_of(table, "unit", "must be a text, e.g. \"deg\"");
  sweep.values = read_values(table);
  read_numbers(table, sweep);
  sweep.with = read_tied(table, sweep.values.size());
  read_extrapolation(table, sweep);
  return sweep;
}

// the keys that sweeps, grids and samples share
void read_common(const Subject& table, const std::string& scene, const fs::path& folder, Sweep& sweep) {
  sweep.name = text_of(table, "name", "must be a text: its name in the table and the figure");
  sweep.scene = folder / scene;
  if (table.node->find("scene"))
    sweep.scene = folder / text_of(table, "scene", "must be a scene's file name, relative to the study");
  sweep.other = read_other(table);
  sweep.overrides = read_overrides(table);
}

// [[sweep]] and its like
std::vector<Subject> headed_tables(const Subject& top, const std::string& key) {
  const Node* list = top.node->find(key);
  if (!list) return {};
  const std::string rule = fmt::format("must be a table; begin it with [[{}]]", key);
  if (list->kind != Node::Kind::list || list->items.empty()) refuse(top, key, rule);
  for (const Node& item : list->items)
    if (item.kind != Node::Kind::table) refuse(item, key, rule);
  return children(top, key);
}

}  // namespace

StudyPlan read_study_plan(const fs::path& path) {
  const Node tree = parse_toml(file_text(path), std::make_shared<const std::string>(path.string()));
  require_plain_text(tree, "");
  const Subject top{&tree, ""};
  refuse_unknown_keys(top, "");
  const std::string scene = text_of(top, "scene", "must be a scene's file name, relative to the study");
  StudyPlan plan;
  plan.quantity = text_of(top, "quantity", "must name a value of results.json, e.g. \"critical_friction\"");
  plan.history = read_history(top);
  if (top.node->find("begin")) plan.begin = text_of(top, "begin", "must name a stage of the scene, e.g. \"stress\"");

  // the reference run, with which all others are compared, comes first
  const fs::path folder = path.parent_path();
  plan.sweeps.push_back({.name = "default", .values = {""}, .numbers = {std::nullopt}, .scene = folder / scene});
  using Read = Sweep (*)(const Subject&);
  std::vector<std::pair<std::size_t, Subject>> samples;
  for (const auto& [key, read] : {std::pair<const char*, Read>{"sweep", read_sweep},
                                  {"grid", read_grid},
                                  {"sample", read_sample},
                                  {"reliability", read_reliability}}) {
    for (const Subject& table : headed_tables(top, key)) {
      if (read == read_sample) samples.emplace_back(plan.sweeps.size(), table);
      plan.sweeps.push_back(read(table));
      read_common(table, scene, folder, plan.sweeps.back());
    }
  }
  if (plan.sweeps.size() == 1)
    refuse(top, "sweep",
           "must be at least one table; begin it with [[sweep]], [[grid]], [[sample]] or [[reliability]]");
  const std::vector<std::string> everywhere = read_overrides(top);
  const std::optional<OtherCommand> other = read_other(top);
  for (Sweep& sweep : plan.sweeps) {
    sweep.overrides.insert(sweep.overrides.begin(), everywhere.begin(), everywhere.end());
    if (!sweep.other) sweep.other = other;
    if (sweep.other && plan.history)
      refuse(
          top, "history",
          fmt::format("`voussoir {}` has no history; name a value of its results.json in quantity", sweep.other->name));
  }
  const bool jumps = plan.quantity == "volume_below_1" || plan.quantity == "blocks_below_1";
  for (const Sweep& sweep : plan.sweeps)
    if (sweep.reliability && jumps)
      refuse(top, "quantity",
             "jumps from value to value; a reliability analysis follows how it changes with its keys: take "
             "\"least_factor\", or a [[sample]]");
  for (const auto& [place, table] : samples)
    draw_rows(table, plan.sweeps[place]);
  return plan;
}

}  // namespace voussoir
