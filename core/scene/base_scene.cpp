#include "core/scene/base_scene.hpp"

#include <algorithm>
#include <map>

#include "core/scene/renamed_keys.hpp"
#include "core/scene/scene_text.hpp"
#include "core/scene/toml_text.hpp"

namespace voussoir {
namespace {

// a base of a base of a base …
constexpr std::size_t most_bases = 16;

// a stage of another kind or method has only its name in common with the base's
bool is_another(const Node& base, const Node& scene) {
  for (const char* key : {"kind", "method"}) {
    const Node *below = base.find(key), *above = scene.find(key);
    if (below && above && below->text != above->text) return true;
  }
  return false;
}

// a table of the list is merged into the base's of the same name, or appended
void lay_list_over(Node& base, const Node& scene) {
  std::map<std::string, std::size_t> places;  // by name, the first occurrence
  for (std::size_t i = 0; i < base.items.size(); ++i)
    if (const std::string name = name_of(base.items[i]); !name.empty()) places.emplace(name, i);
  for (const Node& item : scene.items) {
    const std::string name = name_of(item);
    const auto same = name.empty() ? places.end() : places.find(name);
    if (same == places.end()) {
      if (!name.empty()) places.emplace(name, base.items.size());
      base.items.push_back(item);
    } else if (is_another(base.items[same->second], item)) {
      base.items[same->second] = item;
    } else {
      lay_over(base.items[same->second], item);
    }
  }
}

}  // namespace

void lay_over(Node& base, const Node& scene) {
  for (const Member& member : scene.members) {
    Node* below = base.find(member.key);
    if (below && below->kind == Node::Kind::table && member.value.kind == Node::Kind::table)
      lay_over(*below, member.value);
    else if (below && below->is_list_of_tables() && member.value.is_list_of_tables())
      lay_list_over(*below, member.value);
    else
      base.set(member.key, member.value);
  }
  base.place = scene.place;
}

namespace {

void forget(Node& scene, std::initializer_list<std::string_view> keys) {
  std::erase_if(scene.members,
                [&](const Member& m) { return std::find(keys.begin(), keys.end(), m.key) != keys.end(); });
}

namespace fs = std::filesystem;

// `chain` holds the bases that led here
Node load(Node scene, const fs::path& folder, std::vector<fs::path>& chain, FilesRead& read) {
  take_present_names(scene, "", "", read.renamed);
  // tables from files of joints and blocks have lower precedence than the scene that names them, like a base
  Node files = tables_of_files(scene, folder, read);
  lay_over(files, scene);
  scene = std::move(files);
  forget(scene, {"joints_file", "blocks_file"});

  const Node* stated = scene.find("base");
  if (!stated) return scene;
  const fs::path file = file_beside(*stated, "base", folder);
  if (std::find(chain.begin(), chain.end(), file) != chain.end())
    refuse(*stated, "base", "leads back to the scene itself; name another file, or remove one base of the circle");
  if (chain.size() == most_bases)
    refuse(*stated, "base",
           "more than 16 bases in a row; state this scene's differences from a scene nearer to the first");
  chain.push_back(file);
  read.files.push_back(file);
  // messages name the file as the user would find it
  const fs::path shown = folder / fs::path(stated->text);
  const auto source = std::make_shared<const std::string>(shown.string());
  Node base = load(parse_toml(file_text(file), source), shown.parent_path(), chain, read);
  lay_over(base, scene);
  forget(base, {"base"});
  return base;
}

}  // namespace

Node with_base(Node scene, const fs::path& folder, FilesRead& read) {
  std::vector<fs::path> chain;
  return load(std::move(scene), folder, chain, read);
}

}  // namespace voussoir
