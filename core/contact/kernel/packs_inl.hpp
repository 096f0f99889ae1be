// Vector registers as numbers, one number as the same, and small vectors of either. Compiled once for each instruction
// set, inside its namespace.
#if defined(VOUSSOIR_PACKS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOUSSOIR_PACKS_INL
#undef VOUSSOIR_PACKS_INL
#else
#define VOUSSOIR_PACKS_INL
#endif

#include <hwy/highway.h>

#include <cmath>

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

#define VOUSSOIR_UNARY(name, function)              \
  template <class D, int M>                         \
  HWY_INLINE Pack<D, M> name(const Pack<D, M>& a) { \
    Pack<D, M> r;                                   \
    for (int k = 0; k < M; ++k)                     \
      r.v[k] = hn::function(a.v[k]);                \
    return r;                                       \
  }
VOUSSOIR_UNARY(operator-, Neg)
VOUSSOIR_UNARY(magnitude, Abs)
VOUSSOIR_UNARY(root, Sqrt)
#undef VOUSSOIR_UNARY

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

#define VOUSSOIR_OF_MASKS(name, function)                                            \
  template <class D, int M>                                                          \
  HWY_INLINE PackMask<D, M> name(const PackMask<D, M>& a, const PackMask<D, M>& b) { \
    PackMask<D, M> r;                                                                \
    for (int k = 0; k < M; ++k)                                                      \
      r.m[k] = hn::function(a.m[k], b.m[k]);                                         \
    return r;                                                                        \
  }
VOUSSOIR_OF_MASKS(both, And)
VOUSSOIR_OF_MASKS(either, Or)
#undef VOUSSOIR_OF_MASKS

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
HWY_INLINE double magnitude(double a) {
  return std::abs(a);
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

// Numbers that are not side by side in memory: value(first), value(first + 1), … A register loaded behind single stores
// would wait for them.
template <class D, class F>
HWY_INLINE hn::Vec<D> collected(D d, const F& value, int first) {
#if HWY_TARGET == HWY_SCALAR
  return hn::Set(d, value(first));
#else
  if constexpr (D::kPrivateN == 2) {
    return hn::InterleaveLower(d, hn::Set(d, value(first)), hn::Set(d, value(first + 1)));
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, collected(half, value, first + D::kPrivateN / 2), collected(half, value, first));
  }
#endif
}
template <class D, int M, class F>
HWY_INLINE Pack<D, M> collected(const F& value) {
  Pack<D, M> r;
  for (int k = 0; k < M; ++k)
    r.v[k] = collected(D(), value, k * D::kPrivateN);
  return r;
}

}  // namespace HWY_NAMESPACE
}  // namespace voussoir
HWY_AFTER_NAMESPACE();
#endif
