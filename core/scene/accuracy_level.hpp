// [accuracy] level: sets the settings that a scene does not state itself.
#pragma once

#include <string>
#include <vector>

#include "core/scene/node.hpp"

namespace voussoir {

// Adds to the tree the settings of the scene's level, or of the level at which a required accuracy begins
// (core/base/accuracy.hpp), unless the scene states them itself, and returns them: "equilibrium.unbalanced = 1e-06".
// Without a level, or with one that does not exist, it does nothing: check_keys complains about that.
std::vector<std::string> apply_accuracy_level(Node& scene);

}  // namespace voussoir
