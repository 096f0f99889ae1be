#include "core/scene/shared_stages.hpp"
#include "core/scene/support_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

namespace voussoir {
namespace {

using NameSet = std::set<std::string>;

void add_texts(const Node* list, NameSet& names) {
  if (!list) return;
  if (list->kind == Node::Kind::text) names.insert(list->text);
  for (const Node& item : list->items)
    names.insert(item.text);
}

void remove_key(Node& table, std::string_view key) {
  std::erase_if(table.members, [&](const Member& member) { return member.key == key; });
}

// an emptied list is treated as not stated
template <class Condition>
void keep_items(Node& table, std::string_view key, const Condition& wanted) {
  Node* list = table.find(key);
  if (!list) return;
  std::erase_if(list->items, [&](const Node& item) { return !wanted(item); });
  if (list->items.empty()) remove_key(table, key);
}

NameSet installed_by(const Node& stages) {
  NameSet names;
  for (const Node& stage : stages.items)
    add_texts(stage.find("install"), names);
  return names;
}

// The joint properties that contacts between blocks may have: those that joints and sets name, the one that applies if
// none is named, and those of linings that the stages install. A search within the stages uses all.
NameSet used_properties(const Node& scene, const Node& stages) {
  NameSet names{"default"};
  const Node* all = scene.find("joint_properties");
  if (all && !all->items.empty()) names.insert(name_of(all->items.front()));
  for (const char* key : {"joints", "joint_sets"})
    if (const Node* list = scene.find(key))
      for (const Node& item : list->items)
        if (const Node* properties = item.find("properties")) names.insert(properties->text);
  const NameSet installed = installed_by(stages);
  if (const Node* list = scene.find("linings"))
    for (const Node& item : list->items)
      if (const Node* properties = item.find("joint_properties"); properties && installed.contains(name_of(item)))
        names.insert(properties->text);
  const bool searches = std::ranges::any_of(stages.items, [](const Node& stage) {
    const Node* kind = stage.find("kind");
    return kind && kind->text == "reduce";
  });
  if (all && searches)
    for (const Node& item : all->items)
      names.insert(name_of(item));
  return names;
}

// of unused ones only the names matter, for the indices of the others; after the last used one not even these
void reduce_properties(const NameSet& used, Node& scene) {
  Node* all = scene.find("joint_properties");
  if (!all) return;
  while (!all->items.empty() && !used.contains(name_of(all->items.back())))
    all->items.pop_back();
  for (Node& item : all->items)
    if (!used.contains(name_of(item))) std::erase_if(item.members, [](const Member& m) { return m.key != "name"; });
}

// an excavation that no stage makes is made before the first stage
void tell_excavations(const Scene& scene, Node& tree) {
  NameSet by_stage;
  for (const StageSpec& stage : scene.stages)
    by_stage.insert(stage.plan.change.excavate.begin(), stage.plan.change.excavate.end());
  Node* all = tree.find("excavations");
  if (!all) return;
  for (Node& item : all->items) {
    Node when;
    when.kind = Node::Kind::text;
    when.place = item.place;
    when.text = by_stage.contains(name_of(item)) ? "by a stage" : "before the first stage";
    item.set("taken_out", std::move(when));
  }
}

// from the start as many numbers as all changes of a water need
void tell_waters(const Scene& scene, Node& tree) {
  Node* all = tree.find("water");
  if (!all) return;
  for (std::size_t w = 0; w < std::min(all->items.size(), scene.waters.size()); ++w) {
    Node points;
    points.kind = Node::Kind::list;
    points.place = all->items[w].place;
    for (const double x : scene.waters[w].numbers) {
      Node number;
      number.kind = Node::Kind::number;
      number.place = points.place;
      number.number = x;
      points.items.push_back(std::move(number));
    }
    all->items[w].set("points_with_all_changes", std::move(points));
  }
}

// the first difference of two trees
struct Difference {
  Place place;  // here, or of the table if it is not stated
  std::string path;
  const Node* here = nullptr;
  const Node* there = nullptr;
};

bool is_leaf_equal(const Node& a, const Node& b) {
  if (a.is_number() && b.is_number()) return a.number == b.number;
  return a.kind == b.kind && a.boolean == b.boolean && a.text == b.text;
}

std::optional<Difference> difference(const std::string& path, const Node& here, const Node& there);

std::optional<Difference> difference_of_lists(const std::string& path, const Node& here, const Node& there) {
  for (std::size_t k = 0; k < std::max(here.items.size(), there.items.size()); ++k) {
    const Node* a = k < here.items.size() ? &here.items[k] : nullptr;
    const Node* b = k < there.items.size() ? &there.items[k] : nullptr;
    const bool table = (a ? a : b)->kind == Node::Kind::table;
    if (!table && (!a || !b || difference(path, *a, *b))) return Difference{here.place, path, &here, &there};
    const std::string item = item_path(path, a ? *a : *b, k);
    if (!a || !b) return Difference{a ? a->place : here.place, item, a, b};
    if (auto found = difference(item, *a, *b)) return found;
  }
  return std::nullopt;
}

std::optional<Difference> difference(const std::string& path, const Node& here, const Node& there) {
  if (here.kind == Node::Kind::list && there.kind == Node::Kind::list) return difference_of_lists(path, here, there);
  if (here.kind != Node::Kind::table || there.kind != Node::Kind::table)
    return is_leaf_equal(here, there) ? std::nullopt : std::optional(Difference{here.place, path, &here, &there});
  NameSet keys;
  for (const Node* table : {&here, &there})
    for (const Member& member : table->members)
      keys.insert(member.key);
  for (const std::string& key : keys) {
    const Node *a = here.find(key), *b = there.find(key);
    const std::string at = key_path(path, key);
    if (!a || !b) return Difference{a ? a->place : here.place, at, a, b};
    if (auto found = difference(at, *a, *b)) return found;
  }
  return std::nullopt;
}

// "scene.toml:7: joints.A.dip = 30: is 35 in 'generation': …"
[[noreturn]] void refuse_difference(const Difference& d, const std::string& name, const std::string& stage) {
  const std::string rule = fmt::format(
      "{} in '{}'; up to the end of stage '{}', from which this run would start, both must be the same: make them the "
      "same, or compute the "
      "initial state from this scene (voussoir run --until)",
      d.there ? "is " + value_text(*d.there) : "is not stated", name, one_line(stage, 60));
  if (d.here) refuse(*d.here, d.path, rule);
  refuse(d.place, fmt::format("{} is missing: {}", one_line(d.path, 200), rule), d.path);
}

// the monitors with identical statements
std::vector<std::string> same_monitors(const Node& here, const Node& there) {
  std::vector<std::string> names;
  const Node *ours = here.find("monitors"), *theirs = there.find("monitors");
  if (!ours || !theirs) return names;
  for (const Node& a : ours->items)
    for (const Node& b : theirs->items)
      if (name_of(a) == name_of(b) && !difference("", a, b)) names.push_back(name_of(a));
  return names;
}

}  // namespace

Node shared_part(const Scene& scene, int stages) {
  Node tree = *scene.tree;
  for (const char* key : {"title", "base", "output", "monitors"})
    remove_key(tree, key);
  Node* list = tree.find("stage");
  list->items.resize(std::min(list->items.size(), static_cast<std::size_t>(stages)));
  const NameSet installed = installed_by(*list), used = used_properties(tree, *list);
  for (const SceneSupport& row : scene_supports)
    if (row.table) keep_items(tree, row.table, [&](const Node& item) { return installed.contains(name_of(item)); });
  reduce_properties(used, tree);
  tell_excavations(scene, tree);
  tell_waters(scene, tree);
  return tree;
}

SharedStages require_shared(const Scene& scene, const Scene& other, const std::string& name, int stages) {
  const std::string& stage = other.stages[stages - 1].plan.name;
  const Node here = shared_part(scene, stages), there = shared_part(other, stages);
  if (const auto found = difference("", here, there)) refuse_difference(*found, name, stage);
  if (static_cast<int>(scene.stages.size()) == stages)
    refuse({scene.tree.get(), ""}, "stage",
           fmt::format("'{}' has already run all stages of this scene; add a stage after '{}'", name,
                       one_line(stage, 60)));
  SharedStages shared{same_monitors(*scene.tree, *other.tree), {}};
  const NameSet used = used_properties(*scene.tree, *here.find("stage"));
  for (const PropertiesSpec& p : scene.properties)
    if (!used.contains(p.properties.name)) shared.own.push_back(p.properties.name);
  return shared;
}

}  // namespace voussoir
