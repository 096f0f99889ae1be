// What in a scene's stated values looks like a mistake of unit or sign. Nothing here is an error: each warning is one
// line with file, line, key and value.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace voussoir {

// Every value outside the usual range of its key (scene/keys.hpp); then what several values tell together: the
// direction of gravity, swapped stiffnesses, sizes of blocks, coordinates next to zero, planes and joints that miss the
// domain.
template <int Dim>
std::vector<std::string> implausible_values(const Scene& scene, const Prepared<Dim>& prepared);

}  // namespace voussoir
