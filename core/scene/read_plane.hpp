// A plane as joints, joint sets, domains and excavations state it.
#pragma once

#include "core/scene/scene_spec.hpp"

namespace voussoir {

void read_plane(const Subject& subject, int dimension, PlaneSpec& plane);

}  // namespace voussoir
