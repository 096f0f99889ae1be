#include "app/study/idle.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "core/joint_sets/statistics.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/shared_stages.hpp"
#include "text/plain_text.hpp"

namespace voussoir {
namespace {

using Names = std::set<std::string>;

// relative difference of results that is due to rounding
constexpr double rounding_of_results = 1e-12;

// the number of other values of a key that are tried in place of the first
constexpr std::size_t most_tried = 3;

// ---- the input of a run -------------------------------------------------------------------------------------------

void forget(Node& table, std::string_view key) {
  std::erase_if(table.members, [&](const Member& member) { return member.key == key; });
}

bool names_one(const Node* list, const std::string& name) {
  return list && std::ranges::any_of(list->items, [&](const Node& item) {
           return item.text == name || (item.kind == Node::Kind::table && name_of(item) == name);
         });
}

// Whether a stage replaces the friction angle of these joint properties. A search for an angle does not: it starts from
// the present one.
bool replaces_friction(const Node& stage, const std::string& properties) {
  return stage.find("friction_deg") || names_one(stage.find("friction"), properties);
}

// of linings, by name of their properties
Names interfaces_of(const Node& tree) {
  Names names;
  if (const Node* linings = tree.find("linings"))
    for (const Node& lining : linings->items)
      if (const Node* properties = lining.find("joint_properties")) names.insert(properties->text);
  return names;
}

// those that contacts may have: of joints, of sets, of linings, and of faces that no joint made
Names properties_in_use(const Scene& scene, const Node& tree) {
  Names names = interfaces_of(tree);
  names.insert("default");
  if (!scene.properties.empty()) names.insert(scene.properties.front().properties.name);
  for (const JointSpec& joint : scene.joints)
    if (joint.properties) names.insert(*joint.properties);
  for (const JointSetSpec& set : scene.joint_sets)
    if (set.properties) names.insert(*set.properties);
  return names;
}

// a strength that never acts only matters by being stated
void forget_amount(Node& table, std::string_view key) {
  if (Node* node = table.find(key); node && node->is_number()) node->number = node->number > 0 ? 1 : 0;
}

template <class Change>
void each_properties(Node& tree, const Change& change) {
  if (Node* all = tree.find("joint_properties"))
    for (Node& item : all->items)
      change(item, name_of(item));
}

void forget_unused_properties(const Scene& scene, Node& tree) {
  const Names used = properties_in_use(scene, tree);
  each_properties(tree, [&](Node& item, const std::string& name) {
    if (!used.contains(name)) std::erase_if(item.members, [](const Member& m) { return m.key != "name"; });
  });
}

bool acts_as_sliced(const Node& properties) {
  const Node* bonds = properties.find("bonds");
  return bonds && bonds->text == "as_sliced";
}

// Friction that the first stage replaces, and strength of bonds that no stage makes, never act.
Node part_of_run(const Scene& scene, bool with_history) {
  Node tree = shared_part(scene, static_cast<int>(scene.stages.size()));
  if (const Node* monitors = scene.tree->find("monitors")) tree.set("monitors", *monitors);
  if (const Node* output = scene.tree->find("output"); output && with_history) tree.set("output", *output);
  forget_unused_properties(scene, tree);
  const Node* stages = tree.find("stage");
  const bool bonds = std::ranges::any_of(scene.stages, [](const StageSpec& stage) { return stage.plan.change.bond; });
  const Names interfaces = interfaces_of(tree);
  each_properties(tree, [&](Node& item, const std::string& name) {
    if (stages && replaces_friction(stages->items.front(), name)) forget(item, "friction_deg");
    if (bonds || interfaces.contains(name) || acts_as_sliced(item)) return;
    forget_amount(item, "cohesion");
    forget_amount(item, "tension");
  });
  return tree;
}

// Limit analysis uses blocks, their weight, water and strength, as they are before the first stage; of the stages only
// the applied forces.
Node part_of_limit(const Scene& scene, const std::vector<std::string>& options) {
  Node tree = shared_part(scene, static_cast<int>(scene.stages.size()));
  const auto asked = [&](const char* option) { return std::ranges::find(options, option) != options.end(); };
  if (asked("--decide")) return *scene.tree;  // which runs
  Names sought;
  for (std::size_t k = 0; k + 1 < options.size(); ++k)
    if (options[k] == "--friction") sought.insert(options[k + 1]);
  const bool seeks_friction = !asked("--factor") && !asked("--load");
  if (!asked("applied")) forget(tree, "stage");
  for (const char* key :
       {"accuracy", "statics", "static_increments", "damping", "time", "equilibrium", "initial_velocity", "contact"})
    forget(tree, key);
  forget_unused_properties(scene, tree);
  each_properties(tree, [&](Node& item, const std::string& name) {
    const bool cohesion = asked("--cohesion") || acts_as_sliced(item);
    std::erase_if(item.members, [&](const Member& m) {
      return m.key != "name" && m.key != "friction_deg" && !(cohesion && (m.key == "cohesion" || m.key == "bonds"));
    });
    if (seeks_friction && (sought.empty() || sought.contains(name))) forget(item, "friction_deg");
  });
  return tree;
}

// Block theory takes no steps; its scene need not have a stage.
Node part_of_blocks(const Scene& scene) {
  Node tree = *scene.tree;
  for (const char* key : {"title", "base", "output", "monitors", "accuracy", "statics", "static_increments", "damping",
                          "time", "equilibrium", "initial_velocity", "contact"})
    forget(tree, key);
  forget_unused_properties(scene, tree);
  return tree;
}

std::string text_of_part(const StudyPlan& plan, const Sweep& sweep, const std::vector<std::string>& overrides) {
  const Scene scene = read_scene(sweep.scene, overrides);
  if (!sweep.other) return canonical_text(part_of_run(scene, plan.history.has_value()));
  return canonical_text(sweep.other->name == "limit" ? part_of_limit(scene, sweep.other->options)
                                                     : part_of_blocks(scene));
}

// ---- keys ---------------------------------------------------------------------------------------------------------

std::vector<TiedKey> keys_of_sweep(const Sweep& sweep) {
  std::vector<TiedKey> keys = sweep.with;
  if (sweep.varied == Varied::one_key && !sweep.key.empty()) keys.insert(keys.begin(), {sweep.key, sweep.values});
  return keys;
}

// values other than the first: the last ones, and some between
std::vector<std::string> other_values(const TiedKey& key) {
  std::vector<std::string> others;
  for (const std::string& value : key.values)
    if (value != key.values.front() && std::ranges::find(others, value) == others.end()) others.push_back(value);
  if (others.size() <= most_tried) return others;
  return {others.front(), others[others.size() / 2], others.back()};
}

bool is_idle(const StudyPlan& plan, const Sweep& sweep, const TiedKey& key) {
  const std::vector<std::string> others = other_values(key);
  if (others.empty()) return false;
  std::vector<std::string> overrides = overrides_of(sweep, 0);
  const auto place = std::find(overrides.rbegin(), overrides.rend(), key.key + "=" + key.values.front());
  if (place == overrides.rend()) return false;
  try {
    const std::string first = text_of_part(plan, sweep, overrides);
    return std::ranges::all_of(others, [&](const std::string& value) {
      *place = key.key + "=" + value;
      return text_of_part(plan, sweep, overrides) == first;
    });
  } catch (const SceneError&) {
    return false;  // values that must change together; errors of a row are reported when it is read
  }
}

const char* kind_of_sweep(const Sweep& sweep) {
  switch (sweep.varied) {
    case Varied::grid:
      return "grid";
    case Varied::sample:
      return "sample";
    case Varied::reliability:
      return "reliability analysis";
    case Varied::one_key:
      break;
  }
  return "sweep";
}

// ---- results ------------------------------------------------------------------------------------------------------

struct Spread {
  std::vector<double> results;
  std::vector<double> error_bars;

  void add(const StudyRow& row) {
    if (!row.result) return;
    results.push_back(*row.result);
    if (row.error_bar) error_bars.push_back(*row.error_bar);
  }
  bool is_flat() const {
    const auto [least, most] = std::ranges::minmax_element(results);
    return *most - *least <= rounding_of_results * std::max(std::abs(*least), std::abs(*most));
  }
  double mean_bar() const {
    double sum = 0;
    for (const double bar : error_bars)
      sum += bar;
    return sum / static_cast<double>(error_bars.size());
  }
};

// Whether the results of a grid do not change with this key alone; false if there are none to compare.
bool is_flat_along(const Sweep& grid, std::size_t key, const std::vector<StudyRow>& rows) {
  std::map<std::vector<std::string>, Spread> lines;
  for (std::size_t place = 0; place < rows.size(); ++place) {
    std::vector<std::string> others;
    for (std::size_t k = 0; k < grid.with.size(); ++k)
      if (k != key) others.push_back(grid.with[k].values[place]);
    lines[others].add(rows[place]);
  }
  std::erase_if(lines, [](const auto& line) { return line.second.results.size() < 2; });
  return !lines.empty() && std::ranges::all_of(lines, [](const auto& line) { return line.second.is_flat(); });
}

std::vector<std::string> names_of(const std::vector<TiedKey>& keys) {
  std::vector<std::string> names;
  for (const TiedKey& key : keys)
    if (!other_values(key).empty()) names.push_back(one_line(key.key, 100));
  return names;
}

std::vector<std::string> flat_lines(const Sweep& sweep, const std::vector<StudyRow>& rows) {
  Spread all;
  for (const StudyRow& row : rows)
    all.add(row);
  const std::vector<std::string> names = names_of(keys_of_sweep(sweep));
  if (names.empty() || all.results.size() < 2) return {};
  const std::string of = fmt::format("{} '{}'", kind_of_sweep(sweep), one_line(sweep.name, 60));
  if (all.is_flat())
    return {fmt::format("{}: the results do not depend on {}: does the scene use {}, or does a stage state its own?",
                        of, fmt::join(names, ", "), names.size() == 1 ? "it" : "them")};
  const double deviation = moments_of(all.results).deviation;
  if (all.error_bars.size() == all.results.size() && deviation < all.mean_bar())
    return {
        fmt::format("{}: the deviation of the results, {:.2g}, is below their mean error bar, {:.2g}: the "
                    "differences may come from the search, not from {}",
                    of, deviation, all.mean_bar(), fmt::join(names, ", "))};
  std::vector<std::string> lines;
  for (std::size_t k = 0; sweep.varied == Varied::grid && k < sweep.with.size(); ++k)
    if (is_flat_along(sweep, k, rows))
      lines.push_back(fmt::format("{}: the results do not depend on {}: does the scene use it?", of,
                                  one_line(sweep.with[k].key, 100)));
  return lines;
}

}  // namespace

std::vector<std::string> idle_keys(const StudyPlan& plan) {
  std::vector<std::string> lines;
  for (const Sweep& sweep : plan.sweeps)
    for (const TiedKey& key : keys_of_sweep(sweep))
      if (is_idle(plan, sweep, key))
        lines.push_back(fmt::format(
            "{} '{}': {} acts in no {} of '{}': its values change nothing, because nothing uses it, or a stage "
            "replaces it "
            "by its own value; name the key that acts",
            kind_of_sweep(sweep), one_line(sweep.name, 60), one_line(key.key, 100), sweep.other ? "part" : "stage",
            sweep.scene.string()));
  return lines;
}

std::vector<std::string> flat_results(const StudyPlan& plan, const std::vector<StudyRow>& all) {
  std::vector<std::string> lines;
  std::size_t first = 0;
  for (const Sweep& sweep : plan.sweeps) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<StudyRow> rows(begin, begin + static_cast<std::ptrdiff_t>(sweep.values.size()));
    first += sweep.values.size() + (sweep.power ? sweep.values.size() - 1 : 0);
    for (std::string& line : flat_lines(sweep, rows))
      lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace voussoir
