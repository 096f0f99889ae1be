// The surface of {x : a·x <= d}: its vertices and the loop of each face.
#pragma once

#include <vector>

#include "core/geometry/half_space.hpp"

namespace voussoir {

enum class SurfaceStatus {
  ok,
  open,       // the planes do not close a region, or one that extends far beyond their distance from the origin
  unresolved  // thinner somewhere than the rounding of its coordinates: the faces found do not fit together
};

template <int Dim>
struct Surface {
  SurfaceStatus status = SurfaceStatus::ok;
  std::vector<Vector<Dim>> vertices;    // m
  std::vector<std::vector<int>> loops;  // vertices of each face, counter-clockwise seen from outside (2-D: two ends)
};

// A box is cut by one plane after the other, the last plane first. Each cut decides once for every vertex on which side
// it is, so the faces always share their edges, at any angle between them; and the error of vertices is no more than
// the rounding of their coordinates, measured across the planes. More than Dim planes through a vertex is normal input.
// A plane that would cut off less than `negligible` (m) has an empty loop: of coincident planes the last has the face.
// The origin must lie inside, deeper than that.
template <int Dim>
Surface<Dim> find_surface(const HalfSpaces<Dim>& faces, double negligible);

}  // namespace voussoir
