// Regular polyhedra of the benchmarks: circumradius 0.5, so that their size is 1; centroid at the origin.
#pragma once

#include "core/testing/shapes.hpp"

namespace voussoir::benchmarks {

using shapes::Random;

inline constexpr int platonic_count = 5;

// 0 tetrahedron, 1 cube, 2 octahedron, 3 dodecahedron, 4 icosahedron
inline Polytope<3> platonic(int kind) {
  const HalfSpaces<3> planes = shapes::platonic_solids(1)[kind].planes;
  return shapes::centred_block<3>(shapes::scaled<3>(planes, 0.5 / shapes::block<3>(planes).radius));
}

inline const char* platonic_name(int kind) {
  static const char* const names[platonic_count] = {"tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"};
  return names[kind];
}

}  // namespace voussoir::benchmarks
