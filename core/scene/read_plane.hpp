// A plane as joints, joint sets, domains and excavations state it.
#pragma once

#include "core/scene/scene_spec.hpp"

namespace voussoir {

// `group`: of the keys that state it
PlaneSpec read_plane(const Subject& subject, std::string_view group, int dimension);

}  // namespace voussoir
