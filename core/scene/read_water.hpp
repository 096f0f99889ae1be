// Reads a scene's water: its state before the first stage, and its changes.
#pragma once

#include <vector>

#include "core/scene/scene_spec.hpp"

namespace voussoir {

std::vector<WaterSpec> read_waters(const Subject& scene, int dimension);

// The changes that the stages state, one after the other: each starts from the end of the last one. A level that later
// becomes a table has its points from the start, a table that becomes a level keeps them.
void read_water_changes(std::vector<WaterSpec>& waters, std::vector<StageSpec>& stages, int dimension);

}  // namespace voussoir
