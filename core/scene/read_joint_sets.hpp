// Reads the joint sets of a scene.
#pragma once

#include <vector>

#include "core/scene/scene_spec.hpp"

namespace voussoir {

std::vector<JointSetSpec> read_joint_sets(const Subject& scene, int dimension);

}  // namespace voussoir
