// Directions across parts that are thin: the shape of inclined slabs and columns that boxes along the axes do not show.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/polytope.hpp"

namespace voussoir {

// a part and its orientation
template <int Dim>
struct TurnedPart {
  const Polytope<Dim>* part;
  Matrix<Dim> axes;  // its body's frame in world axes
};

// Up to Dim - 1 directions, unit, across which the parts together are less than half as wide as along any axis; of some
// of their faces' normals the best, none if parts are as wide as high. The same for any number of threads.
template <int Dim>
std::vector<Vector<Dim>> thin_directions(std::span<const TurnedPart<Dim>> parts);

}  // namespace voussoir
