// The outline of a stated joint.
#pragma once

#include "core/geometry/outline.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Seen from `origin`; the normal is that of the joint's plane. SceneError if a polygon's corners are off the plane or
// do not form a convex polygon.
template <int Dim>
Outline<Dim> outline_of(const JointSpec& joint, const Vector<Dim>& upward_normal, const Vector<Dim>& origin);

}  // namespace voussoir
