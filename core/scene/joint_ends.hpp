// Where joints end at others that they name, or at the face of an excavation: `ends_at`.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "core/scene/scene_spec.hpp"
#include "core/slicing/joint.hpp"

namespace voussoir {

// The half-spaces that a joint is confined to by what it ends at: of a joint the side on which its own point lies; of
// an excavation the side of the face that its point sees, or the inside where its point lies there. `domain` is seen
// from `origin`. Throws SceneError where what is named does not exist, is stated later, has no outline, is parallel or
// is never met, and where the point lies on it.
template <int Dim>
HalfSpaces<Dim> end_bounds(const Scene& scene, std::size_t joint, const Polytope<Dim>& domain,
                           const Vector<Dim>& origin);

// Confines the cuts of joints that end at others, and puts each of them behind what it ends at, which must have parted
// the rock there before; the order of the cuts stays otherwise. `faces` are the joints along each excavation's outline.
template <int Dim>
void end_cuts(const Scene& scene, const Polytope<Dim>& domain, const Vector<Dim>& origin,
              const std::vector<std::vector<int>>& faces, std::vector<Cut<Dim>>& cuts);

}  // namespace voussoir
