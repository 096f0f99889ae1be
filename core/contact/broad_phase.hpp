// Candidate pairs by bounding boxes: a hierarchy of grids, so that a box costs the same however many there are.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/geometry/types.hpp"

namespace voussoir {

template <int Dim>
struct Box {
  Vector<Dim> low, high;  // m; a box whose low lies above its high (an absent body's) meets none
  int body;               // parts of one body never meet
  bool fixed;             // nor do two fixed ones
};

// whether two boxes have a point in common, their faces included
template <int Dim>
bool meet(const Box<Dim>& a, const Box<Dim>& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

// whether a pair (i, j), i < j, whose boxes meet is wanted; any thread asks, and more than once perhaps
using PairFilter = std::function<bool(int, int)>;

// All pairs (i, j), i < j, whose boxes meet, that may touch and that the filter wants (an empty one wants all), in
// ascending order whatever the number of threads; `pairs` keeps its memory, of which what is not wanted takes none.
// O(boxes + pairs) for each power of two between the smallest and the largest boxes that occur in numbers.
template <int Dim>
void overlapping_pairs(const std::vector<Box<Dim>>& boxes, int threads, const PairFilter& wanted,
                       std::vector<std::pair<int, int>>& pairs);

}  // namespace voussoir
