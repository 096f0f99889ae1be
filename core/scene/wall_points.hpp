// Where a monitor follows the wall of an opening.
#pragma once

#include <vector>

#include "core/model/prepared.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Where rays from the opening's centre, in space across the middle of its axis, first meet rock once it has been taken
// out, by the stage that does so or before the first one. Throws SceneError where the opening is not known or has no
// centre, or a ray meets no rock, or rock that a later stage takes out.
template <int Dim>
std::vector<WallPoint> wall_points(const Scene& scene, const Prepared<Dim>& prepared, const MonitorSpec& spec);

}  // namespace voussoir
