// Where a stated joint ends.
#pragma once

#include "core/geometry/outline.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Seen from `origin`; the normal is that of the joint's plane. SceneError where a polygon's corners lie beside the
// plane or are those of no convex polygon.
template <int Dim>
Outline<Dim> outline_of(const JointSpec& joint, const Vector<Dim>& upward_normal, const Vector<Dim>& origin);

}  // namespace voussoir
