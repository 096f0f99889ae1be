// `preset`: the numerical choices that a scene does not state itself (core/base/preset.hpp).
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Adds to a checked tree the settings of its preset, unless the scene states them itself, and returns them:
// "statics = newton". `properties` are the joints' as stated.
std::vector<std::string> apply_preset(Node& scene, const std::vector<PropertiesSpec>& properties);

}  // namespace voussoir
