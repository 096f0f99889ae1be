// What in a scene's stated values looks like a mistake of unit or sign. Nothing here is an error: each warning is one
// line with file, line, key and value.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace voussoir {

// Gravity, densities, stiffnesses, angles, sizes, and joints that cut nothing.
template <int Dim>
std::vector<std::string> implausible_values(const Scene& scene, const Prepared<Dim>& prepared);

}  // namespace voussoir
