// Planes of joints, joint sets, domains and excavations.
#pragma once

#include "core/scene/scene_spec.hpp"

namespace voussoir {

// `group`: the group of the plane's keys
PlaneSpec read_plane(const Subject& subject, std::string_view group, int dimension);

}  // namespace voussoir
