#include "core/scene/preset.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/preset.hpp"
#include "core/contact/integrable.hpp"

namespace voussoir {
namespace {

std::string_view text_of(const Node& table, std::string_view key, std::string_view usual) {
  const Node* stated = table.find(key);
  return stated ? std::string_view(stated->text) : usual;
}

// A scene that chooses how its contacts act keeps its choice. Contacts of potential particles are points.
bool leaves_contacts_open(const Node& scene) {
  if (const Node* contact = scene.find("contact"))
    for (const char* key : {"face", "normal", "point", "overlap", "smoothing"})
      if (contact->find(key)) return false;
  const Node* blocks = scene.find("blocks");
  return !blocks || std::ranges::none_of(blocks->items, [](const Node& block) {
    return text_of(block, "shape", "half_spaces") == "potential";
  });
}

// what decides in which tables a setting applies
struct PresetTarget {
  const Node& scene;
  bool open_contacts;
  const std::vector<PropertiesSpec>& properties;

  bool some_integrable() const {
    return std::ranges::any_of(properties, [](const PropertiesSpec& p) { return can_be_integrated(p.properties); });
  }

  bool is_of_lining(const std::string& name) const {
    const Node* linings = scene.find("linings");
    return linings && std::ranges::any_of(linings->items, [&](const Node& lining) {
             return text_of(lining, "joint_properties", "") == name;
           });
  }

  bool applies(PresetScope scope, const Node& table, std::size_t index) const {
    const bool search = text_of(table, "kind", "") == "reduce";
    const std::string_view method = text_of(table, "method", "bisection");
    const bool rate = method == "rate" || method == "two_rates";
    const bool displacement = text_of(table, "failure_criterion", "") == "displacement" ||
                              table.find("failure_displacement") || table.find("failure_fraction");
    switch (scope) {
      case PresetScope::everywhere:
        return true;
      case PresetScope::integrable_faces:
        return open_contacts && some_integrable();
      case PresetScope::faces_by_points:
        return open_contacts && !can_be_integrated(properties[index].properties);
      case PresetScope::bonded_joints:
        return properties[index].properties.laws.bond && !is_of_lining(properties[index].properties.name);
      case PresetScope::watched_searches:
        return search && method == "bisection" && !displacement;
      case PresetScope::scenes_with_these: {
        const Node* stages = scene.find("stage");
        return stages && std::ranges::any_of(stages->items, [&](const Node& stage) {
                 return applies(PresetScope::watched_searches, stage, 0);
               });
      }
      case PresetScope::searches_by_steps:
        return search && !rate && (method == "steps" || displacement);
      case PresetScope::motions:
        return search && rate;
    }
    return false;
  }
};

Node value_of(const PresetSetting& setting, const Place& place) {
  Node node;
  node.place = place;
  if (const auto* text = std::get_if<std::string_view>(&setting.value)) {
    node.kind = Node::Kind::text;
    node.text = *text;
  } else {
    node.kind = Node::Kind::integer;
    node.number = std::get<int>(setting.value);
  }
  return node;
}

}  // namespace

std::vector<std::string> apply_preset(Node& scene, const std::vector<PropertiesSpec>& properties) {
  std::vector<std::string> done;
  if (text_of(scene, "preset", standard_preset) != standard_preset) return done;
  const PresetTarget target{scene, leaves_contacts_open(scene), properties};
  const auto set = [&](Node& table, const std::string& path, const PresetSetting& setting, std::size_t index) {
    if (table.find(setting.key) || !target.applies(setting.scope, table, index)) return;
    table.set(setting.key, value_of(setting, table.place));
    done.push_back(fmt::format("{} = {}", key_path(path, setting.key), value_text(*table.find(setting.key))));
  };

  for (const PresetSetting& setting : standard_settings) {
    if (setting.table.empty()) {
      set(scene, "", setting, 0);
      continue;
    }
    const std::string name(setting.table);
    Node* table = scene.find(name);
    const bool of_scene = setting.table == "contact" || setting.table == "accuracy";
    if (!table && of_scene && target.applies(setting.scope, scene, 0)) {
      Node empty;
      empty.place = scene.place;
      table = &scene.set(name, empty);
    }
    if (!table) continue;
    if (table->kind == Node::Kind::table) set(*table, name, setting, 0);
    if (table->kind == Node::Kind::list)
      for (std::size_t k = 0; k < table->items.size(); ++k)
        set(table->items[k], item_path(name, table->items[k], k), setting, k);
  }
  return done;
}

}  // namespace voussoir
