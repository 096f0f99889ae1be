#include "core/scene/repeat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/scene/base_scene.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/moved_tables.hpp"

namespace voussoir {
namespace {

// values in the copied tables, about 200 bytes each: more are a mistake in a count
constexpr std::size_t most_values = 500'000;

using Names = std::vector<std::string>;
using NameSet = std::set<std::string>;

// a list of tables that can be repeated
struct RepeatedList {
  std::string_view key;
  const char* one;
  Names CopiesSpec::*names;
};
constexpr std::array<RepeatedList, 3> repeated_lists{{{"blocks", "block", &CopiesSpec::blocks},
                                                      {"joints", "joint", &CopiesSpec::joints},
                                                      {"bolts", "bolts", &CopiesSpec::bolts}}};

Names names_in(const Node* list) {
  Names names;
  if (list)
    for (const Node& item : list->items)
      names.push_back(name_of(item));
  return names;
}

std::string copy_name(const std::string& name, int k) {
  return fmt::format("{}-{}", name, k + 1);
}

// The meaning of the names of a list while one [[repeat]] after the other is carried out: themselves, then their
// copies.
class Naming {
 public:
  // the tables that these names mean now
  NameSet take(const Names& stated) {
    NameSet chosen;
    for (const std::string& name : stated) {
      const Names& now = standing_.try_emplace(name, Names{name}).first->second;
      chosen.insert(now.begin(), now.end());
    }
    return chosen;
  }
  void repeat(const NameSet& chosen, int count) {
    for (auto& [name, now] : standing_) {
      Names after;
      for (const std::string& one : now)
        if (!chosen.contains(one))
          after.push_back(one);
        else
          for (int k = 0; k < count; ++k)
            after.push_back(copy_name(one, k));
      now = std::move(after);
    }
  }
  bool knows(const std::string& name) const { return standing_.contains(name); }
  NameSet copies() const {
    NameSet all;
    for (const auto& [name, now] : standing_)
      for (const std::string& one : now)
        if (one != name) all.insert(one);
    return all;
  }

 private:
  std::map<std::string, Names> standing_;
};

// The names of the copies of a list, before any check: invalid tables give none.
NameSet copies_to_come(const Node& scene, const RepeatedList& list) {
  Naming naming;
  const Node* repeats = scene.find("repeat");
  if (!repeats || repeats->kind != Node::Kind::list) return {};
  double made = 1;
  for (const Node& item : repeats->items) {
    const Node *names = item.find(list.key), *count = item.find("count");
    if (!names || !count || !std::isfinite(count->number) || !(count->number >= 2 && count->number <= most_values))
      continue;
    Names stated;
    if (names->kind == Node::Kind::text) stated.push_back(names->text);
    for (const Node& name : names->items)
      stated.push_back(name.text);
    made *= count->number * static_cast<double>(stated.size() + 1);
    if (made > most_values) return {};
    naming.repeat(naming.take(stated), static_cast<int>(count->number));
  }
  return naming.copies();
}

void check_spec(const Subject& item, const CopiesSpec& spec, int dimension) {
  if (spec.blocks.empty() && spec.joints.empty() && spec.bolts.empty())
    refuse(item, "blocks", "nothing is repeated; name blocks, joints or bolts, for example blocks = [\"stone\"]");
  const auto is_zero = [](double x) { return x == 0; };
  if (spec.turn == 0 && std::ranges::all_of(spec.shift, is_zero))
    refuse(item,
           item.node->find("shift")      ? "shift"
           : item.node->find("turn_deg") ? "turn_deg"
                                         : "shift",
           "all copies would coincide; write a shift that is not zero, or turn_deg");
  if (dimension == 2 && !spec.axis.empty())
    refuse(item, "axis", "is perpendicular to the plane because dimension = 2; remove it");
  if (spec.turn == 0)
    for (const char* key : {"about", "axis"})
      if (item.node->find(key))
        refuse(item, key, "is stated without a rotation; write for example turn_deg = 12, or remove it");
  if (spec.turn == 0) return;
  if (spec.about.empty())
    refuse(item, "about",
           dimension == 2 ? "the rotation needs its centre; write for example about = [0, 0]"
                          : "the rotation needs a point of its axis; write for example about = [0, 0, 0]");
  if (dimension == 3 && std::ranges::all_of(spec.axis, is_zero))
    refuse(item, "axis", "the rotation needs the direction of its axis; write for example axis = [0, 1, 0]");
}

std::size_t values_in(const Node& node) {
  std::size_t sum = 1;
  for (const Node& item : node.items)
    sum += values_in(item);
  for (const Member& member : node.members)
    sum += values_in(member.value);
  return sum;
}

template <int Dim>
void move_table(Node& table, std::string_view list, const std::string& path, const CopiesSpec& spec, int times) {
  const RigidMove<Dim> move = move_of<Dim>(spec, times);
  if (list == "blocks") move_block<Dim>(table, move);
  if (list == "joints") move_joint<Dim>(table, path, move);
  if (list == "bolts") move_bolt<Dim>(table, move);
}

// a name of a table that is repeated with it becomes the name of that table's copy
void follow(Node& text, const NameSet& chosen, int k) {
  if (text.kind == Node::Kind::text && chosen.contains(text.text)) text.text = copy_name(text.text, k);
}

Node copy_of(const Node& table, const RepeatedList& list, const CopiesSpec& spec, const NameSet& chosen, int k,
             int dimension) {
  Node copy = table;
  follow(*copy.find("name"), chosen, k);
  if (Node* owner = copy.find("part_of")) follow(*owner, chosen, k);
  if (Node* ends = copy.find("ends_at")) {
    follow(*ends, chosen, k);
    for (Node& end : ends->items)
      follow(end, chosen, k);
  }
  const std::string path = key_path(std::string(list.key), name_of(table));
  if (k > 0)
    dimension == 2 ? move_table<2>(copy, list.key, path, spec, k) : move_table<3>(copy, list.key, path, spec, k);
  return copy;
}

// Carries out one [[repeat]] on one list.
void repeat_list(const Subject& item, const CopiesSpec& spec, const RepeatedList& list, int dimension, Node& scene,
                 Naming& naming, std::size_t& made) {
  const Names& stated = spec.*list.names;
  if (stated.empty()) return;
  Node* tables = scene.find(list.key);
  const Names there = names_in(tables);
  for (const std::string& name : stated)
    if (!naming.knows(name) && std::ranges::find(there, name) == there.end())
      refuse(item, list.key,
             fmt::format("no {} named '{}'; {}", list.one, one_line(name, 60), suggestion(name, there)));
  const NameSet chosen = naming.take(stated), taken(there.begin(), there.end());

  std::vector<Node> all;
  for (const Node& table : tables->items) {
    const std::string name = name_of(table);
    if (!chosen.contains(name)) {
      all.push_back(table);
      continue;
    }
    made += values_in(table) * static_cast<std::size_t>(spec.count);
    if (made > most_values)
      refuse(item, "count", fmt::format("makes more than {} values in copies; lower it", most_values));
    for (int k = 0; k < spec.count; ++k) {
      if (taken.contains(copy_name(name, k)))
        refuse(item, list.key,
               fmt::format("makes a copy '{}', but one of [[{}]] already has this name; rename that one",
                           one_line(copy_name(name, k), 60), list.key));
      all.push_back(copy_of(table, list, spec, chosen, k, dimension));
    }
  }
  tables->items = std::move(all);
  naming.repeat(chosen, spec.count);
}

// removes the tables of these names from a list
std::vector<Node> taken_out(Node* list, const NameSet& names) {
  std::vector<Node> out, left;
  if (!list || list->kind != Node::Kind::list || names.empty()) return out;
  for (Node& item : list->items)
    (names.contains(name_of(item)) ? out : left).push_back(std::move(item));
  list->items = std::move(left);
  return out;
}

}  // namespace

bool addresses_copy(const Node& scene, const std::string& override_text) {
  const std::string path = override_text.substr(0, override_text.find('='));
  for (const RepeatedList& list : repeated_lists) {
    const std::string begin = std::string(list.key) + ".";
    const std::size_t at = path.find_first_not_of(" \t");
    if (at == std::string::npos || path.compare(at, begin.size(), begin) != 0) continue;
    const std::size_t name_begin = at + begin.size(), end = path.find('.', name_begin);
    if (end == std::string::npos) return false;
    const std::string name = path.substr(name_begin, end - name_begin);
    const Names there = names_in(scene.find(list.key));
    return std::ranges::find(there, name) == there.end() && copies_to_come(scene, list).contains(name);
  }
  return false;
}

void repeat_tables(Node& scene) {
  if (!scene.find("repeat")) return;
  // a table that changes a copy is incomplete: it is applied when the copies exist
  std::array<std::vector<Node>, repeated_lists.size()> changes;
  for (std::size_t i = 0; i < repeated_lists.size(); ++i)
    changes[i] = taken_out(scene.find(repeated_lists[i].key), copies_to_come(scene, repeated_lists[i]));
  check_keys(scene);

  const int dimension = scene_dimension(scene);
  const Node repeats = scene;  // the subjects below point into it
  std::array<Naming, repeated_lists.size()> naming;
  std::size_t made = 0;
  for (const Subject& item : children({&repeats, ""}, "repeat")) {
    CopiesSpec spec;
    read_keys(*item.node, "copies", spec);
    check_spec(item, spec, dimension);
    for (std::size_t i = 0; i < repeated_lists.size(); ++i)
      repeat_list(item, spec, repeated_lists[i], dimension, scene, naming[i], made);
  }
  std::erase_if(scene.members, [](const Member& member) { return member.key == "repeat"; });

  for (std::size_t i = 0; i < repeated_lists.size(); ++i)
    for (const Node& change : changes[i])
      for (Node& table : scene.find(repeated_lists[i].key)->items)
        if (name_of(table) == name_of(change)) lay_over(table, change);
}

}  // namespace voussoir
