// Velocities that a scene states, and the factor by which they vary.
#pragma once

#include "core/scene/scene_spec.hpp"

namespace voussoir {

MotionSpec read_motion(const Subject& table);

// of velocities or of a force; its times ascend and each has a factor
TimeFactor read_factor(const Subject& table);

// Of a table whose `factor` are records: throws SceneError if it states a velocity or its factor as well.
void refuse_beside_records(const Subject& table);

}  // namespace voussoir
