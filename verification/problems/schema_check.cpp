#include "verification/problems/schema_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <stdexcept>

namespace voussoir::problems {
namespace {

using SchemaJson = nlohmann::json;

bool has_type(const SchemaJson& value, const std::string& type) {
  if (type == "null") return value.is_null();
  if (type == "number") return value.is_number();
  if (type == "integer") return value.is_number_integer();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "array") return value.is_array();
  if (type == "object") return value.is_object();
  throw std::invalid_argument("schema: unknown type " + type);
}

class Checker {
 public:
  explicit Checker(const SchemaJson& root) : root_(root) {}

  std::vector<std::string> check(const SchemaJson& value, const SchemaJson& schema, const std::string& place) const {
    std::vector<std::string> found;
    for (const auto& [key, rule] : schema.items()) {
      if (key == "$schema" || key == "title" || key == "description" || key == "$defs") continue;
      check_one(value, schema, key, rule, place, found);
    }
    return found;
  }

 private:
  static void add(std::vector<std::string>& to, const std::vector<std::string>& more) {
    to.insert(to.end(), more.begin(), more.end());
  }

  void check_one(const SchemaJson& value, const SchemaJson& schema, const std::string& key, const SchemaJson& rule,
                 const std::string& place, std::vector<std::string>& found) const {
    const auto require = [&](bool holds) {
      if (!holds) found.push_back(fmt::format("{}: {} = {}", place.empty() ? "/" : place, key, rule.dump()));
    };
    if (key == "type")
      require(has_type(value, rule));
    else if (key == "const")
      require(value == rule);
    else if (key == "enum")
      require(std::ranges::find(rule, value) != rule.end());
    else if (key == "$ref")
      add(found, check(value, root_.at(SchemaJson::json_pointer(rule.get<std::string>().substr(1))), place));
    else if (key == "minimum")
      require(!value.is_number() || value >= rule);
    else if (key == "exclusiveMinimum")
      require(!value.is_number() || value > rule);
    else if (key == "exclusiveMaximum")
      require(!value.is_number() || value < rule);
    else if (key == "minItems")
      require(!value.is_array() || value.size() >= rule.get<std::size_t>());
    else if (key == "maxItems")
      require(!value.is_array() || value.size() <= rule.get<std::size_t>());
    else if (key == "minLength")
      require(!value.is_string() || value.get<std::string>().size() >= rule.get<std::size_t>());
    else if (key == "pattern")
      require(!value.is_string() || std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>())));
    else if (key == "oneOf")
      require(1 ==
              std::ranges::count_if(rule, [&](const SchemaJson& one) { return check(value, one, place).empty(); }));
    else
      check_members(value, schema, key, rule, place, found);
  }

  void check_members(const SchemaJson& value, const SchemaJson& schema, const std::string& key, const SchemaJson& rule,
                     const std::string& place, std::vector<std::string>& found) const {
    if (key == "required") {
      for (const SchemaJson& name : rule)
        if (value.is_object() && !value.contains(name.get<std::string>()))
          found.push_back(place + ": lacks " + name.dump());
    } else if (key == "properties") {
      for (const auto& [name, part] : rule.items())
        if (value.is_object() && value.contains(name)) add(found, check(value.at(name), part, place + "/" + name));
    } else if (key == "additionalProperties") {
      for (const auto& [name, part] : value.items()) {
        if (!value.is_object() || (schema.contains("properties") && schema["properties"].contains(name))) continue;
        if (rule.is_boolean() && !rule.get<bool>()) found.push_back(place + ": has the unknown key " + name);
        if (rule.is_object()) add(found, check(part, rule, place + "/" + name));
      }
    } else if (key == "items") {
      for (std::size_t k = 0; value.is_array() && k < value.size(); ++k)
        add(found, check(value[k], rule, fmt::format("{}/{}", place, k)));
    } else {
      throw std::invalid_argument("schema: unknown keyword " + key);
    }
  }

  const SchemaJson& root_;
};

}  // namespace

std::vector<std::string> schema_violations(const SchemaJson& document, const SchemaJson& schema) {
  return Checker(schema).check(document, schema, "");
}

}  // namespace voussoir::problems
