// Grids and samples of a study: several keys at once, in every combination of their values or drawn at random.
#pragma once

#include "app/study/sweep.hpp"
#include "core/scene/node.hpp"

namespace voussoir {

// Both give a sweep without name, scene and overrides. Throw SceneError.
Sweep read_grid(const Subject& table);

// A value is drawn by seed, row and key alone, with the same bits on every platform: a row does not depend on how many
// there are, on the other keys, or on who asks for it.
Sweep read_sample(const Subject& table);

}  // namespace voussoir
