#include "core/scene/base_scene.hpp"

#include <algorithm>

#include "core/scene/scene_text.hpp"
#include "core/scene/toml_text.hpp"

namespace voussoir {
namespace {

// a base of a base of a base: more is a circle
constexpr int most_bases = 4;

const std::string* name_of(const Node& table) {
  const Node* name = table.find("name");
  return name && name->kind == Node::Kind::text ? &name->text : nullptr;
}

bool is_list_of_tables(const Node& node) {
  return node.kind == Node::Kind::list && !node.items.empty() &&
         std::all_of(node.items.begin(), node.items.end(),
                     [](const Node& item) { return item.kind == Node::Kind::table; });
}

// a stage of another kind or method shares its name with the base's and nothing else
bool is_another(const Node& base, const Node& scene) {
  for (const char* key : {"kind", "method"}) {
    const Node *below = base.find(key), *above = scene.find(key);
    if (below && above && below->text != above->text) return true;
  }
  return false;
}

void lay_over(Node& base, const Node& scene);

// a table of the list goes over the base's of the same name, or behind the others
void lay_list_over(Node& base, const Node& scene) {
  for (const Node& item : scene.items) {
    const std::string* name = name_of(item);
    const auto same = std::find_if(base.items.begin(), base.items.end(), [&](const Node& other) {
      const std::string* other_name = name_of(other);
      return name && other_name && *name == *other_name;
    });
    if (same == base.items.end())
      base.items.push_back(item);
    else if (is_another(*same, item))
      *same = item;
    else
      lay_over(*same, item);
  }
}

void lay_over(Node& base, const Node& scene) {
  for (const Member& member : scene.members) {
    Node* below = base.find(member.key);
    if (below && below->kind == Node::Kind::table && member.value.kind == Node::Kind::table)
      lay_over(*below, member.value);
    else if (below && is_list_of_tables(*below) && is_list_of_tables(member.value))
      lay_list_over(*below, member.value);
    else
      base.set(member.key, member.value);
  }
  base.place = scene.place;
}

void forget_base(Node& scene) {
  std::erase_if(scene.members, [](const Member& m) { return m.key == "base"; });
}

Node load(Node scene, const std::filesystem::path& folder, int depth) {
  const Node* stated = scene.find("base");
  if (!stated) return scene;
  if (stated->kind != Node::Kind::text) refuse(*stated, "base", "must be the name of a scene file in quotes");
  const std::filesystem::path relative = stated->text;
  const bool escapes = relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end();
  if (escapes) refuse(*stated, "base", "must lie in the scene's own folder: give its name without .. or a leading /");
  if (depth == most_bases) refuse(*stated, "base", "more than 4 bases in a row: do they name each other?");
  const std::filesystem::path file = folder / relative;
  if (!std::filesystem::is_regular_file(file)) refuse(*stated, "base", "there is no such file beside the scene");
  const auto source = std::make_shared<const std::string>(file.string());
  Node base = load(parse_toml(file_text(file), source), file.parent_path(), depth + 1);
  lay_over(base, scene);
  forget_base(base);
  return base;
}

}  // namespace

Node with_base(Node scene, const std::filesystem::path& folder) {
  return load(std::move(scene), folder, 0);
}

}  // namespace voussoir
