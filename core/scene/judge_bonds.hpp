// Stated tension and cohesion that have no effect, or another one than was probably meant.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene_spec.hpp"

namespace voussoir {

// one line each, with file, line, key and value
std::vector<std::string> judge_bonds(const Scene& scene);

}  // namespace voussoir
