// The contact kernel's two methods to fill a vector register: with the planes of one pair (OnePair) or one plane of
// several pairs (ManyPairs).
//
// Both make the same roundings: only +, -, *, /, square root, minimum and maximum of IEEE doubles occur, never a
// fused multiply-add, and a sum over planes is always four strided partial sums combined as (0+1)+(2+3). So a pair's
// result is bitwise independent of the batch and of the width.
#if defined(VOUSSOIR_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOUSSOIR_LANES_INL
#undef VOUSSOIR_LANES_INL
#else
#define VOUSSOIR_LANES_INL
#endif

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "core/contact/kernel/packs_inl.hpp"
#include "core/contact/kernel/workspace.hpp"

HWY_BEFORE_NAMESPACE();
namespace voussoir {
namespace HWY_NAMESPACE {

// One pair: a register holds four of its planes.
struct OnePair {
  static constexpr bool one_pair = true;
  static constexpr int width = 1;  // pairs
  static constexpr int tag_lanes = HWY_MAX_BYTES / 8 < 4 ? HWY_MAX_BYTES / 8 : 4;
  static constexpr int registers = planes_per_quad / tag_lanes;
  using Tag = hn::CappedTag<double, tag_lanes>;
  using Wide = Pack<Tag, registers>;  // of planes
  using Real = double;                // of pairs
  using Bool = bool;
  using Number = int;  // of a plane
  // a slot is the content of one Wide
  static constexpr int step = planes_per_quad;
  static HWY_INLINE int slot_of(unsigned plane) { return static_cast<int>(plane / planes_per_quad); }
  static HWY_INLINE int place_of(unsigned plane, int) { return plane % planes_per_quad; }  // within the slot

  static HWY_INLINE Real real(double x) { return x; }
  static HWY_INLINE Number number(int n) { return n; }
  static HWY_INLINE Real pick(const double* x) { return *x; }
  template <class F>
  static HWY_INLINE Real collect(const F& value) {
    return value(0);
  }
  static HWY_INLINE void put(const Real& x, double* out) { *out = x; }
  static HWY_INLINE Bool picked(const double* x) { return *x != 0; }
  static HWY_INLINE Bool first(int count) { return count > 0; }
  static HWY_INLINE int count(Bool x) { return x; }
  static HWY_INLINE double total(Real x) { return x; }
  static HWY_INLINE Wide filled(const hn::Vec<Tag>& x) {
    Wide r;
    for (int k = 0; k < registers; ++k)
      r.v[k] = x;
    return r;
  }
  static HWY_INLINE Wide wide(double x) { return filled(hn::Set(Tag(), x)); }
  static HWY_INLINE Wide load(const double* from) {
    Wide r;
    for (int k = 0; k < registers; ++k)
      r.v[k] = hn::LoadU(Tag(), from + k * tag_lanes);
    return r;
  }
  // the number of each place
  template <class F>
  static HWY_INLINE Wide of(const F& number) {
    return collected<Tag, registers>(number);
  }
  static HWY_INLINE void store(const Wide& x, double* to) {
    for (int k = 0; k < registers; ++k)
      hn::StoreU(x.v[k], Tag(), to + k * tag_lanes);
  }
  // pairs that failed have left already: nothing to replace
  static HWY_INLINE const Wide& where(bool, const Wide& x, double) { return x; }
  // (0+1)+(2+3) of each, from the k-th on
  template <int K, int k = 0>
  static HWY_INLINE void add_up(const Wide (&x)[K], double (&out)[K]) {
#if HWY_TARGET != HWY_SCALAR
    if constexpr (tag_lanes == planes_per_quad) {
      // four at a time, turned so that they are added side by side
      const Tag d;
      const hn::Half<Tag> half;
      const auto last = [&](int i) { return x[k + i < K ? k + i : K - 1].v[0]; };
      const auto a = last(0), b = last(1), c = last(2), e = last(3);
      const auto ab = hn::Add(hn::InterleaveLower(d, a, b), hn::InterleaveUpper(d, a, b));
      const auto ce = hn::Add(hn::InterleaveLower(d, c, e), hn::InterleaveUpper(d, c, e));
      const auto sums = hn::Add(hn::ConcatLowerLower(d, ce, ab), hn::ConcatUpperUpper(d, ce, ab));
      const auto low = hn::LowerHalf(half, sums), high = hn::UpperHalf(half, sums);
      out[k] = hn::GetLane(low);
      if constexpr (k + 1 < K) out[k + 1] = hn::GetLane(hn::InterleaveUpper(half, low, low));
      if constexpr (k + 2 < K) out[k + 2] = hn::GetLane(high);
      if constexpr (k + 3 < K) out[k + 3] = hn::GetLane(hn::InterleaveUpper(half, high, high));
      if constexpr (k + planes_per_quad < K) add_up<K, k + planes_per_quad>(x, out);
      return;
    }
#endif
    double p[planes_per_quad];
    store(x[k], p);
    out[k] = (p[0] + p[1]) + (p[2] + p[3]);
    if constexpr (k + 1 < K) add_up<K, k + 1>(x, out);
  }
  static HWY_INLINE double least(const Wide& x) {
    hn::Vec<Tag> r = x.v[0];
    for (int k = 1; k < registers; ++k)
      r = hn::Min(r, x.v[k]);
    return hn::GetLane(hn::MinOfLanes(Tag(), r));
  }
  // the largest, in every lane
  static HWY_INLINE Wide top(const Wide& x) {
    hn::Vec<Tag> r = x.v[0];
    for (int k = 1; k < registers; ++k)
      r = hn::Max(r, x.v[k]);
    return filled(hn::MaxOfLanes(Tag(), r));
  }
  static HWY_INLINE double most(const Wide& x) {
    return hn::GetLane(top(x).v[0]);
  }
  // one bit of each plane that has the value
  static HWY_INLINE std::uint64_t places_of(const Wide& value, const Wide& x) {
    std::uint64_t places = 0;
    for (int k = 0; k < registers; ++k) {
      std::uint8_t bits[8] = {};  // as many as Highway may write
      hn::StoreMaskBits(Tag(), hn::Eq(x.v[k], value.v[k]), bits);
      places |= std::uint64_t{bits[0]} << (k * tag_lanes);
    }
    return places;
  }
  // The largest of value(slot) and the number of its plane among theirs; of equal ones the first. If none is above the
  // floor, the number is -1. The value comes first, as others wait for it, then its place.
  template <class F>
  static HWY_INLINE void find_largest(const Slots& slots, double floor, const F& value, double& largest, int& where) {
    constexpr int most_kept = 16;
    Wide kept[most_kept];
    largest = floor;
    where = -1;
    for (int from = slots.first; from < slots.last; from += most_kept) {
      const int count = std::min(slots.last - from, most_kept);
      Wide best = wide(largest);
      for (int k = 0; k < count; ++k) {
        kept[k] = value(from + k);
        best = larger(best, kept[k]);
      }
      best = top(best);
      const double most = hn::GetLane(best.v[0]);
      if (!(most > largest)) continue;
      largest = most;
      std::uint64_t places = 0;
      for (int k = 0; k < count; ++k)
        places |= places_of(best, kept[k]) << (k * planes_per_quad);
      where = (from - slots.first) * planes_per_quad + std::countr_zero(places);
    }
  }
  // true at the place alone
  template <int place>
  static HWY_INLINE PackMask<Tag, registers> only() {
    return of([](int k) { return k == place ? 1.0 : 0.0; }) > wide(0);
  }
  // the number at the place, in every lane
  template <int place>
  static HWY_INLINE Wide spread(const Wide& x) {
    hn::Vec<Tag> here = x.v[place / tag_lanes];
#if HWY_TARGET != HWY_SCALAR
    const Tag d;
    if constexpr (tag_lanes == 4)
      here = place / 2 ? hn::ConcatUpperUpper(d, here, here) : hn::ConcatLowerLower(d, here, here);
    here = place % 2 ? hn::InterleaveUpper(d, here, here) : hn::InterleaveLower(d, here, here);
#endif
    return filled(here);
  }
  static HWY_INLINE Slots slots(int first_quad, int planes) {
    return {first_quad, first_quad + quads_of(planes)};
  }
  // the slots of both parts, one behind the other
  struct Runs {
    Slots all[1];
  };
  static HWY_INLINE Runs runs(const Slots (&parts)[2]) {
    return {{{parts[0].first, parts[1].last}}};
  }
  // of every two planes, (0, 1) and (2, 3), the other's
  static HWY_INLINE Wide others(const Wide& x) {
    Wide r;
    for (int k = 0; k < registers; ++k)
#if HWY_TARGET == HWY_SCALAR
      r.v[k] = x.v[k ^ 1];
#else
      r.v[k] = hn::Reverse2(Tag(), x.v[k]);
#endif
    return r;
  }
  // of every two planes the first's x and y, or the second's
  template <bool second>
  static HWY_INLINE Wide paired(const Wide& x, const Wide& y) {
    Wide r;
    for (int k = 0; k < registers; ++k)
#if HWY_TARGET == HWY_SCALAR
      r.v[k] = (k % 2 == 0 ? x : y).v[k / 2 * 2 + second];
#else
      r.v[k] = second ? hn::InterleaveUpper(Tag(), x.v[k], y.v[k]) : hn::InterleaveLower(Tag(), x.v[k], y.v[k]);
#endif
    return r;
  }
  template <class Get, class Set>
  static HWY_INLINE void invert(const Slots& slots, const Get& get, const Set& set) {
    const Wide one = wide(1);
    int slot = slots.first;
    for (; slot + 1 < slots.last; slot += 2) {
      const Wide s = get(slot), other_s = others(s), t = get(slot + 1), other_t = others(t);
      const Wide inverse = one / paired<false>(s * other_s, t * other_t);
      set(paired<false>(inverse, inverse) * other_s, slot);
      set(paired<true>(inverse, inverse) * other_t, slot + 1);
    }
    if (slot < slots.last) {
      const Wide s = get(slot), other_s = others(s);
      set(one / (s * other_s) * other_s, slot);
    }
  }
  // add(slot, sums)
  template <int K, int N, class F>
  static HWY_INLINE void sum(const Slots (&parts)[N], double (&out)[K], const F& add) {
    Wide acc[K];
    for (int k = 0; k < K; ++k)
      acc[k] = wide(0);
    for (int slot = parts[0].first; slot < parts[N - 1].last; ++slot)
      add(slot, acc);
    add_up<K>(acc, out);
  }
  // four strided products, combined as the sums are; factor(part, slot)
  template <class F>
  static HWY_INLINE void multiply(const Slots (&parts)[2], double& out, const F& factor) {
    Wide product = wide(1);
    for (int part = 0; part < 2; ++part)
      for (int slot = parts[part].first; slot < parts[part].last; ++slot)
        product = product * factor(part, slot);
    double p[planes_per_quad];
    store(product, p);
    out = (p[0] * p[1]) * (p[2] * p[3]);
  }
};

// Several pairs of one call: a register holds the same plane of each.
struct ManyPairs {
  static constexpr bool one_pair = false;
  using Tag = hn::ScalableTag<double>;
  static constexpr int width = HWY_MAX_BYTES / 8;
  using Wide = Pack<Tag, 1>;
  using Real = Wide;
  using Bool = PackMask<Tag, 1>;
  using Number = Wide;  // of a plane
  static constexpr int step = width;
  static HWY_INLINE int slot_of(int plane) { return plane; }
  static HWY_INLINE int place_of(int, int lane) { return lane; }

  static HWY_INLINE Wide wide(double x) { return {{hn::Set(Tag(), x)}}; }
  static HWY_INLINE const Wide& wide(const Wide& x) { return x; }
  static HWY_INLINE Real real(double x) { return wide(x); }
  static HWY_INLINE Number number(int n) { return wide(static_cast<double>(n)); }
  static HWY_INLINE Real pick(const double* x) { return {{hn::LoadU(Tag(), x)}}; }
  template <class F>
  static HWY_INLINE Real collect(const F& value) {
    return collected<Tag, 1>(value);
  }
  static HWY_INLINE void put(const Real& x, double* out) { hn::StoreU(x.v[0], Tag(), out); }
  static HWY_INLINE Bool picked(const double* x) { return pick(x) > wide(0); }
  static HWY_INLINE Bool first(int count) { return {{hn::FirstN(Tag(), count)}}; }
  static HWY_INLINE int count(const Bool& x) { return static_cast<int>(hn::CountTrue(Tag(), x.m[0])); }
  // of whole numbers, whose sum is the same in any order
  static HWY_INLINE double total(const Real& x) { return hn::GetLane(hn::SumOfLanes(Tag(), x.v[0])); }
  static HWY_INLINE Wide load(const double* from) { return {{hn::LoadU(Tag(), from)}}; }
  static HWY_INLINE void store(const Wide& x, double* to) { hn::StoreU(x.v[0], Tag(), to); }
  // a harmless value for pairs that failed, which stay in the batch
  static HWY_INLINE Wide where(const Bool& good, const Wide& x, double otherwise) {
    return select(good, x, wide(otherwise));
  }
  static HWY_INLINE const Real& least(const Wide& x) { return x; }
  static HWY_INLINE const Real& most(const Wide& x) { return x; }
  // as OnePair's
  template <class F>
  static HWY_INLINE void find_largest(const Slots& slots, double floor, const F& value, Real& largest, Number& where) {
    Number plane = number(0);
    largest = wide(floor);
    where = number(-1);
    for (int slot = slots.first; slot < slots.last; ++slot) {
      const Wide here = value(slot);
      const auto better = here > largest;
      largest = select(better, here, largest);
      where = select(better, plane, where);
      plane = plane + number(1);
    }
  }
  static HWY_INLINE Slots slots(int first_quad, int planes) {
    return {first_quad * planes_per_quad, first_quad * planes_per_quad + planes};
  }
  struct Runs {
    Slots all[2];
  };
  static HWY_INLINE Runs runs(const Slots (&parts)[2]) { return {{parts[0], parts[1]}}; }
  template <class Get, class Set>
  static HWY_INLINE void invert(const Slots& slots, const Get& get, const Set& set) {
    const Wide one = wide(1);
    int slot = slots.first;
    for (; slot + 1 < slots.last; slot += 2) {
      const Wide s = get(slot), t = get(slot + 1), inverse = one / (s * t);
      set(inverse * t, slot);
      set(inverse * s, slot + 1);
    }
    if (slot < slots.last) set(one / get(slot), slot);
  }
  // As many strides side by side as the registers hold: 4 of 3 sums, 2 of 5 (4 with 32 registers), 1 of 9.
  template <int K, int N, class F>
  static HWY_INLINE void sum(const Slots (&parts)[N], Wide (&out)[K], const F& add) {
    constexpr bool many_registers = HWY_MAX_BYTES >= 64;
    constexpr int strides = K <= 3 || (K <= 5 && many_registers) ? 4 : K <= 5 ? 2 : 1;
    Wide partial[planes_per_quad][K];
    for (int from = 0; from < planes_per_quad; from += strides) {
      Wide acc[strides][K];
      for (int j = 0; j < strides; ++j)
        for (int k = 0; k < K; ++k)
          acc[j][k] = wide(0);
      for (const Slots& part : parts)
        for (int slot = part.first + from; slot < part.last; slot += planes_per_quad)
          for (int j = 0; j < strides && slot + j < part.last; ++j)
            add(slot + j, acc[j]);
      // (0+1)+(2+3), each bracket as soon as it can be
      for (int j = 0; j < strides; ++j)
        for (int k = 0; k < K; ++k)
          partial[from + j][k] = (from + j) % 2 == 0 ? acc[j][k] : partial[from + j - 1][k] + acc[j][k];
    }
    for (int k = 0; k < K; ++k)
      out[k] = partial[1][k] + partial[3][k];
  }
  template <class F>
  static HWY_INLINE void multiply(const Slots (&parts)[2], Wide& out, const F& factor) {
    Wide p[planes_per_quad] = {wide(1.0), wide(1.0), wide(1.0), wide(1.0)};
    for (int part = 0; part < 2; ++part)
      for (int slot = parts[part].first; slot < parts[part].last; slot += planes_per_quad)
        for (int j = 0; j < planes_per_quad && slot + j < parts[part].last; ++j)
          p[j] = p[j] * factor(part, slot + j);
    out = (p[0] * p[1]) * (p[2] * p[3]);
  }
};

template <class F>
HWY_INLINE void for_slots(const Slots& slots, const F& visit) {
  for (int slot = slots.first; slot < slots.last; ++slot)
    visit(slot);
}
template <class L, class F>
HWY_INLINE void for_slots(const Slots (&parts)[2], const F& visit) {
  for (const Slots& run : L::runs(parts).all)
    for_slots(run, visit);
}

}  // namespace HWY_NAMESPACE
}  // namespace voussoir
HWY_AFTER_NAMESPACE();
#endif
