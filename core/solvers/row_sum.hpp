// The sum of a row of blocks times the parts of a vector, in registers. Blocks of 6 x 6 are multiplied in lanes of
// 16 bytes, which every processor has: each number is summed as (0 + (1 + 2)) + (3 + (4 + 5)), as Eigen's scalar code
// sums it, and nothing is fused, so that no bit depends on machine or compiler. Blocks are column by column.
#pragma once

#include <cstring>

#include "core/geometry/types.hpp"

namespace voussoir {

template <int Size, class Real>
struct RowSum {
  using Numbers = Eigen::Matrix<Real, Size, 1>;
  Numbers sum;

  static RowSum zero() { return {Numbers::Zero()}; }
  static RowSum of(const Real* x) { return {Eigen::Map<const Numbers>(x)}; }
  void keep(Real* x) const { Eigen::Map<Numbers>(x, Size) = sum; }
  void add(const Real* block, const Real* x) { sum.noalias() += matrix(block) * Eigen::Map<const Numbers>(x); }
  void subtract(const Real* block, const Real* x) { sum.noalias() -= matrix(block) * Eigen::Map<const Numbers>(x); }

 private:
  using Block = Eigen::Matrix<Real, Size, Size>;
  static Eigen::Map<const Block> matrix(const Real* block) { return Eigen::Map<const Block>(block); }
};

template <class Real>
struct SixteenBytes;
template <>
struct SixteenBytes<double> {
  using Lanes [[gnu::vector_size(16)]] = double;
};
template <>
struct SixteenBytes<float> {
  using Lanes [[gnu::vector_size(16)]] = float;
};

// six numbers of one column, or of the product, in lanes of 16 bytes
template <class Real>
struct SixLanes {
  using Lanes = typename SixteenBytes<Real>::Lanes;
  struct Spread {
    Lanes of[6];
  };

  static Lanes load(const Real* x) {
    Lanes lanes;
    std::memcpy(&lanes, x, sizeof lanes);
    return lanes;
  }
  static void store(Lanes lanes, Real* x) { std::memcpy(x, &lanes, sizeof lanes); }

  // each number in all lanes
  static Spread spread(const Real* x) {
    Spread all;
    for (int k = 0; k < 6; ++k)
      all.of[k] = x[k] - Lanes{};
    return all;
  }

  // the lanes from `row` on of a block times the numbers
  static Lanes product(const Real* row, const Spread& x) {
    const auto times = [&](int column) { return load(row + 6 * column) * x.of[column]; };
    return (times(0) + (times(1) + times(2))) + (times(3) + (times(4) + times(5)));
  }
};

template <>
struct RowSum<6, double> {
  using Six = SixLanes<double>;
  Six::Lanes a, b, c;  // rows 0, 1; 2, 3; 4, 5

  static RowSum zero() { return {Six::Lanes{}, Six::Lanes{}, Six::Lanes{}}; }
  static RowSum of(const double* x) { return {Six::load(x), Six::load(x + 2), Six::load(x + 4)}; }
  void keep(double* x) const {
    Six::store(a, x);
    Six::store(b, x + 2);
    Six::store(c, x + 4);
  }
  void add(const double* block, const double* x) {
    const Six::Spread all = Six::spread(x);
    a += Six::product(block, all);
    b += Six::product(block + 2, all);
    c += Six::product(block + 4, all);
  }
  void subtract(const double* block, const double* x) {
    const Six::Spread all = Six::spread(x);
    a -= Six::product(block, all);
    b -= Six::product(block + 2, all);
    c -= Six::product(block + 4, all);
  }
};

template <>
struct RowSum<6, float> {
  using Six = SixLanes<float>;
  Six::Lanes a, b;  // rows 0 to 3; 2 to 5

  static RowSum zero() { return {Six::Lanes{}, Six::Lanes{}}; }
  static RowSum of(const float* x) { return {Six::load(x), Six::load(x + 2)}; }
  void keep(float* x) const {
    Six::store(a, x);
    Six::store(b, x + 2);
  }
  void add(const float* block, const float* x) {
    const Six::Spread all = Six::spread(x);
    a += Six::product(block, all);
    b += Six::product(block + 2, all);
  }
  void subtract(const float* block, const float* x) {
    const Six::Spread all = Six::spread(x);
    a -= Six::product(block, all);
    b -= Six::product(block + 2, all);
  }
};

}  // namespace voussoir
