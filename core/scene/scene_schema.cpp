#include "core/scene/scene_schema.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/scene/keys.hpp"
#include "core/scene/renamed_keys.hpp"

namespace voussoir {
namespace scene_schema {
namespace {

using Json = nlohmann::ordered_json;

// A key of an earlier version, in the group that held it, and the row of its present name.
struct Alias {
  std::string_view group;
  std::string key;
  const KeyRow* present;
  std::string present_path;
};

// the row at a path of keys, and the group of the table that holds its last one
std::pair<std::string_view, const KeyRow*> at_path(std::string_view path, std::string& last) {
  Groups groups{""};
  for (;;) {
    const std::size_t dot = path.find('.');
    last = path.substr(0, dot);
    const KeyRow* row = find_row(groups, last);
    if (dot == path.npos) return {groups.front(), row};
    if (!row) return {};  // below a table that was renamed too
    groups = row->holds;
    path.remove_prefix(dot + 1);
  }
}

const std::vector<Alias>& aliases() {
  static const std::vector<Alias> all = [] {
    std::vector<Alias> found;
    for (const RenamedKey& renamed : renamed_keys) {
      std::string earlier, present;
      const std::string_view group = at_path(renamed.earlier, earlier).first;
      const KeyRow* row = at_path(renamed.present, present).second;
      found.push_back({group, earlier, row, std::string(renamed.present)});
    }
    return found;
  }();
  return all;
}

Json reference(const std::string& name) {
  return {{"$ref", "#/definitions/" + name}};
}

std::string name_of(const Groups& groups) {
  std::string name;
  for (const std::string_view group : groups)
    name += (name.empty() ? "" : "+") + std::string(group);
  return name.empty() ? "scene" : name;
}

// ---- the value of a key ---------------------------------------------------------------------------------------------

Json number_of(const KeyRow& row) {
  Json number{{"type", row.type == KeyType::integer ? "integer" : "number"}};
  const Range& range = row.range;
  if (std::isfinite(range.low)) number[range.above_low ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high)) number[range.below_high ? "exclusiveMaximum" : "maximum"] = range.high;
  if (!range.or_zero) return number;
  return {{"anyOf", {{{"const", 0}}, std::move(number)}}};
}

Json list_of(Json items, std::size_t least) {
  return {{"type", "array"}, {"items", std::move(items)}, {"minItems", least}};
}

Json list_of(Json items, std::size_t least, std::size_t most) {
  Json list = list_of(std::move(items), least);
  list["maxItems"] = most;
  return list;
}

Json one_or_several(const Json& one) {
  Json several = list_of(one, 1);
  several["uniqueItems"] = true;
  return {{"anyOf", {one, std::move(several)}}};
}

Json words_of(const std::vector<std::string_view>& words) {
  return {{"type", "string"}, {"enum", words}};
}

Json axes() {
  Json axes = one_or_several(words_of({"x", "y", "z"}));
  axes["anyOf"].push_back({{"type", "boolean"}});
  return axes;
}

Json value_of(const KeyRow& row) {
  switch (row.type) {
    case KeyType::boolean:
      return {{"type", "boolean"}};
    case KeyType::integer:
    case KeyType::number:
      return number_of(row);
    case KeyType::text:
      return {{"type", "string"}, {"maxLength", 1000}};
    case KeyType::name:
      return {{"type", "string"}, {"maxLength", 1000}, {"pattern", "^[^.=]+$"}};
    case KeyType::choice:
      return words_of(row.choices);
    case KeyType::vector:
      return list_of(number_of(row), 2, 3);
    case KeyType::spin:
      return {{"anyOf", {number_of(row), list_of(number_of(row), 3, 3)}}};
    case KeyType::axes:
      return axes();
    case KeyType::names:
      return one_or_several({{"type", "string"}});
    case KeyType::choices:
      return one_or_several(words_of(row.choices));
    case KeyType::points:
      return list_of(list_of(number_of(row), 2, 3), 0);
    case KeyType::numbers:
      return list_of(number_of(row), 1);
    case KeyType::surface:
      return {{"anyOf", {list_of(list_of(number_of(row), 2, 3), 0), reference(name_of(row.holds))}}};
    case KeyType::table:
      return reference(name_of(row.holds));
    case KeyType::tables: {
      Json list = list_of(reference(name_of(row.holds)), 0);
      // read_records.hpp makes a list of a single record
      if (row.holds == Groups{"record"}) return {{"anyOf", {reference(name_of(row.holds)), std::move(list)}}};
      return list;
    }
  }
  return {};
}

std::string description_of(const KeyRow& row) {
  std::string text(row.meaning);
  if (!row.unit.empty() && row.unit != "1") text += " [" + std::string(row.unit) + "]";
  if (!row.default_value.empty()) text += " (default " + row.default_value + ")";
  if (!row.example.empty()) text += " e.g. " + std::string(row.key) + " = " + std::string(row.example);
  return text;
}

Json property_of(const KeyRow& row) {
  Json value = value_of(row);
  Json property{{"description", description_of(row)}};
  if (value.contains("$ref"))
    property["allOf"] = Json::array({std::move(value)});  // what is beside a reference is ignored
  else
    property.update(value);
  return property;
}

// ---- what a whole scene asks, and one that states differences does not ----------------------------------------------

void add_conditions(Json& all, const Groups& groups, const KeyRow& row);

void add_condition(Json& all, const Groups& groups, const Condition& condition) {
  if (condition.key.empty()) return;
  const KeyRow* decisive = find_row(groups, condition.key);
  std::vector<std::string> words;
  for (std::string_view left = condition.value; !left.empty();) {
    const std::size_t bar = left.find('|');
    words.emplace_back(left.substr(0, bar));
    left.remove_prefix(bar == left.npos ? left.size() : bar + 1);
  }
  const bool by_default = std::any_of(
      words.begin(), words.end(), [&](const std::string& word) { return decisive->default_value == '"' + word + '"'; });
  Json one{{"properties", {{std::string(condition.key), {{"enum", words}}}}}};
  if (!by_default) one["required"] = Json::array({condition.key});
  all.push_back(std::move(one));
  add_conditions(all, groups, *decisive);
}

void add_conditions(Json& all, const Groups& groups, const KeyRow& row) {
  add_condition(all, groups, row.when);
  add_condition(all, groups, row.and_when);
}

// the same name for the rules between the keys of a table
std::string whole_name_of(const Groups& groups) {
  return "whole " + name_of(groups);
}

// the names of a key: the present one, and those of earlier versions in the same table
Json states(const KeyRow& row) {
  Json any = Json::array({{{"required", Json::array({row.key})}}});
  for (const Alias& alias : aliases())
    if (alias.present == &row && alias.group == row.table) any.push_back({{"required", Json::array({alias.key})}});
  return any.size() == 1 ? any.front() : Json{{"anyOf", std::move(any)}};
}

Json whole_value_of(const KeyRow& row) {
  const Json inner = reference(whole_name_of(row.holds));
  return row.type == KeyType::tables ? Json{{"items", inner}} : inner;
}

Json whole_table(const Groups& groups) {
  Json properties = Json::object(), depends = Json::object(), rules = Json::array();
  for (const std::string_view group : groups)
    for (const KeyRow& row : key_rows(group)) {
      if (find_row(groups, row.key) != &row) continue;
      Json conditions = Json::array();
      add_conditions(conditions, groups, row);
      const Json applies = conditions.size() == 1 ? conditions.front() : Json{{"allOf", conditions}};
      if (!conditions.empty()) depends[std::string(row.key)] = applies;
      if (!row.holds.empty() && row.type != KeyType::surface) properties[std::string(row.key)] = whole_value_of(row);
      if (!row.required) continue;
      rules.push_back(conditions.empty() ? states(row) : Json{{"if", applies}, {"then", states(row)}});
    }
  Json table = Json::object();
  if (!properties.empty()) table["properties"] = std::move(properties);
  if (!depends.empty()) table["dependencies"] = std::move(depends);
  if (!rules.empty()) table["allOf"] = std::move(rules);
  return table;
}

// ---- tables ---------------------------------------------------------------------------------------------------------

Json table_of(const Groups& groups) {
  Json properties = Json::object();
  for (const std::string_view group : groups)
    for (const KeyRow& row : key_rows(group))
      if (!properties.contains(std::string(row.key))) properties[std::string(row.key)] = property_of(row);
  for (const Alias& alias : aliases()) {
    if (std::find(groups.begin(), groups.end(), alias.group) == groups.end()) continue;
    Json property = property_of(*alias.present);
    property["description"] = "earlier name of " + alias.present_path;
    property["deprecated"] = true;
    properties[alias.key] = std::move(property);
  }
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

void add_tables(Json& definitions, const Groups& groups) {
  if (definitions.contains(name_of(groups))) return;
  definitions[name_of(groups)] = table_of(groups);
  definitions[whole_name_of(groups)] = whole_table(groups);
  for (const std::string_view group : groups)
    for (const KeyRow& row : key_rows(group))
      if (!row.holds.empty()) add_tables(definitions, row.holds);
}

}  // namespace
}  // namespace scene_schema

nlohmann::ordered_json scene_definitions() {
  using namespace scene_schema;
  Json definitions = Json::object();
  add_tables(definitions, {""});
  Json& scene = definitions["scene"];
  scene["if"] = {{"not", {{"required", Json::array({"base"})}}}};
  scene["then"] = reference(whole_name_of({""}));
  return definitions;
}

}  // namespace voussoir
