// Candidate pairs by bounding boxes: sort and sweep along the first axis.
#pragma once

#include <utility>
#include <vector>

#include "core/geometry/types.hpp"

namespace voussoir {

template <int Dim>
struct Box {
  Vector<Dim> low, high;  // m
  int body;               // parts of one body never meet
  bool fixed;             // nor do two fixed ones
};

// All pairs (i, j), i < j, whose boxes overlap, in ascending order.
template <int Dim>
std::vector<std::pair<int, int>> overlapping_pairs(const std::vector<Box<Dim>>& boxes);

}  // namespace voussoir
