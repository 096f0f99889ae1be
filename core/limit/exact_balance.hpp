// Forces at corners in exact balance with loads, closed along a tree of bodies.
#pragma once

#include <optional>

#include "core/limit/exact_numbers.hpp"
#include "core/limit/limit.hpp"

namespace voussoir {

template <int Dim>
struct BalancedForces {
  int unit = 0;                                                // exponent: forces are integers times 2^unit N
  std::vector<std::vector<Numbers<Integer, Dim>>> at_corners;  // by face and corner, on body_b
  double change = 0;  // the largest of a corner's force, in units of the lighter body's weight
  int depth = 0;      // of the tree
};

// Forces near the given ones whose sum with dead + factor · live is exactly zero for every free freedom. Each body's
// remainder goes to three corners (in the plane both ends) of the face that leads to its parent, from the leaves to the
// bodies that are held. Coordinates are multiples of 2^grid m, so that the equations of a face are some of integers; if
// the differences of its corners have a common divisor, corners of `assembly` move by one unit of the grid. Nothing: a
// body has no face towards held ones.
template <int Dim>
std::optional<BalancedForces<Dim>> balance_exactly(CornerAssembly<Dim>& assembly, int grid, const Loads<Dim>& dead,
                                                   const Loads<Dim>& live, double factor,
                                                   const CornerForces<Dim>& forces);

// the cohesion of each corner of a face, N: its share of the area, at most the exact one
template <int Dim>
std::vector<double> cohesion_at_corners(const CornerFace<Dim>& face);

}  // namespace voussoir
