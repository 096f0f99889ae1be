// Joints that end at others, which they name, or at the face of an excavation: `ends_at`.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "core/scene/scene_spec.hpp"
#include "core/slicing/joint.hpp"

namespace voussoir {

// The half-spaces to which a joint is confined by its ends: at a joint the side that contains its own point; at an
// excavation the side of the face that its point sees, or the inside if its point is there. `domain` is seen from
// `origin`. Throws SceneError if a named joint or excavation does not exist, is stated later, has no outline, is
// parallel or is never met, or contains the point.
template <int Dim>
HalfSpaces<Dim> end_bounds(const Scene& scene, std::size_t joint, const Polytope<Dim>& domain,
                           const Vector<Dim>& origin);

// Confines the cuts of joints that end at others, and moves each of them after those at which it ends, which must have
// cut the rock before; the order of the cuts is otherwise unchanged. `faces` are the joints along each excavation's
// outline.
template <int Dim>
void end_cuts(const Scene& scene, const Polytope<Dim>& domain, const Vector<Dim>& origin,
              const std::vector<std::vector<int>>& faces, std::vector<Cut<Dim>>& cuts);

}  // namespace voussoir
