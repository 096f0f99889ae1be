// Two convex parts whose contact is queried, and to which level.
#pragma once

#include "core/geometry/polytope.hpp"

namespace voussoir {

// how far a pair is resolved; each level contains those before it
enum class QueryLevel {
  decision,  // touching or not, with the proof
  point,     // and its place
  overlap,   // and direction, overlap and faces
  area       // and area
};

// Two parts in the frame of the first. Positions were subtracted (Eq. 3.26): no result depends on the place of the
// pair.
template <int Dim>
struct alignas(2 * sizeof(double)) Pair {
  const Polytope<Dim>* a = nullptr;
  const Polytope<Dim>* b = nullptr;
  Matrix<Dim> axes;      // frame of the first body -> world
  Matrix<Dim> rotation;  // frame of the second body -> frame of the first
  Vector<Dim> offset;    // centroid of the second body in the frame of the first, m
  QueryLevel level = QueryLevel::area;
};

}  // namespace voussoir
