// Sides that waves leave: quiet and free_field of [[stage.boundary]].
#pragma once

#include <vector>

#include "core/base/settings.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Reads such a side, if the table states one, into the plan, whose selector has been read; appends its records to those
// of the stage. False: the table states a stress.
bool read_open_side(const Subject& table, int dimension, BoundaryPlan& plan, std::vector<RecordSpec>& records);

// Rules between stages: once a side is open there is no equilibrium to seek, and its blocks must stay.
void check_open_sides(const std::vector<StageSpec>& stages);

// Refuses sides of the stages that cannot be opened, with the reason (core/stage/medium.hpp).
template <int Dim>
void check_open_sides(const std::vector<StageSpec>& stages, Model<Dim> model);

}  // namespace voussoir
