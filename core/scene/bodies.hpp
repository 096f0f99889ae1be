// The solids of a scene: the domain and the blocks given directly, seen from an origin in their middle.
#pragma once

#include "core/model/model.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

template <int Dim>
Vector<Dim> to_vector(const std::vector<double>& numbers) {
  return Eigen::Map<const Vector<Dim>>(numbers.data());
}

// the plane of a joint or of the domain's boundary, with upward normal
template <int Dim>
HalfSpace<Dim> to_half_space(const PlaneSpec& plane, const Vector<Dim>& origin);

// the six half-spaces of a box, four in 2-D
template <int Dim>
HalfSpaces<Dim> box_planes(const BoxSpec& box, const Vector<Dim>& origin);

// Centre of all solids, so that a scene far from the file's origin loses no digits.
template <int Dim>
Vector<Dim> find_origin(const Scene& scene);

// The scene's domain, and one of its blocks (of a potential particle only its planes). Both throw SceneError if a solid
// is open, empty, flat or too far away.
template <int Dim>
Polytope<Dim> make_domain(const Scene& scene, const Vector<Dim>& origin);
template <int Dim>
Polytope<Dim> make_solid(const Scene& scene, const BlockSpec& block, const Vector<Dim>& origin);

}  // namespace voussoir
