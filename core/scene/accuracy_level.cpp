#include "core/scene/accuracy_level.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/accuracy.hpp"
#include "core/scene/accuracy_target.hpp"
#include "core/scene/keys.hpp"

namespace voussoir {
namespace {

// its column in the table
std::optional<std::size_t> level_of(const Node& scene) {
  const Node* accuracy = scene.find("accuracy");
  if (!accuracy || accuracy->kind != Node::Kind::table) return std::nullopt;
  const Node* level = accuracy->find("level");
  if (const Node* error = accuracy->find("error"); error && !level && error->kind == Node::Kind::text)
    if (const std::optional<AccuracyTarget> target = accuracy_target(error->text))
      return target->relative && target->size >= accuracy_promises[0] ? 0 : 1;
  if (!level || level->kind != Node::Kind::text) return std::nullopt;
  const auto found = std::find(accuracy_levels.begin(), accuracy_levels.end(), level->text);
  if (found == accuracy_levels.end()) return std::nullopt;
  return static_cast<std::size_t>(found - accuracy_levels.begin());
}

bool states_dashpots(const Node& table) {
  const Node* damping = table.find("damping");
  const Node* ratio = damping && damping->kind == Node::Kind::table ? damping->find("viscous_ratio") : nullptr;
  return ratio && ratio->is_number() && ratio->number > 0;
}

// the tables of [[stage]]; none if the file states something else there
std::vector<Node*> stages_of(Node& scene) {
  std::vector<Node*> stages;
  if (Node* list = scene.find("stage"); list && list->kind == Node::Kind::list)
    for (Node& item : list->items)
      if (item.kind == Node::Kind::table) stages.push_back(&item);
  return stages;
}

bool has_dashpots(Node& scene) {
  const std::vector<Node*> stages = stages_of(scene);
  return states_dashpots(scene) ||
         std::any_of(stages.begin(), stages.end(), [](const Node* stage) { return states_dashpots(*stage); });
}

Node level_value(double value, const Place& place) {
  Node node;
  node.kind = value == std::floor(value) ? Node::Kind::integer : Node::Kind::number;
  node.number = value;
  node.place = place;
  return node;
}

// with a fixed step the fraction of the limit has no meaning
bool is_settled(const Node& table, const LevelSetting& setting) {
  return table.find(setting.key) || (setting.table == "time" && table.find("step_s"));
}

}  // namespace

std::vector<std::string> apply_accuracy_level(Node& scene) {
  std::vector<std::string> done;
  const std::optional<std::size_t> level = level_of(scene);
  if (!level) return done;
  const Place stated = scene.find("accuracy")->place;
  const bool dashpots = has_dashpots(scene);
  const auto set = [&](Node& table, const std::string& path, const LevelSetting& setting) {
    if (is_settled(table, setting)) return;
    table.set(setting.key, level_value(setting.values[*level], stated));
    done.push_back(fmt::format("{} = {}", key_path(path, setting.key), setting.values[*level]));
  };

  for (const LevelSetting& setting : level_settings) {
    if (setting.with_dashpots && !dashpots) continue;
    if (setting.table == "stage") {
      const std::vector<Node*> stages = stages_of(scene);
      for (std::size_t k = 0; k < stages.size(); ++k)
        if (key_applies(*stages[k], {"stage"}, *find_row({"stage"}, setting.key)))
          set(*stages[k], item_path("stage", *stages[k], k), setting);
      continue;
    }
    if (!scene.find(setting.table)) {
      Node empty;
      empty.place = stated;
      scene.set(setting.table, empty);
    }
    if (Node* table = scene.find(setting.table); table->kind == Node::Kind::table)
      set(*table, std::string(setting.table), setting);
  }
  return done;
}

}  // namespace voussoir
