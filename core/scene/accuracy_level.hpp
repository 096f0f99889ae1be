// [accuracy] level: fills in the settings that a scene leaves to it.
#pragma once

#include <string>
#include <vector>

#include "core/scene/node.hpp"

namespace voussoir {

// Adds the settings of the level that the scene names, or that an accuracy asked for begins with
// (core/base/accuracy.hpp) to its tree, where it does not state them itself, and says which: "equilibrium.unbalanced =
// 1e-06". Without a level, or with one that does not exist, it does nothing: check_keys complains about that.
std::vector<std::string> apply_accuracy_level(Node& scene);

}  // namespace voussoir
