#include "core/solvers/dense_kernels.hpp"

#include <algorithm>

#include "core/solvers/row_sum.hpp"

namespace voussoir {
namespace {

using TwoLanes = SixteenBytes<double>::Lanes;
constexpr int tile_size = 4;       // rows and columns of C in registers
constexpr int rows_in_cache = 64;  // of A at a time

TwoLanes lanes_at(const double* x) {
  return SixLanes<double>::load(x);
}
void keep_lanes(TwoLanes pair, double* x) {
  SixLanes<double>::store(pair, x);
}

// A's rows, or B's columns, in strips of four, term by term; the last strip is filled up with zeros
void pack_rows(const DenseView& a, double* packed) {
  for (int i = 0; i < a.rows; i += tile_size)
    for (int k = 0; k < a.columns; ++k)
      for (int r = 0; r < tile_size; ++r)
        *packed++ = i + r < a.rows ? a.at[i + r + static_cast<long>(k) * a.stride] : 0;
}
void pack_columns(const DenseView& b, double* packed) {
  for (int j = 0; j < b.columns; j += tile_size)
    for (int k = 0; k < b.rows; ++k)
      for (int c = 0; c < tile_size; ++c)
        *packed++ = j + c < b.columns ? b.at[k + static_cast<long>(j + c) * b.stride] : 0;
}

// four rows of A times four columns of B, by columns
void multiply_tile(int terms, const double* a, const double* b, double* product) {
  TwoLanes sums[tile_size][2] = {};
  for (int k = 0; k < terms; ++k, a += tile_size, b += tile_size) {
    const TwoLanes upper = lanes_at(a), lower = lanes_at(a + 2);
    for (int c = 0; c < tile_size; ++c) {
      const TwoLanes factor{b[c], b[c]};
      sums[c][0] += upper * factor;
      sums[c][1] += lower * factor;
    }
  }
  for (int c = 0; c < tile_size; ++c) {
    keep_lanes(sums[c][0], product + tile_size * c);
    keep_lanes(sums[c][1], product + tile_size * c + 2);
  }
}

}  // namespace

void subtract_multiple(int count, double factor, const double* x, double* y) {
  const TwoLanes both{factor, factor};
  int i = 0;
  for (; i + 4 <= count; i += 4) {
    keep_lanes(lanes_at(y + i) - both * lanes_at(x + i), y + i);
    keep_lanes(lanes_at(y + i + 2) - both * lanes_at(x + i + 2), y + i + 2);
  }
  for (; i < count; ++i)
    y[i] -= factor * x[i];
}

double dot_product(int count, const double* x, const double* y) {
  TwoLanes even{}, odd{};
  int i = 0;
  for (; i + 4 <= count; i += 4) {
    even += lanes_at(x + i) * lanes_at(y + i);
    odd += lanes_at(x + i + 2) * lanes_at(y + i + 2);
  }
  even += odd;
  double sum = even[0] + even[1];
  for (; i < count; ++i)
    sum += x[i] * y[i];
  return sum;
}

void subtract_product(const DenseView& a, const DenseView& b, const DenseView& c, bool lower,
                      std::vector<double>& packed) {
  const int terms = a.columns;
  const auto strips = [](int count) { return (count + tile_size - 1) / tile_size * tile_size; };
  packed.resize(static_cast<std::size_t>(strips(a.rows) + strips(b.columns)) * terms);
  double* const of_a = packed.data();
  double* const of_b = of_a + static_cast<std::size_t>(strips(a.rows)) * terms;
  pack_rows(a, of_a);
  pack_columns(b, of_b);
  double product[tile_size * tile_size];
  for (int begin = 0; begin < c.rows; begin += rows_in_cache) {
    const int end = std::min(begin + rows_in_cache, c.rows);
    for (int j = 0; j < c.columns && (!lower || j < end); j += tile_size)
      for (int i = lower ? std::max(begin, j / tile_size * tile_size) : begin; i < end; i += tile_size) {
        multiply_tile(terms, of_a + static_cast<std::size_t>(i) * terms, of_b + static_cast<std::size_t>(j) * terms,
                      product);
        for (int q = 0; q < std::min(tile_size, c.columns - j); ++q) {
          double* const to = c.at + i + static_cast<long>(j + q) * c.stride;
          if (i + tile_size <= c.rows) {
            keep_lanes(lanes_at(to) - lanes_at(product + tile_size * q), to);
            keep_lanes(lanes_at(to + 2) - lanes_at(product + tile_size * q + 2), to + 2);
          } else {
            for (int p = 0; p < c.rows - i; ++p)
              to[p] -= product[tile_size * q + p];
          }
        }
      }
  }
}

}  // namespace voussoir
