// Numbers for the contact kernel's two ways to fill a vector register: the planes of one pair (OnePair) or one plane of
// several pairs (ManyPairs). Compiled once for each instruction set, inside its namespace.
//
// Both ways make the same roundings: only +, -, *, /, square root, minimum and maximum of IEEE doubles occur, never a
// fused multiply-add, and a sum over planes is always four strided partial sums combined as (0+1)+(2+3). So a pair
// gives the same bits alone and in any batch, at any width.
#if defined(VOUSSOIR_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOUSSOIR_LANES_INL
#undef VOUSSOIR_LANES_INL
#else
#define VOUSSOIR_LANES_INL
#endif

#include <hwy/highway.h>

#include <cmath>
#include <cstring>

#include "core/contact/kernel/workspace.hpp"

HWY_BEFORE_NAMESPACE();
namespace voussoir {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// ---- M registers of the tag D as one number -------------------------------------------------------------------------

template <class D, int M>
struct Pack {
  hn::Vec<D> v[M];
};
template <class D, int M>
struct PackMask {
  hn::Mask<D> m[M];
};

#define VOUSSOIR_BINARY(name, function)                                  \
  template <class D, int M>                                              \
  HWY_INLINE Pack<D, M> name(const Pack<D, M>& a, const Pack<D, M>& b) { \
    Pack<D, M> r;                                                        \
    for (int k = 0; k < M; ++k)                                          \
      r.v[k] = hn::function(a.v[k], b.v[k]);                             \
    return r;                                                            \
  }
VOUSSOIR_BINARY(operator+, Add)
VOUSSOIR_BINARY(operator-, Sub)
VOUSSOIR_BINARY(operator*, Mul)
VOUSSOIR_BINARY(operator/, Div)
VOUSSOIR_BINARY(smaller, Min)
VOUSSOIR_BINARY(larger, Max)
VOUSSOIR_BINARY(with_sign_of, CopySign)
#undef VOUSSOIR_BINARY

template <class D, int M>
HWY_INLINE Pack<D, M> operator-(const Pack<D, M>& a) {
  Pack<D, M> r;
  for (int k = 0; k < M; ++k)
    r.v[k] = hn::Neg(a.v[k]);
  return r;
}
template <class D, int M>
HWY_INLINE Pack<D, M> root(const Pack<D, M>& a) {
  Pack<D, M> r;
  for (int k = 0; k < M; ++k)
    r.v[k] = hn::Sqrt(a.v[k]);
  return r;
}
template <class D, int M>
HWY_INLINE PackMask<D, M> operator<(const Pack<D, M>& a, const Pack<D, M>& b) {
  PackMask<D, M> r;
  for (int k = 0; k < M; ++k)
    r.m[k] = hn::Lt(a.v[k], b.v[k]);
  return r;
}
template <class D, int M>
HWY_INLINE PackMask<D, M> operator>(const Pack<D, M>& a, const Pack<D, M>& b) {
  return b < a;
}
template <class D, int M>
HWY_INLINE Pack<D, M> select(const PackMask<D, M>& mask, const Pack<D, M>& yes, const Pack<D, M>& no) {
  Pack<D, M> r;
  for (int k = 0; k < M; ++k)
    r.v[k] = hn::IfThenElse(mask.m[k], yes.v[k], no.v[k]);
  return r;
}
template <class D, int M>
HWY_INLINE PackMask<D, M> both(const PackMask<D, M>& a, const PackMask<D, M>& b) {
  PackMask<D, M> r;
  for (int k = 0; k < M; ++k)
    r.m[k] = hn::And(a.m[k], b.m[k]);
  return r;
}
template <class D, int M>
HWY_INLINE PackMask<D, M> either(const PackMask<D, M>& a, const PackMask<D, M>& b) {
  PackMask<D, M> r;
  for (int k = 0; k < M; ++k)
    r.m[k] = hn::Or(a.m[k], b.m[k]);
  return r;
}
template <class D, int M>
HWY_INLINE PackMask<D, M> but_not(const PackMask<D, M>& a, const PackMask<D, M>& b) {  // a and not b
  PackMask<D, M> r;
  for (int k = 0; k < M; ++k)
    r.m[k] = hn::AndNot(b.m[k], a.m[k]);
  return r;
}
template <class D, int M>
HWY_INLINE bool none(const PackMask<D, M>& a) {
  bool r = true;
  for (int k = 0; k < M; ++k)
    r = r && hn::AllFalse(D(), a.m[k]);
  return r;
}

// the same for one number
HWY_INLINE double smaller(double a, double b) {
  return a < b ? a : b;
}
HWY_INLINE double larger(double a, double b) {
  return a > b ? a : b;
}
HWY_INLINE double with_sign_of(double a, double b) {
  return std::copysign(a, b);
}
HWY_INLINE double root(double a) {
  return std::sqrt(a);
}
HWY_INLINE double select(bool mask, double yes, double no) {
  return mask ? yes : no;
}
HWY_INLINE bool both(bool a, bool b) {
  return a && b;
}
HWY_INLINE bool either(bool a, bool b) {
  return a || b;
}
HWY_INLINE bool but_not(bool a, bool b) {
  return a && !b;
}
HWY_INLINE bool none(bool a) {
  return !a;
}

// ---- small vectors --------------------------------------------------------------------------------------------------

template <class R, int Dim>
struct Components {
  R c[Dim];
  HWY_INLINE R& operator[](int k) { return c[k]; }
  HWY_INLINE const R& operator[](int k) const { return c[k]; }
};

template <class R, int Dim>
HWY_INLINE R dot(const Components<R, Dim>& a, const Components<R, Dim>& b) {
  R r = a[0] * b[0] + a[1] * b[1];
  if constexpr (Dim == 3) r = r + a[2] * b[2];
  return r;
}
template <class R, int Dim>
HWY_INLINE Components<R, Dim> operator-(const Components<R, Dim>& a, const Components<R, Dim>& b) {
  Components<R, Dim> r;
  for (int k = 0; k < Dim; ++k)
    r[k] = a[k] - b[k];
  return r;
}
template <class R, int Dim>
HWY_INLINE Components<R, Dim> operator+(const Components<R, Dim>& a, const Components<R, Dim>& b) {
  Components<R, Dim> r;
  for (int k = 0; k < Dim; ++k)
    r[k] = a[k] + b[k];
  return r;
}
template <class R, int Dim>
HWY_INLINE Components<R, Dim> scaled(const R& f, const Components<R, Dim>& a) {
  Components<R, Dim> r;
  for (int k = 0; k < Dim; ++k)
    r[k] = f * a[k];
  return r;
}
template <class R>
HWY_INLINE Components<R, 3> cross_product(const Components<R, 3>& a, const Components<R, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// ---- the two ways ---------------------------------------------------------------------------------------------------

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
  static constexpr int slots_per_quad = 1;  // a slot is what one Wide holds
  static constexpr int step = planes_per_quad;

  static HWY_INLINE Real real(double x) { return x; }
  static HWY_INLINE Real pick(const double* x) { return *x; }
  static HWY_INLINE void put(const Real& x, double* out) { *out = x; }
  static HWY_INLINE Bool picked(const double* x) { return *x != 0; }
  static HWY_INLINE Wide wide(double x) {
    Wide r;
    for (int k = 0; k < registers; ++k)
      r.v[k] = hn::Set(Tag(), x);
    return r;
  }
  static HWY_INLINE Wide load(const double* from, int slot) {
    Wide r;
    for (int k = 0; k < registers; ++k)
      r.v[k] = hn::LoadU(Tag(), from + slot * step + k * tag_lanes);
    return r;
  }
  static HWY_INLINE void store(const Wide& x, double* to, int slot) {
    for (int k = 0; k < registers; ++k)
      hn::StoreU(x.v[k], Tag(), to + slot * step + k * tag_lanes);
  }
  // pairs that failed have left already: nothing to replace
  static HWY_INLINE const Wide& where(bool, const Wide& x, double) { return x; }
  static HWY_INLINE Wide slot_numbers(int slot) {
    double n[planes_per_quad];
    for (int k = 0; k < planes_per_quad; ++k)
      n[k] = slot * planes_per_quad + k;
    return load(n, 0);
  }
  static HWY_INLINE double add_up(const Wide& x) {
    double p[planes_per_quad];
    store(x, p, 0);
    return (p[0] + p[1]) + (p[2] + p[3]);
  }
  static HWY_INLINE double least(const Wide& x) {
    double p[planes_per_quad];
    store(x, p, 0);
    return smaller(smaller(p[0], p[1]), smaller(p[2], p[3]));
  }
  static HWY_INLINE double most(const Wide& x) {
    double p[planes_per_quad];
    store(x, p, 0);
    return larger(larger(p[0], p[1]), larger(p[2], p[3]));
  }
  // the largest, and of equal ones the first
  static HWY_INLINE void most_of(const Wide& x, const Wide& number, double& value, double& where) {
    double p[planes_per_quad], n[planes_per_quad];
    store(x, p, 0);
    store(number, n, 0);
    value = p[0];
    where = n[0];
    for (int k = 1; k < planes_per_quad; ++k) {
      const bool better = p[k] > value || (p[k] == value && n[k] < where);
      value = better ? p[k] : value;
      where = better ? n[k] : where;
    }
  }
  // add(slot, sums) over the quads [first, last)
  template <int K, class F>
  static HWY_INLINE void sum(int first, int last, double (&out)[K], const F& add) {
    Wide acc[K];
    for (int k = 0; k < K; ++k)
      acc[k] = wide(0);
    for (int q = first; q < last; ++q)
      add(q, acc);
    for (int k = 0; k < K; ++k)
      out[k] = add_up(acc[k]);
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
  static constexpr int slots_per_quad = planes_per_quad;
  static constexpr int step = width;

  static HWY_INLINE Wide wide(double x) { return {{hn::Set(Tag(), x)}}; }
  static HWY_INLINE const Wide& wide(const Wide& x) { return x; }
  static HWY_INLINE Real real(double x) { return wide(x); }
  static HWY_INLINE Real pick(const double* x) { return {{hn::LoadU(Tag(), x)}}; }
  static HWY_INLINE void put(const Real& x, double* out) { hn::StoreU(x.v[0], Tag(), out); }
  static HWY_INLINE Bool picked(const double* x) { return pick(x) > wide(0); }
  static HWY_INLINE Wide load(const double* from, int slot) { return {{hn::LoadU(Tag(), from + slot * step)}}; }
  static HWY_INLINE void store(const Wide& x, double* to, int slot) { hn::StoreU(x.v[0], Tag(), to + slot * step); }
  // a harmless value for pairs that failed: they ride along
  static HWY_INLINE Wide where(const Bool& good, const Wide& x, double otherwise) {
    return select(good, x, wide(otherwise));
  }
  static HWY_INLINE Wide slot_numbers(int slot) { return wide(slot); }
  static HWY_INLINE const Real& least(const Wide& x) { return x; }
  static HWY_INLINE const Real& most(const Wide& x) { return x; }
  static HWY_INLINE void most_of(const Wide& x, const Wide& number, Real& value, Real& where) {
    value = x;
    where = number;
  }
  template <int K, class F>
  static HWY_INLINE void sum(int first, int last, Wide (&out)[K], const F& add) {
    Wide even[K];
    for (int k = 0; k < K; ++k)
      even[k] = out[k] = wide(0);
    for (int stride = 0; stride < planes_per_quad; ++stride) {
      Wide acc[K];
      for (int k = 0; k < K; ++k)
        acc[k] = wide(0);
      for (int q = first; q < last; ++q)
        add(q * planes_per_quad + stride, acc);
      for (int k = 0; k < K; ++k) {
        if (stride == 0 || stride == 2) even[k] = acc[k];
        if (stride == 1) out[k] = even[k] + acc[k];
        if (stride == 3) out[k] = out[k] + (even[k] + acc[k]);
      }
    }
  }
};

// ---- planes as the parts store them: rows of normal and offset
// -------------------------------------------------------

template <class D>
HWY_INLINE void load_rows(D d, const double* rows, Components<hn::Vec<D>, 3>& n, hn::Vec<D>& offset) {
  hn::LoadInterleaved4(d, rows, n[0], n[1], n[2], offset);
}
template <class D>
HWY_INLINE void load_rows(D d, const double* rows, Components<hn::Vec<D>, 2>& n, hn::Vec<D>& offset) {
  if constexpr (row_length<2> == 4) {
    hn::Vec<D> unused;
    hn::LoadInterleaved4(d, rows, n[0], n[1], offset, unused);
  } else {
    hn::LoadInterleaved3(d, rows, n[0], n[1], offset);
  }
}

template <class L, int Dim>
HWY_INLINE void load_planes(const Sources<L::width>& source, int slot, Components<typename L::Wide, Dim>& n,
                            typename L::Wide& offset) {
  constexpr int length = row_length<Dim>;
  constexpr int rows = L::step;
  alignas(64) double buffer[rows * length];
  const double* from = buffer;
  if constexpr (L::one_pair) {
    const int first = slot * planes_per_quad, left = source.count[0] - first;
    if (left >= planes_per_quad) {
      from = source.rows[0] + first * length;
    } else {
      for (int k = 0; k < planes_per_quad; ++k)
        std::memcpy(buffer + k * length, k < left ? source.rows[0] + (first + k) * length : padding_row<Dim>,
                    length * sizeof(double));
    }
  } else {
    for (int lane = 0; lane < L::width; ++lane)
      std::memcpy(buffer + lane * length,
                  slot < source.count[lane] ? source.rows[lane] + slot * length : padding_row<Dim>,
                  length * sizeof(double));
  }
  using Tag = typename L::Tag;
  constexpr int registers = sizeof(offset.v) / sizeof(offset.v[0]);
  for (int k = 0; k < registers; ++k) {
    Components<hn::Vec<Tag>, Dim> part;
    load_rows(Tag(), from + k * (rows / registers) * length, part, offset.v[k]);
    for (int j = 0; j < Dim; ++j)
      n[j].v[k] = part[j];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace voussoir
HWY_AFTER_NAMESPACE();
#endif
