#include "app/docs/schema.hpp"

#include <nlohmann/json.hpp>

#include "app/study/key_table.hpp"
#include "core/scene/scene_schema.hpp"

namespace voussoir {
namespace {

using Schema = nlohmann::ordered_json;

std::string study_table_name(std::string_view table) {
  return table.empty() ? "study" : "study " + std::string(table);
}

Schema study_words(const StudyKey& row) {
  Schema words = Schema::array();
  std::string_view left = row.words;
  for (std::size_t bar = left.find('|'); bar != left.npos; bar = left.find('|')) {
    words.push_back(left.substr(0, bar));
    left.remove_prefix(bar + 1);
  }
  words.push_back(left);
  return {{"type", "string"}, {"enum", std::move(words)}};
}

Schema study_value(const StudyKey& row) {
  const Schema text{{"type", "string"}};
  switch (row.type) {
    case StudyValue::text:
      return text;
    case StudyValue::number:
      return {{"type", "number"}};
    case StudyValue::boolean:
      return {{"type", "boolean"}};
    case StudyValue::choice:
      return study_words(row);
    case StudyValue::choice_or_text:
      return {{"anyOf", {study_words(row), text}}};  // the words for an editor's list
    case StudyValue::texts:
      return {{"type", "array"}, {"items", text}};
    case StudyValue::values:
      return {{"type", "array"}, {"items", {{"type", {"number", "string", "boolean"}}}}, {"minItems", 1}};
    case StudyValue::lists:
      return {{"type", "array"}, {"items", {{"type", "array"}}}};
    case StudyValue::table:
      return {{"allOf", Schema::array({{{"$ref", "#/definitions/" + study_table_name(tables_at(row))}}})}};
    case StudyValue::tables:
      return {{"type", "array"},
              {"items", {{"$ref", "#/definitions/" + study_table_name(tables_at(row))}}},
              {"minItems", 1}};
  }
  return {};
}

void add_study_definitions(Schema& definitions) {
  for (const StudyKey& row : study_keys()) {
    Schema& table = definitions[study_table_name(row.table)];
    if (table.is_null())
      table = {{"type", "object"}, {"properties", Schema::object()}, {"additionalProperties", false}};
    Schema property{{"description", row.meaning}};
    property.update(study_value(row));
    table["properties"][std::string(row.key)] = std::move(property);
    if (row.required) table["required"].push_back(row.key);
  }
}

}  // namespace

std::string files_schema() {
  Schema definitions = scene_definitions();
  add_study_definitions(definitions);
  const Schema schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
                      {"title", "Scenes and studies of Voussoir"},
                      {"if", {{"required", Schema::array({"quantity"})}}},
                      {"then", {{"$ref", "#/definitions/study"}}},
                      {"else", {{"$ref", "#/definitions/scene"}}},
                      {"definitions", std::move(definitions)}};
  return schema.dump(1) + '\n';
}

}  // namespace voussoir
