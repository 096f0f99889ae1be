// The half-spaces of a convex region of a scene.
#pragma once

#include "core/geometry/half_space.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// seen from `origin`
template <int Dim>
HalfSpaces<Dim> region_planes(const RegionSpec& spec, const Vector<Dim>& origin);

}  // namespace voussoir
