// The sum of a row of blocks times the parts of a vector, in registers. Blocks of 6 x 6 are multiplied in lanes of
// 16 bytes, which every processor has: each number is summed as (0 + (1 + 2)) + (3 + (4 + 5)), as Eigen's scalar code
// sums it, and nothing is fused, so that no bit depends on machine or compiler. Blocks are column by column.
#pragma once

#include <hwy/highway.h>

#include "core/geometry/types.hpp"

namespace voussoir {

template <int Size, class Real>
struct RowSum {
  using Numbers = Eigen::Matrix<Real, Size, 1>;
  Numbers sum;

  static HWY_INLINE RowSum zero() { return {Numbers::Zero()}; }
  static HWY_INLINE RowSum of(const Real* x) { return {Eigen::Map<const Numbers>(x)}; }
  HWY_INLINE void keep(Real* x) const { Eigen::Map<Numbers>(x, Size) = sum; }
  HWY_INLINE void add(const Real* block, const Real* x) {
    sum.noalias() += matrix(block) * Eigen::Map<const Numbers>(x);
  }
  HWY_INLINE void subtract(const Real* block, const Real* x) {
    sum.noalias() -= matrix(block) * Eigen::Map<const Numbers>(x);
  }

 private:
  using Block = Eigen::Matrix<Real, Size, Size>;
  static Eigen::Map<const Block> matrix(const Real* block) { return Eigen::Map<const Block>(block); }
};

// the numbers of one column, or of the product, in lanes of 16 bytes from `place` on
template <class Real>
struct SixLanes {
  using Tag = hwy::HWY_NAMESPACE::FixedTag<Real, 16 / sizeof(Real)>;
  using Lanes = hwy::HWY_NAMESPACE::Vec<Tag>;

  static HWY_INLINE Lanes load(const Real* x) { return hwy::HWY_NAMESPACE::LoadU(Tag(), x); }
  static HWY_INLINE void store(Lanes lanes, Real* x) { hwy::HWY_NAMESPACE::StoreU(lanes, Tag(), x); }

  // the lanes from `row` on of block times x, where x has been copied into all lanes
  static HWY_INLINE Lanes product(const Real* row, const Lanes (&x)[6]) {
    using namespace hwy::HWY_NAMESPACE;
    const auto times = [&](int column) HWY_ATTR { return Mul(load(row + 6 * column), x[column]); };
    return Add(Add(times(0), Add(times(1), times(2))), Add(times(3), Add(times(4), times(5))));
  }
  static HWY_INLINE void spread(const Real* x, Lanes (&all)[6]) {
    for (int k = 0; k < 6; ++k)
      all[k] = hwy::HWY_NAMESPACE::Set(Tag(), x[k]);
  }
};

template <>
struct RowSum<6, double> {
  using Six = SixLanes<double>;
  Six::Lanes a, b, c;  // rows 0, 1; 2, 3; 4, 5

  static HWY_INLINE RowSum zero() {
    const Six::Lanes none = hwy::HWY_NAMESPACE::Zero(Six::Tag());
    return {none, none, none};
  }
  static HWY_INLINE RowSum of(const double* x) { return {Six::load(x), Six::load(x + 2), Six::load(x + 4)}; }
  HWY_INLINE void keep(double* x) const {
    Six::store(a, x);
    Six::store(b, x + 2);
    Six::store(c, x + 4);
  }
  HWY_INLINE void add(const double* block, const double* x) {
    Six::Lanes all[6];
    Six::spread(x, all);
    a = hwy::HWY_NAMESPACE::Add(a, Six::product(block, all));
    b = hwy::HWY_NAMESPACE::Add(b, Six::product(block + 2, all));
    c = hwy::HWY_NAMESPACE::Add(c, Six::product(block + 4, all));
  }
  HWY_INLINE void subtract(const double* block, const double* x) {
    Six::Lanes all[6];
    Six::spread(x, all);
    a = hwy::HWY_NAMESPACE::Sub(a, Six::product(block, all));
    b = hwy::HWY_NAMESPACE::Sub(b, Six::product(block + 2, all));
    c = hwy::HWY_NAMESPACE::Sub(c, Six::product(block + 4, all));
  }
};

template <>
struct RowSum<6, float> {
  using Six = SixLanes<float>;
  Six::Lanes a, b;  // rows 0 to 3; 2 to 5

  static HWY_INLINE RowSum zero() {
    return {hwy::HWY_NAMESPACE::Zero(Six::Tag()), hwy::HWY_NAMESPACE::Zero(Six::Tag())};
  }
  static HWY_INLINE RowSum of(const float* x) { return {Six::load(x), Six::load(x + 2)}; }
  HWY_INLINE void keep(float* x) const {
    Six::store(a, x);
    Six::store(b, x + 2);
  }
  HWY_INLINE void add(const float* block, const float* x) {
    Six::Lanes all[6];
    Six::spread(x, all);
    a = hwy::HWY_NAMESPACE::Add(a, Six::product(block, all));
    b = hwy::HWY_NAMESPACE::Add(b, Six::product(block + 2, all));
  }
  HWY_INLINE void subtract(const float* block, const float* x) {
    Six::Lanes all[6];
    Six::spread(x, all);
    a = hwy::HWY_NAMESPACE::Sub(a, Six::product(block, all));
    b = hwy::HWY_NAMESPACE::Sub(b, Six::product(block + 2, all));
  }
};

}  // namespace voussoir
