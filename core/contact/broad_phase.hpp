// Candidate pairs by bounding boxes: a hierarchy of grids, so that the cost of a box does not depend on their number.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/geometry/types.hpp"

namespace voussoir {

template <int Dim>
struct Box {
  Vector<Dim> low, high;  // m; a box whose low is above its high (an absent body's) meets none
  int body;               // parts of one body never meet
  bool fixed;             // nor do two fixed ones
};

// whether two boxes have a point in common, their faces included
template <int Dim>
bool meet(const Box<Dim>& a, const Box<Dim>& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

// whether a pair (i, j), i < j, whose boxes meet is wanted; called from any thread, possibly more than once
using PairFilter = std::function<bool(int, int)>;

// All pairs (i, j), i < j, whose boxes meet, that may touch and that the filter wants (an empty one wants all), in
// ascending order for any number of threads; `pairs` keeps its memory, and unwanted pairs take none. O(boxes + pairs)
// for each power of two between the smallest and the largest boxes that occur in numbers.
template <int Dim>
void overlapping_pairs(const std::vector<Box<Dim>>& boxes, int threads, const PairFilter& wanted,
                       std::vector<std::pair<int, int>>& pairs);

}  // namespace voussoir
