// Cutting a domain by persistent joints, one after the other (Boon 2013, chapter 3.2).
#pragma once

#include <vector>

#include "core/geometry/polytope.hpp"

namespace voussoir {

// a persistent joint: an infinite plane; the number is what the faces it makes remember
template <int Dim>
struct Cut {
  HalfSpace<Dim> plane;  // upward normal, unit
  int joint;
};

struct SlicingLimits {
  double smallest_inscribed_radius = 0;  // m: a cut that would leave a smaller child is undone in that block
  std::size_t most_blocks = 100'000;     // n joints make up to n³/6 blocks: beyond this, slicing gives up
};

struct SlicingCounters {
  long long lp_solves = 0;
  long long cuts = 0;     // blocks split
  long long undone = 0;   // cuts refused because a child would be too small
  bool given_up = false;  // the blocks are not all that the joints make
};

// The blocks in canonical order (centroid, then volume); fewer than the joints make when counters.given_up. A joint
// cuts a block iff the LP of Eq. 3.7 on the joint's plane lies below -1e-10 of the block's size.
template <int Dim>
std::vector<Polytope<Dim>> slice(const Polytope<Dim>& domain, const std::vector<Cut<Dim>>& cuts,
                                 const SlicingLimits& limits, SlicingCounters& counters);

}  // namespace voussoir
