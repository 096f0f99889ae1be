// Cutting a domain by joints, one after the other (Boon 2013, chapter 3.2). A joint cuts right through the blocks that
// its extent meets: it ends at their faces.
#pragma once

#include <vector>

#include "core/geometry/polytope.hpp"
#include "core/slicing/joint.hpp"

namespace voussoir {

enum class AspectMeasure {
  box,   // longest over shortest edge of the box along the axes around the block
  balls  // circumscribed over inscribed radius, the outer ball about the middle of that box
};

// Construction joints cut even if their pieces break these limits: an outline is exact.
struct SlicingLimits {
  double smallest_inscribed_radius = 0;  // m: a cut that would leave a smaller child is not made in that block
  double largest_aspect_ratio = std::numeric_limits<double>::infinity();  // likewise one that is more elongated
  AspectMeasure aspect_measure = AspectMeasure::box;
  std::size_t most_blocks = 1'000'000;  // n joints make up to n³/6 blocks: beyond this, slicing gives up
  int threads = 1;                      // the same blocks for any number
  bool culling = true;                  // false: every joint is tried on every block, to measure the saving by culling
};

struct SlicingCounters {
  long long tests = 0;      // of a joint against a block by bounds
  long long lp_solves = 0;  // those that the bounds left to the linear program
  long long cuts = 0;       // blocks split
  long long undone = 0;     // cuts refused because a child would be too small or elongated
  bool given_up = false;    // too many blocks
};

// The blocks in canonical order (centroid, then volume); none when counters.given_up. A joint cuts a block iff the LP
// of Eq. 3.16, or of Eq. 3.7 if it has no end, is below -1e-10 of the block's inscribed radius. A refused cut leaves
// the parent, bit for bit. Cuts are made in the order given. The cuts of a block depend on no other block: each has a
// list of the joints that may yet meet it, which a cut hands on to the two children by the children's bounds.
template <int Dim>
std::vector<Polytope<Dim>> slice(const Polytope<Dim>& domain, const std::vector<Cut<Dim>>& cuts,
                                 const SlicingLimits& limits, SlicingCounters& counters);

// the parts, in ascending order, that boundary joints left in one piece: they never move
template <int Dim>
std::vector<int> boundary_parts(const std::vector<Polytope<Dim>>& parts, const std::vector<Cut<Dim>>& cuts);

}  // namespace voussoir
