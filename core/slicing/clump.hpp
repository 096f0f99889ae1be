// The parts that joints made: excavated, held together, or kept apart (Boon 2013, section 3.2.5).
#pragma once

#include <vector>

#include "core/geometry/polytope.hpp"
#include "core/slicing/joint.hpp"

namespace voussoir {

// the face in which a part below and a part above a joint touch
struct SharedFace {
  int joint = 0;
  int below = 0, above = 0;  // parts
  double area = 0;           // m² (2-D: m)
  bool covered = true;       // it is within the joint's extent
};

// Every pair of parts that share an area of a joint, by joint, part below, part above.
template <int Dim>
std::vector<SharedFace> shared_faces(const std::vector<Polytope<Dim>>& parts, const std::vector<Cut<Dim>>& cuts);

// The body of each part, numbered in the order of the parts. Parts are one body if they share a face of a construction
// joint and, with `heal`, if the joint between them does not cover all of the face they share: Yu et al. (2009), who
// cut by infinite planes, not by extents as here, so that far fewer parts have to be joined.
template <int Dim>
std::vector<int> bodies_of(const std::vector<Polytope<Dim>>& parts, const std::vector<Cut<Dim>>& cuts, bool heal);

// the parts whose centroids lie outside a convex region, in the same order
template <int Dim>
std::vector<Polytope<Dim>> excavated(std::vector<Polytope<Dim>> parts, const HalfSpaces<Dim>& region);

// A tunnel: the prism of `sides` sides about the axis from one point to another, touching a cylinder of this radius
// from outside, as joints that outline it and as a region. `turn` (rad) turns it about its axis.
HalfSpaces<3> cylinder_region(const Vector<3>& from, const Vector<3>& to, double radius, int sides, double turn = 0);
HalfSpaces<2> circle_region(const Vector<2>& centre, double radius, int sides, double turn = 0);

}  // namespace voussoir
