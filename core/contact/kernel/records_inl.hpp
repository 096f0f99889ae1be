// Records as the parts and pairs store them, into vector registers and back: rows to columns.
#if defined(VOUSSOIR_RECORDS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOUSSOIR_RECORDS_INL
#undef VOUSSOIR_RECORDS_INL
#else
#define VOUSSOIR_RECORDS_INL
#endif

#include "core/contact/kernel/lanes_inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace voussoir {
namespace HWY_NAMESPACE {

// rows to columns: as many rows as the tag has lanes, four numbers each
template <class V>
struct Columns4 {
  V c[4];
};
template <class D, class V = hn::Vec<D>>
HWY_INLINE Columns4<V> transpose(D d, const double* const* rows) {
  Columns4<V> r;
#if HWY_TARGET == HWY_SCALAR
  for (int k = 0; k < 4; ++k)
    r.c[k] = hn::Set(d, rows[0][k]);
#else
  if constexpr (D::kPrivateN == 2) {
    const V a = hn::LoadU(d, rows[0]), b = hn::LoadU(d, rows[1]);
    const V e = hn::LoadU(d, rows[0] + 2), f = hn::LoadU(d, rows[1] + 2);
    r.c[0] = hn::InterleaveLower(d, a, b);
    r.c[1] = hn::InterleaveUpper(d, a, b);
    r.c[2] = hn::InterleaveLower(d, e, f);
    r.c[3] = hn::InterleaveUpper(d, e, f);
  } else if constexpr (D::kPrivateN == 4) {
    const V low0 = hn::LoadU(d, rows[0]), low1 = hn::LoadU(d, rows[1]), low2 = hn::LoadU(d, rows[2]),
            low3 = hn::LoadU(d, rows[3]);
    const V even01 = hn::InterleaveLower(d, low0, low1), odd01 = hn::InterleaveUpper(d, low0, low1);
    const V even23 = hn::InterleaveLower(d, low2, low3), odd23 = hn::InterleaveUpper(d, low2, low3);
    r.c[0] = hn::ConcatLowerLower(d, even23, even01);
    r.c[1] = hn::ConcatLowerLower(d, odd23, odd01);
    r.c[2] = hn::ConcatUpperUpper(d, even23, even01);
    r.c[3] = hn::ConcatUpperUpper(d, odd23, odd01);
  } else {
    // rows k and k + 4 side by side, turned as above in each half
    const hn::Half<D> half;
    const auto both = [&](int k)
                          HWY_ATTR { return hn::Combine(d, hn::LoadU(half, rows[k + 4]), hn::LoadU(half, rows[k])); };
    const V low0 = both(0), low1 = both(1), low2 = both(2), low3 = both(3);
    const V even01 = hn::InterleaveLower(d, low0, low1), odd01 = hn::InterleaveUpper(d, low0, low1);
    const V even23 = hn::InterleaveLower(d, low2, low3), odd23 = hn::InterleaveUpper(d, low2, low3);
    r.c[0] = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(even23), even01);
    r.c[1] = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(odd23), odd01);
    r.c[2] = hn::OddEvenBlocks(even23, hn::SwapAdjacentBlocks(even01));
    r.c[3] = hn::OddEvenBlocks(odd23, hn::SwapAdjacentBlocks(odd01));
  }
#endif
  return r;
}

// columns to rows: the reverse
template <class D, class V = hn::Vec<D>>
HWY_INLINE void scatter([[maybe_unused]] D d, V c0, V c1, V c2, V c3, double* const* rows) {
#if HWY_TARGET == HWY_SCALAR
  const V columns[4] = {c0, c1, c2, c3};
  for (int k = 0; k < 4; ++k)
    rows[0][k] = hn::GetLane(columns[k]);
#else
  if constexpr (D::kPrivateN == 2) {
    hn::StoreU(hn::InterleaveLower(d, c0, c1), d, rows[0]);
    hn::StoreU(hn::InterleaveLower(d, c2, c3), d, rows[0] + 2);
    hn::StoreU(hn::InterleaveUpper(d, c0, c1), d, rows[1]);
    hn::StoreU(hn::InterleaveUpper(d, c2, c3), d, rows[1] + 2);
  } else if constexpr (D::kPrivateN == 4) {
    const V even01 = hn::InterleaveLower(d, c0, c1), odd01 = hn::InterleaveUpper(d, c0, c1);
    const V even23 = hn::InterleaveLower(d, c2, c3), odd23 = hn::InterleaveUpper(d, c2, c3);
    hn::StoreU(hn::ConcatLowerLower(d, even23, even01), d, rows[0]);
    hn::StoreU(hn::ConcatLowerLower(d, odd23, odd01), d, rows[1]);
    hn::StoreU(hn::ConcatUpperUpper(d, even23, even01), d, rows[2]);
    hn::StoreU(hn::ConcatUpperUpper(d, odd23, odd01), d, rows[3]);
  } else {
    const hn::Half<D> half;
    scatter(half, hn::LowerHalf(half, c0), hn::LowerHalf(half, c1), hn::LowerHalf(half, c2), hn::LowerHalf(half, c3),
            rows);
    scatter(half, hn::UpperHalf(half, c0), hn::UpperHalf(half, c1), hn::UpperHalf(half, c2), hn::UpperHalf(half, c3),
            rows + D::kPrivateN / 2);
  }
#endif
}

// The first Count doubles of a record of each pair; up to three more behind them are read and dropped.
template <class L, int Count>
struct Records {
  typename L::Real value[Count];

  HWY_INLINE explicit Records(const double* const (&records)[L::width]) {
    for (int k = 0; k < Count; k += 4) {
      const double* rows[L::width];
      for (int lane = 0; lane < L::width; ++lane)
        rows[lane] = records[lane] + k;
      const auto columns = transpose(typename L::Tag(), rows);
      for (int j = 0; j < 4 && k + j < Count; ++j)
        value[k + j].v[0] = columns.c[j];
    }
  }
  HWY_INLINE const typename L::Real& operator[](int k) const { return value[k]; }
};
// of one pair, where they are
template <int Count>
struct Records<OnePair, Count> {
  const double* value;

  HWY_INLINE explicit Records(const double* const (&records)[1]) : value(records[0]) {}
  HWY_INLINE double operator[](int k) const { return value[k]; }
};

// The first Count doubles of a record of each pair are replaced, up to three more behind them overwritten.
template <class L, int Count, int Given>
HWY_INLINE void store_records(const typename L::Real (&values)[Given], double* const (&records)[L::width]) {
  static_assert(Count % 4 == 0 && Count <= Given);
  if constexpr (L::one_pair) {
    for (int k = 0; k < Count; k += 4)
      for (int j = 0; j < 4; ++j)  // short enough to be unrolled
        records[0][k + j] = values[k + j];
  } else {
    for (int k = 0; k < Count; k += 4) {
      double* rows[L::width];
      for (int lane = 0; lane < L::width; ++lane)
        rows[lane] = records[lane] + k;
      scatter(typename L::Tag(), values[k].v[0], values[k + 1].v[0], values[k + 2].v[0], values[k + 3].v[0], rows);
    }
  }
}

template <class L, int Dim>
HWY_INLINE void load_planes(const Sources<L::width>& source, int slot, Components<typename L::Wide, Dim>& n,
                            typename L::Wide& offset) {
  static_assert(row_length<Dim> == 4);
  const double* rows[L::step];
  if constexpr (L::one_pair) {
    const int left = source.count[0] - slot * planes_per_quad;  // at least one
    const double* const here = source.rows[0] + slot * planes_per_quad * row_length<Dim>;
    for (int k = 0; k < planes_per_quad; ++k)
      rows[k] = k < left ? here + k * row_length<Dim> : padding_row<Dim>;
  } else if (slot < source.least_count) {
    for (int lane = 0; lane < L::width; ++lane)
      rows[lane] = source.rows[lane] + slot * row_length<Dim>;
  } else {
    for (int lane = 0; lane < L::width; ++lane)
      rows[lane] = slot < source.count[lane] ? source.rows[lane] + slot * row_length<Dim> : padding_row<Dim>;
  }
  using Tag = typename L::Tag;
  constexpr int registers = sizeof(offset.v) / sizeof(offset.v[0]);
  for (int k = 0; k < registers; ++k) {
    const auto columns = transpose(Tag(), rows + k * (L::step / registers));
    for (int j = 0; j < Dim; ++j)
      n[j].v[k] = columns.c[j];
    offset.v[k] = columns.c[Dim];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace voussoir
HWY_AFTER_NAMESPACE();
#endif
