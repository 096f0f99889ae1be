// The bodies of a scene, stated block by block, each with the parts that other blocks add to it (part_of).
#pragma once

#include "core/geometry/polytope.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

template <int Dim>
struct StatedBody {
  const BlockSpec* block = nullptr;  // whose name, density and motion it has
  std::vector<Polytope<Dim>> parts;  // seen from the origin
};

// In the order of the scene. Throws SceneError for a part without a body, and for two parts of one body that share more
// than 1e-6 of the smaller one's volume, because mass, weight, contact area and water would count twice. Parts may
// touch.
template <int Dim>
std::vector<StatedBody<Dim>> stated_bodies(const Scene& scene, const Vector<Dim>& origin);

}  // namespace voussoir
