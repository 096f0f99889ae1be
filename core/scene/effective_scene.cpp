#include "core/scene/effective_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace voussoir {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (character == '"' || character == '\\')
      result += std::string("\\") + character;
    else if (byte < 0x20 || byte == 0x7f)
      result += fmt::format("\\u{:04X}", byte);
    else
      result += character;
  }
  return result + "\"";
}

std::string key_text(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char character) {
    return std::isalnum(character) || character == '_' || character == '-';
  });
  return bare ? key : quoted(key);
}

std::string lines(const Node& table) {
  std::string text;
  for (const Member& member : table.members)
    text += key_text(member.key) + " = " + toml_value(member.value) + "\n";
  return text;
}

}  // namespace

std::string toml_value(const Node& node) {
  std::string text;
  switch (node.kind) {
    case Node::Kind::boolean:
      return node.boolean ? "true" : "false";
    case Node::Kind::integer:
      return fmt::format("{:.0f}", node.number);
    case Node::Kind::number:
      return fmt::format("{}", node.number);
    case Node::Kind::text:
      return quoted(node.text);
    case Node::Kind::list:
      for (const Node& item : node.items)
        text += (text.empty() ? "" : ", ") + toml_value(item);
      return "[" + text + "]";
    case Node::Kind::table:
      for (const Member& member : node.members)
        text += (text.empty() ? "" : ", ") + key_text(member.key) + " = " + toml_value(member.value);
      return text.empty() ? "{}" : "{ " + text + " }";
    case Node::Kind::date:
      break;  // no key of a scene has such a value
  }
  return "\"\"";
}

std::string toml_text(const Node& scene) {
  std::string values, tables;
  for (const Member& member : scene.members) {
    const std::string key = key_text(member.key);
    if (member.value.kind == Node::Kind::table)
      tables += "\n[" + key + "]\n" + lines(member.value);
    else if (member.value.is_list_of_tables())
      for (const Node& item : member.value.items)
        tables += "\n[[" + key + "]]\n" + lines(item);
    else
      values += key + " = " + toml_value(member.value) + "\n";
  }
  return values + tables;
}

}  // namespace voussoir
