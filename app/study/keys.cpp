#include "app/study/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/study/key_table.hpp"

namespace voussoir {
namespace {

std::string value_text_of(const StudyKey& row) {
  std::string text;
  switch (row.type) {
    case StudyValue::text:
      text = "text";
      break;
    case StudyValue::number:
      text = "number";
      break;
    case StudyValue::boolean:
      text = "true or false";
      break;
    case StudyValue::choice:
    case StudyValue::choice_or_text:
      text = "one of `\"" + std::string(row.words) + "\"`";
      for (std::size_t bar = text.find('|'); bar != text.npos; bar = text.find('|'))
        text.replace(bar, 1, "\"` `\"");
      text += row.otherwise;
      break;
    case StudyValue::texts:
      text = "list of texts";
      break;
    case StudyValue::values:
      text = "list";
      break;
    case StudyValue::lists:
      text = "list of lists";
      break;
    case StudyValue::table:
      text = "table";
      break;
    case StudyValue::tables:
      text = "list of tables";
  }
  return row.required ? text + ", required" : text;
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
        refuse(value, path, "must not contain quotes, backslashes or line breaks");
      return '"' + value.text + '"';
    default:
      refuse(value, path, "must be a number, a text, true or false");
  }
}

}  // namespace

void refuse_unknown_keys(const Subject& table, std::string_view kind) {
  std::vector<std::string> known;
  for (const StudyKey& row : study_keys())
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

std::vector<std::string> read_values(const Subject& table) {
  const Node* list = table.node->find("values");
  if (!list || list->kind != Node::Kind::list || list->items.empty())
    refuse(table, "values", "must be a list of at least one value, e.g. values = [1.0, 0.1, 0.01]");
  std::vector<std::string> values;
  for (std::size_t k = 0; k < list->items.size(); ++k)
    values.push_back(override_text(list->items[k], fmt::format("{}.{}", key_path(table.path, "values"), k + 1)));
  return values;
}

std::vector<Subject> tables_of(const Subject& table, const char* key) {
  const Node* list = table.node->find(key);
  if (!list) return {};
  const std::string rule = fmt::format("must be a list of tables, e.g. {} = [{{ key = …, values = … }}]", key);
  if (list->kind != Node::Kind::list || list->items.empty()) refuse(table, key, rule);
  for (const Node& item : list->items)
    if (item.kind != Node::Kind::table) refuse(item, key_path(table.path, key), rule);
  return children(table, key);
}

std::optional<double> number_of(const Subject& table, const char* key) {
  const Node* node = table.node->find(key);
  if (!node) return std::nullopt;
  if (!node->is_number() || !(std::abs(node->number) <= largest_study_number))
    refuse(table, key, "must be a number, at most 1e15");
  return node->number;
}

std::string study_documentation() {
  std::string text = R"(
# Studies

`voussoir study study.toml --out folder` runs a scene as it is and with one setting changed at a time, with
every combination of some, or with settings drawn at random. In parts, for many processes and machines: `voussoir study plan
study.toml --out folder`, then `voussoir study run folder` any number of times, with `--rows` or `--chunk`, `voussoir study
status folder`, and `voussoir study gather folder`.

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
  for (const StudyKey& row : study_keys())
    text += fmt::format("| {} | `{}` | {} | {} |\n", row.table.empty() ? "the top of the file" : row.table, row.key,
                        value_text_of(row), row.meaning);
  return text;
}

}  // namespace voussoir
