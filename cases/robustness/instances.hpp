// Seeded random instances: two blocks, or a block and a plane, that meet at a stated depth, with one difficulty.
#pragma once

#include <optional>

#include "cases/robustness/atlas.hpp"
#include "core/model/model.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::atlas {

using shapes::Random;

// one place of the map
struct Place {
  Axis axis = Axis::thinness;
  double value = 1;  // thinness, angle (rad), ratio of sizes, offset (m) or number of faces
  double depth = 0;  // of the smaller block's inscribed diameter: overlap or cap positive, gap negative
};

// The planes of the two blocks, each about a position of its own, `made` metres away. The first has the difficulty.
struct Shapes {
  HalfSpaces<3> a, b;
  Vector<3> made = Vector<3>::Zero();  // m
};
Shapes random_shapes(const Place& place, Random& random);

// A corner, an edge or a face of a block: a point on it and a direction in which no other point is farther.
struct Feature {
  Vector<3> point, direction;
};

// Two bodies that meet at features chosen at random, each in its own frame; world = reference + displacement.
struct Meeting {
  Body<3> a, b;
  Rotation<3> turn;                              // of b
  Vector<3> displacement_b = Vector<3>::Zero();  // m; a has none and is not rotated
};
Meeting meet(const Polytope<3>& a, const Polytope<3>& b, const Place& place, int kind, Random& random);

// A plane whose outer side cuts a cap of the stated depth off the block.
HalfSpace<3> cutting_plane(const Polytope<3>& block, const Place& place, int kind, Random& random);

}  // namespace voussoir::atlas
