// A mesh of a potential particle's surface, to be drawn.
#pragma once

#include "core/geometry/polytope.hpp"
#include "core/potential/shape.hpp"

namespace voussoir {

template <int Dim>
struct PotentialDrawing {
  std::vector<Vector<Dim>> points;      // on the surface, to rounding; the shape's frame
  std::vector<std::vector<int>> cells;  // 3-D: triangles, counter-clockwise seen from outside; 2-D: the outline
  // m: no point of the surface is farther from the mesh, which is inside the body; a bound, as derived below
  double error = 0;
};

// Rays from the sphere's centre through points of the faces of a polytope that encloses the body; they are dense where
// it is rounded. Along a ray between the points p of a cell, with outward normals n, the surface lies within
//   (max |p| / min n_i·p_j) max (n_i - n_j)·(p_i - p_j) / 3    (2-D: / 4)
// of the chord: it is below every tangent, so below any mean of them, and Σ w_i w_j over the pairs of three weights is
// at most 1/3, of two 1/4. Faces are divided until that is a hundredth of the sphere's radius, or as often as
// permitted.
template <int Dim>
PotentialDrawing<Dim> draw(const PotentialShape<Dim>& shape, const Polytope<Dim>& enclosing);

}  // namespace voussoir
