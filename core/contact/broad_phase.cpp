#include "core/contact/broad_phase.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/on_threads.hpp"

namespace voussoir {
namespace {

// One grid's cells are this much wider than the median box: boxes of one size, turned at random, then share it.
constexpr double cell_per_box = 1.5;

// Boxes of a size that fewer than this have are compared with all others: with a grid of their own every smaller box
// would visit some 27 cells to find them.
constexpr int few = 32;

// the finest grid has 2^40 cells along the region's longest side: far within an integer, far beyond any rock mass
constexpr int most_halvings = 40;

using Pairs = std::vector<std::pair<int, int>>;

template <int Dim>
using Cell = std::array<std::int64_t, Dim>;

// Boxes of like size, no wider than a cell, each in the cell of its low corner. Cells are numbered in rows along x,
// rows in layers: boxes near in space are near in memory. Strides are odd, so that numbers that wrap round spread.
template <int Dim>
struct Grid {
  int level = 0;       // cells are 2^level times those of level 0
  int count = 0;       // boxes
  double cell = 0;     // m
  Cell<Dim> spread{};  // the most cells that a box reaches up from its own
  std::array<std::uint64_t, Dim> stride{};
};

template <int Dim>
struct Entry {
  int number, grid;
  Box<Dim> box;
};

// A search and its memory. All boxes of the grids are in one table, in the order of their cells' numbers modulo its
// size: several cells may share a bucket.
template <int Dim>
struct PairSearch {
  Vector<Dim> origin, region;        // m: the lowest corner, and the extent, of all boxes
  double cell = 1;                   // m, of level 0
  int lowest = 0;                    // level
  std::vector<int> level;            // by box
  std::vector<double> extents;       // m, of the boxes that are there
  std::vector<Grid<Dim>> grids;      // from fine to coarse, those with at least `few` boxes
  std::vector<int> alone;            // boxes of no grid
  std::vector<Entry<Dim>> filed;     // boxes of the grids, as they come
  std::vector<Entry<Dim>> table;     // the same, bucket by bucket
  std::vector<std::uint32_t> begin;  // of each bucket in the table, and the end
  std::vector<std::uint32_t> row;    // of the pairs of each box
  std::vector<Pairs> found;          // by group of boxes that one thread searches at a time
  const PairFilter* wanted = nullptr;
};

constexpr int absent = std::numeric_limits<int>::min();

template <int Dim>
double extent(const Box<Dim>& box) {
  return (box.high - box.low).maxCoeff();
}

template <int Dim>
bool is_there(const Box<Dim>& box) {
  return (box.low.array() <= box.high.array()).all();
}

template <int Dim>
bool is_finite(const Box<Dim>& box) {
  for (int k = 0; k < Dim; ++k)
    if (!std::isfinite(box.low[k]) || !std::isfinite(box.high[k])) return false;
  return true;
}

// monotone in the point, rounding included: no box is searched for in a wrong cell
template <int Dim>
Cell<Dim> cell_of(const Vector<Dim>& point, const Vector<Dim>& origin, double width) {
  Cell<Dim> cell;
  for (int k = 0; k < Dim; ++k)
    cell[k] = static_cast<std::int64_t>(std::floor((point[k] - origin[k]) / width));
  return cell;
}

template <int Dim>
std::uint32_t bucket_of(const Grid<Dim>& grid, const Cell<Dim>& cell, std::uint32_t mask) {
  std::uint64_t number = static_cast<std::uint64_t>(grid.level) * 0x9e3779b97f4a7c15u;
  for (int k = 0; k < Dim; ++k)
    number += grid.stride[k] * static_cast<std::uint64_t>(cell[k]);
  return static_cast<std::uint32_t>(number) & mask;
}

// level 0 fits the median box; the lowest level can still count its cells
template <int Dim>
void choose_cells(const std::vector<Box<Dim>>& boxes, PairSearch<Dim>& s) {
  s.extents.clear();
  Vector<Dim> low = Vector<Dim>::Zero(), high = Vector<Dim>::Zero();
  for (const Box<Dim>& box : boxes) {
    if (!is_there(box) || !is_finite(box)) continue;
    low = s.extents.empty() ? box.low : Vector<Dim>(low.cwiseMin(box.low));
    high = s.extents.empty() ? box.high : Vector<Dim>(high.cwiseMax(box.high));
    s.extents.push_back(extent(box));
  }
  s.origin = low;
  s.region = high - low;
  s.cell = 1;
  s.lowest = 0;
  const double region = s.region.maxCoeff();
  if (region == 0) return;
  const auto median = s.extents.begin() + static_cast<std::ptrdiff_t>(s.extents.size() / 2);
  std::nth_element(s.extents.begin(), median, s.extents.end());
  s.cell = *median > 0 ? cell_per_box * *median : region;
  s.lowest = std::ilogb(region / s.cell) - most_halvings;
}

// the smallest power of two that is no less than the box
template <int Dim>
int level_of(const PairSearch<Dim>& s, const Box<Dim>& box) {
  const double fraction = extent(box) / s.cell;
  if (fraction == 0) return s.lowest;
  int exponent = 0;
  const bool power = std::frexp(fraction, &exponent) == 0.5;
  return std::max(s.lowest, power ? exponent - 1 : exponent);
}

template <int Dim>
Grid<Dim> make_grid(const PairSearch<Dim>& s, int level) {
  Grid<Dim> grid;
  grid.level = level;
  grid.cell = std::ldexp(s.cell, level);
  std::uint64_t stride = 1;
  for (int k = 0; k < Dim; ++k) {
    grid.stride[k] = stride;
    stride *= static_cast<std::uint64_t>(s.region[k] / grid.cell) / 2 * 2 + 3;
  }
  return grid;
}

// a grid for every size that is common; boxes of other sizes are alone
template <int Dim>
void choose_grids(const std::vector<Box<Dim>>& boxes, PairSearch<Dim>& s) {
  s.level.assign(boxes.size(), absent);
  s.grids.clear();
  s.alone.clear();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!is_there(boxes[i])) continue;
    if (!is_finite(boxes[i])) {
      s.alone.push_back(static_cast<int>(i));
      continue;
    }
    const int level = s.level[i] = level_of(s, boxes[i]);
    auto place = std::lower_bound(s.grids.begin(), s.grids.end(), level,
                                  [](const Grid<Dim>& g, int wanted) { return g.level < wanted; });
    if (place == s.grids.end() || place->level != level) place = s.grids.insert(place, make_grid(s, level));
    ++place->count;
  }
  std::erase_if(s.grids, [](const Grid<Dim>& g) { return g.count < few; });
}

// the grid of a box, or -1
template <int Dim>
int grid_of(const PairSearch<Dim>& s, int box) {
  for (std::size_t g = 0; g < s.grids.size(); ++g)
    if (s.grids[g].level == s.level[box]) return static_cast<int>(g);
  return -1;
}

template <int Dim>
std::uint32_t own_bucket(const PairSearch<Dim>& s, const Entry<Dim>& e, std::uint32_t mask) {
  const Grid<Dim>& grid = s.grids[e.grid];
  return bucket_of<Dim>(grid, cell_of<Dim>(e.box.low, s.origin, grid.cell), mask);
}

// every box into the bucket of its cell, by counting
template <int Dim>
void fill_table(const std::vector<Box<Dim>>& boxes, PairSearch<Dim>& s) {
  s.filed.clear();
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i) {
    if (s.level[i] == absent) continue;
    const int g = grid_of(s, i);
    if (g < 0) {
      s.alone.push_back(i);
      continue;
    }
    Grid<Dim>& grid = s.grids[g];
    const Cell<Dim> low = cell_of<Dim>(boxes[i].low, s.origin, grid.cell);
    const Cell<Dim> high = cell_of<Dim>(boxes[i].high, s.origin, grid.cell);
    for (int k = 0; k < Dim; ++k)
      grid.spread[k] = std::max(grid.spread[k], high[k] - low[k]);
    s.filed.push_back({i, g, boxes[i]});
  }

  std::size_t buckets = 1;
  while (buckets < 2 * s.filed.size())
    buckets *= 2;
  const std::uint32_t mask = static_cast<std::uint32_t>(buckets - 1);
  // the end of each bucket, lowered to its begin as the boxes go in
  s.begin.assign(buckets + 1, 0);
  for (const Entry<Dim>& e : s.filed)
    ++s.begin[own_bucket(s, e, mask)];
  for (std::size_t b = 0; b < buckets; ++b)
    s.begin[b + 1] += s.begin[b];
  s.table.resize(s.filed.size());
  for (auto e = s.filed.rbegin(); e != s.filed.rend(); ++e)
    s.table[--s.begin[own_bucket(s, *e, mask)]] = *e;
}

template <int Dim>
void try_pair(const PairSearch<Dim>& s, int i, const Box<Dim>& a, int j, const Box<Dim>& b, Pairs& found) {
  if (a.body == b.body || (a.fixed && b.fixed) || !meet(a, b)) return;
  const std::pair<int, int> pair = std::minmax(i, j);
  if (!*s.wanted || (*s.wanted)(pair.first, pair.second)) found.push_back(pair);
}

// the boxes of some neighbouring buckets; within a grid each pair is met from both sides
template <int Dim>
void try_buckets(const PairSearch<Dim>& s, const Entry<Dim>& e, int g, std::uint32_t first, std::uint32_t last,
                 Pairs& found) {
  for (std::uint32_t i = s.begin[first]; i < s.begin[last + 1]; ++i) {
    const Entry<Dim>& other = s.table[i];
    if (other.grid == g && (g != e.grid || other.number > e.number))
      try_pair(s, e.number, e.box, other.number, other.box, found);
  }
}

// the boxes of one grid near a box of it, or of a finer one: row by row
template <int Dim>
void try_grid(const PairSearch<Dim>& s, const Entry<Dim>& e, int g, Pairs& found) {
  const Grid<Dim>& grid = s.grids[g];
  const std::uint32_t mask = static_cast<std::uint32_t>(s.begin.size() - 2);
  Cell<Dim> from = cell_of<Dim>(e.box.low, s.origin, grid.cell);
  const Cell<Dim> to = cell_of<Dim>(e.box.high, s.origin, grid.cell);
  for (int k = 0; k < Dim; ++k)
    from[k] -= grid.spread[k];
  const std::uint32_t length = static_cast<std::uint32_t>(std::min<std::int64_t>(to[0] - from[0], mask));
  Cell<Dim> row = from;
  while (true) {
    const std::uint32_t first = bucket_of<Dim>(grid, row, mask), last = (first + length) & mask;
    if (first <= last) {
      try_buckets(s, e, g, first, last, found);
    } else {
      try_buckets(s, e, g, first, mask, found);
      try_buckets(s, e, g, 0, last, found);
    }
    int k = 1;
    while (k < Dim && row[k] == to[k]) {
      row[k] = from[k];
      ++k;
    }
    if (k == Dim) return;
    ++row[k];
  }
}

// boxes of no grid meet any other
template <int Dim>
void try_alone(const std::vector<Box<Dim>>& boxes, const PairSearch<Dim>& s, Pairs& found) {
  for (std::size_t i = 0; i < s.alone.size(); ++i) {
    const int a = s.alone[i];
    for (std::size_t j = i + 1; j < s.alone.size(); ++j)
      try_pair(s, a, boxes[a], s.alone[j], boxes[s.alone[j]], found);
    for (const Entry<Dim>& e : s.filed)
      try_pair(s, a, boxes[a], e.number, e.box, found);
  }
}

// ascending order in O(pairs): by the first box by counting, then the few of each by the second; a pair may have been
// found twice, in a bucket that serves two cells
template <int Dim>
void sort_pairs(PairSearch<Dim>& s, std::size_t boxes, std::vector<std::pair<int, int>>& pairs) {
  s.row.assign(boxes + 1, 0);
  std::size_t count = 0;
  for (const Pairs& found : s.found) {
    count += found.size();
    for (const auto& p : found)
      ++s.row[p.first];
  }
  for (std::size_t i = 0; i < boxes; ++i)
    s.row[i + 1] += s.row[i];
  pairs.resize(count);
  for (const Pairs& found : s.found)
    for (const auto& p : found)
      pairs[--s.row[p.first]] = p;
  for (std::size_t i = 0; i < boxes; ++i)
    std::sort(pairs.begin() + s.row[i], pairs.begin() + s.row[i + 1]);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

}  // namespace

template <int Dim>
void overlapping_pairs(const std::vector<Box<Dim>>& boxes, int threads, const PairFilter& wanted,
                       std::vector<std::pair<int, int>>& pairs) {
  static thread_local PairSearch<Dim> own;
  PairSearch<Dim>& s = own;  // this thread's, searched by all
  s.wanted = &wanted;
  choose_cells(boxes, s);
  choose_grids(boxes, s);
  fill_table(boxes, s);
  // each box searches among boxes of its size and larger ones
  const std::size_t groups = static_cast<std::size_t>(team(threads, s.table.size()));
  s.found.resize(std::max(s.found.size(), groups));
  for (Pairs& found : s.found)
    found.clear();
  on_threads(static_cast<int>(groups), static_cast<int>(groups), [&](int group) {
    const std::size_t first = s.table.size() * group / groups, last = s.table.size() * (group + 1) / groups;
    for (std::size_t i = first; i < last; ++i)
      for (int g = s.table[i].grid; g < static_cast<int>(s.grids.size()); ++g)
        try_grid(s, s.table[i], g, s.found[group]);
  });
  try_alone(boxes, s, s.found.front());
  sort_pairs(s, boxes.size(), pairs);
}

template void overlapping_pairs<2>(const std::vector<Box<2>>&, int, const PairFilter&,
                                   std::vector<std::pair<int, int>>&);
template void overlapping_pairs<3>(const std::vector<Box<3>>&, int, const PairFilter&,
                                   std::vector<std::pair<int, int>>&);

}  // namespace voussoir
