#include "core/base/fingerprint.hpp"
#include "core/scene/renamed_keys.hpp"
#include "core/scene/scene.hpp"

#include <charconv>
#include <vector>

namespace voussoir {
namespace {

void write(const Node& node, std::string& text) {
  const auto number = [&](double x) {
    char buffer[32];
    text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, x).ptr);
  };
  switch (node.kind) {
    case Node::Kind::boolean:
      text += node.boolean ? "true" : "false";
      break;
    case Node::Kind::integer:
    case Node::Kind::number:
      number(node.number);
      break;
    case Node::Kind::text:  // the length first, so that no text can pass for another structure
      number(static_cast<double>(node.text.size()));
      text += '"' + node.text + '"';
      break;
    case Node::Kind::date:
      break;
    case Node::Kind::list:
      text += '[';
      for (const Node& item : node.items) {
        write(item, text);
        text += ",";
      }
      text += ']';
      break;
    case Node::Kind::table:
      text += '{';
      for (const Member& member : node.members) {
        text += member.key + "=";
        write(member.value, text);
        text += "\n";
      }
      text += '}';
  }
}

}  // namespace

std::string canonical_text(const Node& part) {
  std::string text;
  write(part, text);
  return text;
}

std::string canonical_text(const Scene& scene) {
  Node tree = with_earliest_names(*scene.tree);
  std::erase_if(tree.members, [](const Member& member) { return member.key == "preset"; });  // what it sets is there
  return canonical_text(tree);
}

std::string input_hash(const Scene& scene) {
  return fingerprint(canonical_text(scene));
}

}  // namespace voussoir
