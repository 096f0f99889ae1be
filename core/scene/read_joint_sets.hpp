// Planes as joints and domains state them, and the joint sets of a scene.
#pragma once

#include <vector>

#include "core/scene/scene.hpp"

namespace voussoir {

void read_plane(const Subject& subject, int dimension, PlaneSpec& plane);

std::vector<JointSetSpec> read_joint_sets(const Subject& scene, int dimension);

}  // namespace voussoir
