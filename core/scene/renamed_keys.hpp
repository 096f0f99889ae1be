// Keys of a scene that had another name: the earlier name stays an alias of the present one.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/node.hpp"

namespace voussoir {

// Paths of keys, without the names of the tables of a list.
struct RenamedKey {
  std::string_view earlier, present;
};

// In the order in which they are applied: a table is renamed before its keys.
inline constexpr RenamedKey renamed_keys[] = {
    {"damping.statics", "statics"},
    {"damping.increments", "static_increments"},
    {"joints.whole", "joints.fixed_side"},
    {"stage.damping.statics", "stage.statics"},
    {"stage.damping.increments", "stage.static_increments"},
    {"stage.let_off", "stage.excavation_forces"},
    {"stage.excavation_forces.share", "stage.excavation_forces.remaining"},
};

// Gives every key of a tree, as one file or one override states it, its present name; adds a line for each to `met`:
// "scene.toml:7: stage.dig.let_off is now stage.dig.excavation_forces". Refuses a key that is stated under both names.
// `table` is the top of the file, or the table at `path`, whose path of keys is `keys`.
void take_present_names(Node& table, const std::string& keys, const std::string& path, std::vector<std::string>& met);

// The path of an override in segments, with present names.
std::vector<std::string> with_present_names(std::vector<std::string> segments);

// A whole scene with the names that keys had first. A hash of it does not depend on later names.
Node with_earliest_names(Node scene);

}  // namespace voussoir
