// The points of an opening's wall that a monitor follows.
#pragma once

#include <vector>

#include "core/model/prepared.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// The first points of rock on rays from the opening's centre (in 3-D perpendicular to its axis, at the middle) after
// its excavation. Throws SceneError if the opening is not known or has no centre, or if a ray meets no rock, or rock
// that a later stage excavates.
template <int Dim>
std::vector<WallPoint> wall_points(const Scene& scene, const Prepared<Dim>& prepared, const MonitorSpec& spec);

}  // namespace voussoir
