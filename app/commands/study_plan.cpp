#include "app/commands/study_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/scene/node.hpp"
#include "core/scene/scene_text.hpp"
#include "core/scene/toml_text.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

// every key a study may hold; "" is the top of the file
struct StudyKey {
  std::string_view table, key, value, meaning;
};

constexpr StudyKey study_keys[] = {
    {"", "scene", "text, required", "the scene's file, relative to the study"},
    {"", "quantity", "text, required",
     "a value of results.json, e.g. `\"critical_friction\"`; with `history` the name of what it takes"},
    {"", "history", "table", "takes the quantity from a column of history.csv instead"},
    {"", "set", "list of texts", "`\"key=value\"` as after --set, for every run"},
    {"", "limit", "table",
     "runs by `voussoir limit` instead of `voussoir run`; `{}` for the critical friction under gravity"},
    {"", "begin", "text",
     "a stage of the scene: runs that are the same up to its end share one run up to there, which the study makes "
     "first, "
     "and begin where it ended"},
    {"", "sweep", "list of tables, required", "one setting that is changed, `[[sweep]]`, as many as are wanted"},
    {"history", "column", "text, required", "a column of history.csv, by its whole name"},
    {"history", "take", "one of `\"largest\"` `\"smallest\"` `\"last\"`, required", "which of its numbers"},
    {"history", "unit", "text, required", "of that number, e.g. `\"N\"`"},
    {"sweep", "name", "text, required", "in the table and the figure"},
    {"sweep", "key", "text, required", "key of the scene as after --set, e.g. `\"time.fraction\"`"},
    {"sweep", "values", "list, required", "what the key is set to, a run each"},
    {"sweep", "with", "list of tables", "further keys that change together with `key`, value by value"},
    {"sweep", "unit", "text", "of the values, e.g. `\"deg\"`"},
    {"sweep", "scene", "text", "another scene for this sweep"},
    {"sweep", "set", "list of texts", "`\"key=value\"` for every run of this sweep, after the study's own"},
    {"sweep", "extrapolate", "table",
     "adds what each two neighbouring runs give at a value of 0, where the result goes with a power of the value"},
    {"sweep", "limit", "table", "runs of this sweep by `voussoir limit`, instead of the study's own `limit`"},
    {"with", "key", "text, required", "key of the scene as after --set"},
    {"with", "values", "list, required", "what it is set to, one for each of the sweep's values"},
    {"extrapolate", "power", "number, required", "that power, above 0, at most 10; 0.6666667 for a rate of reduction"},
    {"limit", "load", "one of `\"gravity\"` `\"left\"` `\"right\"` `\"applied\"`", "as after `voussoir limit --load`"},
    {"limit", "friction", "list of texts", "names as after `--friction`"},
    {"limit", "factor", "true or false", "`--factor`"},
    {"limit", "joint", "list of texts", "names as after `--joint`"},
    {"limit", "cohesion", "true or false", "`--cohesion`"},
};

void refuse_unknown_keys(const Subject& table, std::string_view kind) {
  std::vector<std::string> known;
  for (const StudyKey& row : study_keys)
    if (row.table == kind) known.emplace_back(row.key);
  for (const Member& member : table.node->members)
    if (std::find(known.begin(), known.end(), member.key) == known.end())
      refuse(member.value, key_path(table.path, member.key), "no such key; " + suggestion(member.key, known));
}

const std::string& text_of(const Subject& table, const char* key, const std::string& rule) {
  const Node* node = table.node->find(key);
  if (!node || node->kind != Node::Kind::text || node->text.empty()) refuse(table, key, rule);
  return node->text;
}

std::vector<std::string> texts_of(const Subject& table, const char* key, const std::string& rule) {
  std::vector<std::string> texts;
  const Node* list = table.node->find(key);
  if (!list) return texts;
  if (list->kind != Node::Kind::list) refuse(table, key, rule);
  for (const Node& item : list->items) {
    if (item.kind != Node::Kind::text) refuse(item, key_path(table.path, key), rule);
    texts.push_back(item.text);
  }
  return texts;
}

std::vector<std::string> read_overrides(const Subject& table) {
  return texts_of(table, "set", "must be a list of texts \"key=value\"");
}

// as --set takes it; a text in quotes, so that it is never read as a number
std::string override_text(const Node& value, const std::string& path) {
  switch (value.kind) {
    case Node::Kind::boolean:
      return value.boolean ? "true" : "false";
    case Node::Kind::integer:
      return fmt::format("{:.0f}", value.number);
    case Node::Kind::number:
      if (!std::isfinite(value.number)) refuse(value, path, "must be a finite number");
      return fmt::format("{}", value.number);
    case Node::Kind::text:
      if (value.text.find_first_of("\"\\\n") != std::string::npos)
        refuse(value, path, "must not hold quotes, backslashes or line breaks");
      return '"' + value.text + '"';
    default:
      refuse(value, path, "must be a number, a text, true or false");
  }
}

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

std::vector<std::string> read_values(const Subject& table) {
  const Node* list = table.node->find("values");
  if (!list || list->kind != Node::Kind::list || list->items.empty())
    refuse(table, "values", "must be a list of at least one value, e.g. values = [1.0, 0.1, 0.01]");
  std::vector<std::string> values;
  for (std::size_t k = 0; k < list->items.size(); ++k)
    values.push_back(override_text(list->items[k], fmt::format("{}.{}", key_path(table.path, "values"), k + 1)));
  return values;
}

// the tables of a list under `key`; none where there is no such key
std::vector<Subject> tables_of(const Subject& table, const char* key) {
  const Node* list = table.node->find(key);
  if (!list) return {};
  const std::string rule = fmt::format("must be a list of tables, e.g. {} = [{{ key = …, values = … }}]", key);
  if (list->kind != Node::Kind::list || list->items.empty()) refuse(table, key, rule);
  for (const Node& item : list->items)
    if (item.kind != Node::Kind::table) refuse(item, key_path(table.path, key), rule);
  return children(table, key);
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

// what `voussoir limit` is asked, as its options; it judges what goes together
std::optional<std::vector<std::string>> read_limit(const Subject& table) {
  const Node* node = table.node->find("limit");
  if (!node) return std::nullopt;
  if (node->kind != Node::Kind::table)
    refuse(table, "limit",
           "must be a table, e.g. limit = { load = \"right\" }, or limit = {} for the critical friction");
  const Subject limit{node, key_path(table.path, "limit")};
  refuse_unknown_keys(limit, "limit");
  std::vector<std::string> options;
  if (node->find("load")) {
    const std::string rule = "must be one of \"gravity\", \"left\", \"right\", \"applied\"";
    const std::string& load = text_of(limit, "load", rule);
    if (load != "gravity" && load != "left" && load != "right" && load != "applied") refuse(limit, "load", rule);
    options = {"--load", load};
  }
  const bool factor = flag_of(limit, "factor");
  for (const char* key : {"load", "friction"})
    if (factor && node->find(key)) refuse(limit, key, "stands beside factor = true; one run answers one question");
  if (node->find("load") && node->find("friction"))
    refuse(limit, "friction", "stands beside load; one run answers one question");
  if (!factor && node->find("joint")) refuse(limit, "joint", "names what factor = true divides; write that beside it");
  if (factor) options.emplace_back("--factor");
  if (flag_of(limit, "cohesion")) options.emplace_back("--cohesion");
  for (const char* key : {"friction", "joint"})
    for (const std::string& name : texts_of(limit, key, "must be a list of names of joint_properties"))
      options.insert(options.end(), {fmt::format("--{}", key), name});
  return options;
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

Sweep read_sweep(const Subject& table, const std::string& scene, const fs::path& folder) {
  refuse_unknown_keys(table, "sweep");
  Sweep sweep;
  sweep.name = text_of(table, "name", "must be a text: the sweep's name in the table and the figure");
  sweep.key = text_of(table, "key", "must be a key of the scene as after --set, e.g. \"time.fraction\"");
  if (table.node->find("unit")) sweep.unit = text_of(table, "unit", "must be a text, e.g. \"deg\"");
  sweep.scene = folder / scene;
  if (table.node->find("scene"))
    sweep.scene = folder / text_of(table, "scene", "must be a scene's file name, relative to the study");
  sweep.values = read_values(table);
  read_numbers(table, sweep);
  sweep.with = read_tied(table, sweep.values.size());
  sweep.limit = read_limit(table);
  sweep.overrides = read_overrides(table);
  read_extrapolation(table, sweep);
  return sweep;
}

}  // namespace

std::string study_documentation() {
  std::string text = R"(
# Studies

`voussoir study study.toml --out folder` runs a scene as it is and with one setting changed at a time.

```toml
scene = "scene.toml"
quantity = "critical_friction"

[[sweep]]
name = "time step"
key = "time.fraction"
values = [0.2, 0.1, 0.05]
```

| table | key | value | meaning |
|---|---|---|---|
)";
  for (const StudyKey& row : study_keys)
    text += fmt::format("| {} | `{}` | {} | {} |\n", row.table.empty() ? "the top of the file" : row.table, row.key,
                        row.value, row.meaning);
  return text;
}

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

  const Node* sweeps = tree.find("sweep");
  if (!sweeps || sweeps->kind != Node::Kind::list || sweeps->items.empty())
    refuse(top, "sweep", "must be at least one table; begin it with [[sweep]]");

  // what everything else is compared with comes first
  plan.sweeps.push_back(
      {.name = "default", .values = {""}, .numbers = {std::nullopt}, .scene = path.parent_path() / scene});
  for (std::size_t k = 0; k < sweeps->items.size(); ++k) {
    const Node& item = sweeps->items[k];
    if (item.kind != Node::Kind::table) refuse(item, "sweep", "must be a table; begin it with [[sweep]]");
    plan.sweeps.push_back(read_sweep({&item, item_path("sweep", item, k)}, scene, path.parent_path()));
  }
  const std::vector<std::string> everywhere = read_overrides(top);
  const std::optional<std::vector<std::string>> limit = read_limit(top);
  for (Sweep& sweep : plan.sweeps) {
    sweep.overrides.insert(sweep.overrides.begin(), everywhere.begin(), everywhere.end());
    if (!sweep.limit) sweep.limit = limit;
    if (sweep.limit && plan.history)
      refuse(top, "history", "a run of `voussoir limit` has no history; name a value of its results.json in quantity");
  }
  return plan;
}

}  // namespace voussoir
