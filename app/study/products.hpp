// Grids, samples and reliability analyses of a study: several keys together, in all combinations of their values or
// drawn at random.
#pragma once

#include "app/study/sweep.hpp"
#include "core/scene/node.hpp"

namespace voussoir {

// These give a sweep without name, scene and overrides. Throw SceneError.
Sweep read_grid(const Subject& table);

// A value is drawn from seed, row and key alone, with the same bits on every platform: a row does not depend on the
// number of rows, on the other keys, or on the process that draws it.
Sweep read_sample(const Subject& table);
Sweep read_reliability(const Subject& table);
// the rows of a sample whose command is known
void draw_rows(const Subject& table, Sweep& sample);

}  // namespace voussoir
