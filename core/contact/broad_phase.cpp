#include "core/contact/broad_phase.hpp"

#include <algorithm>
#include <numeric>

namespace voussoir {

template <int Dim>
std::vector<std::pair<int, int>> overlapping_pairs(const std::vector<Box<Dim>>& boxes) {
  std::vector<int> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return boxes[i].low[0] < boxes[j].low[0]; });

  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Box<Dim>& a = boxes[order[i]];
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].low[0] <= a.high[0]; ++j) {
      const Box<Dim>& b = boxes[order[j]];
      if (a.body == b.body || (a.fixed && b.fixed)) continue;
      if ((a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all())
        pairs.push_back(std::minmax(order[i], order[j]));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template std::vector<std::pair<int, int>> overlapping_pairs<2>(const std::vector<Box<2>>&);
template std::vector<std::pair<int, int>> overlapping_pairs<3>(const std::vector<Box<3>>&);

}  // namespace voussoir
