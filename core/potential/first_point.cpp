#include "core/potential/first_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// one compilation for each instruction set that is worth its size
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/potential/first_point.cpp"
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#endif
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace voussoir {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// the simplex that holds the program before any plane does, in reaches of both bodies
constexpr double far_in_reaches = 8;

// A pivot below this would spoil the inverse. The program only says where to begin, so that a plane may be left out.
constexpr double least_pivot = 1e-9;

// violated by less than this fraction of t's unit, a plane may wait for Newton's method
constexpr double enough = 1e-3;

// several times what any pair needs; more is a cycle of degenerate planes
constexpr int exchange_limit = 100;

// what a far plane may hold of the optimum
constexpr double far_multiplier = 1e-6;

// the planes' columns are filled up to a multiple of the widest register
constexpr int most_lanes = 8;

// the normals of a regular simplex
template <int Dim>
HWY_INLINE std::array<double, Dim> far_normal(int k) {
  if constexpr (Dim == 2) {
    return {k == 0 ? 0 : (k == 1 ? -1 : 1) * std::sqrt(0.75), k == 0 ? 1 : -0.5};
  } else {
    const double part = std::sqrt(1.0 / 3);
    return {k < 2 ? part : -part, k % 2 == 0 ? part : -part, k == 0 || k == 3 ? part : -part};
  }
}

// All planes side by side, A's first: one column each for the normal's components, d and u.
template <int Dim>
struct Columns {
  const double* numbers;
  int stride, planes_of_a;
  HWY_INLINE double get(int column, int plane) const { return numbers[column * stride + plane]; }
};

template <int Dim>
HWY_INLINE Columns<Dim> fill(const PlacedPotential<Dim>& a, const PlacedPotential<Dim>& b,
                             const std::array<double, 2>& units, std::vector<double>& scratch) {
  const std::size_t count = a.planes.size() + b.planes.size();
  const std::size_t stride = (count + most_lanes - 1) / most_lanes * most_lanes;
  if (scratch.size() < (Dim + 2) * stride) scratch.resize((Dim + 2) * stride);
  double* out = scratch.data();
  std::size_t i = 0;
  const auto put = [&](const Vector<Dim>& normal, double offset, double unit) {
    for (int k = 0; k < Dim; ++k)
      out[k * stride + i] = normal[k];
    out[Dim * stride + i] = offset;
    out[(Dim + 1) * stride + i] = unit;
    ++i;
  };
  for (const HalfSpace<Dim>& plane : a.planes)
    put(plane.normal, plane.offset, units[0]);
  for (const HalfSpace<Dim>& plane : b.planes)
    put(plane.normal, plane.offset, units[1]);
  while (i < stride)  // never violated
    put(Vector<Dim>::Zero(), std::numeric_limits<double>::max(), 0);
  return {out, static_cast<int>(stride), static_cast<int>(a.planes.size())};
}

// the plane most violated by more than `worst` at y = (x, -t), of equal ones the first; -1: none
template <int Dim>
HWY_INLINE int most_violated(const Columns<Dim>& columns, const double (&y)[Dim + 1], double& worst) {
  const hn::CappedTag<double, most_lanes> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  auto best = hn::Set(d, worst), where = hn::Set(d, -1.0), number = hn::Iota(d, 0);
  const auto next = hn::Set(d, static_cast<double>(lanes));
  for (int i = 0; i < columns.stride; i += lanes) {
    const double* at = columns.numbers + i;
    auto violation = hn::Mul(hn::LoadU(d, at), hn::Set(d, y[0]));
    for (int k = 1; k < Dim; ++k)
      violation = hn::Add(violation, hn::Mul(hn::LoadU(d, at + k * columns.stride), hn::Set(d, y[k])));
    violation = hn::Add(violation, hn::Mul(hn::LoadU(d, at + (Dim + 1) * columns.stride), hn::Set(d, y[Dim])));
    violation = hn::Sub(violation, hn::LoadU(d, at + Dim * columns.stride));
    const auto more = hn::Gt(violation, best);
    best = hn::IfThenElse(more, violation, best);
    where = hn::IfThenElse(more, number, where);
    number = hn::Add(number, next);
  }
  const double most = hn::GetLane(hn::MaxOfLanes(d, best));
  if (!(most > worst)) return -1;
  worst = most;
  const auto none = hn::Set(d, static_cast<double>(columns.stride));
  return static_cast<int>(hn::GetLane(hn::MinOfLanes(d, hn::IfThenElse(hn::Eq(best, hn::Set(d, most)), where, none))));
}

// The tight planes of the dual simplex. With C = columns (a_i, u_i): C μ = (0, …, 0, 1) and (x, -t) C = d.
template <int Dim>
struct TightPlanes {
  static constexpr int size = Dim + 1;
  int planes[size];            // far ones below zero
  double inverse[size][size];  // rows: of the planes
  double offsets[size];

  HWY_INLINE TightPlanes(const Vector<Dim>& around, double far) {
    for (int k = 0; k < size; ++k) {
      const std::array<double, Dim> normal = far_normal<Dim>(k);
      planes[k] = -1 - k;
      offsets[k] = far;
      for (int j = 0; j < Dim; ++j) {
        offsets[k] += normal[j] * around[j];
        inverse[k][j] = normal[j] * Dim / size;
      }
      inverse[k][Dim] = 1.0 / size;
    }
  }
  HWY_INLINE double multiplier(int k) const { return std::max(inverse[k][Dim], 0.0); }
  // (x, -t) for the offsets
  HWY_INLINE void solve(const double (&right)[size], double (&y)[size]) const {
    for (int j = 0; j < size; ++j) {
      y[j] = inverse[0][j] * right[0];
      for (int k = 1; k < size; ++k)
        y[j] += inverse[k][j] * right[k];
    }
  }
  // The plane enters for the first that loses its multiplier, and y = (x, -t) moves onto it; false: it cannot.
  HWY_INLINE bool exchange(int plane, const Columns<Dim>& columns, double violation, double (&y)[size]) {
    double pivots[size];
    int leave = -1;
    for (int k = 0; k < size; ++k) {
      pivots[k] = inverse[k][Dim] * columns.get(Dim + 1, plane);
      for (int j = 0; j < Dim; ++j)
        pivots[k] += inverse[k][j] * columns.get(j, plane);
      if (pivots[k] <= least_pivot) continue;
      // smaller multiplier over pivot, of equal ones the larger pivot
      const double here = leave < 0 ? -1 : multiplier(k) * pivots[leave],
                   there = leave < 0 ? 0 : multiplier(leave) * pivots[k];
      if (here < there || (here == there && pivots[k] > pivots[leave])) leave = k;
    }
    if (leave < 0) return false;
    const double factor = 1 / pivots[leave];
    for (int j = 0; j < size; ++j) {
      inverse[leave][j] *= factor;
      y[j] -= violation * inverse[leave][j];
    }
    for (int k = 0; k < size; ++k)
      if (k != leave)
        for (int j = 0; j < size; ++j)
          inverse[k][j] -= pivots[k] * inverse[leave][j];
    planes[leave] = plane;
    offsets[leave] = columns.get(Dim, plane);
    return true;
  }
};

// the slacks in proportion to the multipliers
template <int Dim>
HWY_INLINE FirstPoint<Dim> share(const TightPlanes<Dim>& tight, const Columns<Dim>& columns, const double (&y)[Dim + 1],
                                 const std::array<double, 2>& units, double both) {
  constexpr int size = Dim + 1;
  FirstPoint<Dim> first;
  std::array<double, 2> squares{};
  for (int k = 0; k < size; ++k) {
    if (tight.planes[k] < 0) {
      if (tight.multiplier(k) > far_multiplier) return first;
      continue;
    }
    squares[tight.planes[k] >= columns.planes_of_a] += tight.multiplier(k) * tight.multiplier(k);
  }
  if (!(squares[0] > 0 && squares[1] > 0)) return first;
  first.found = true;
  const double of_a = units[0] * std::sqrt(squares[0]), of_b = units[1] * std::sqrt(squares[1]);
  const double least = -y[Dim] / (of_a + of_b);
  first.ratio = of_a / of_b;
  first.level = least / both;
  double at[size], moved[size];
  std::copy_n(tight.offsets, size, moved);
  for (int k = 0; k < size; ++k) {
    const bool second = tight.planes[k] >= columns.planes_of_a;
    if (tight.planes[k] >= 0)
      moved[k] += least * units[second] * units[second] * tight.multiplier(k) / (second ? of_b : of_a);
  }
  tight.solve(first.level > 0 ? moved : tight.offsets, at);  // moved, the planes pass through the point
  std::copy_n(at, Dim, first.point.data());
  return first;
}

template <int Dim>
HWY_INLINE void search(const PlacedPotential<Dim>& a, const PlacedPotential<Dim>& b, std::vector<double>& scratch,
                       FirstPoint<Dim>& first) {
  // t is measured in both radii together
  const double unit_a = 1 / std::sqrt(a.plane_weight), unit_b = 1 / std::sqrt(b.plane_weight), both = unit_a + unit_b;
  const std::array<double, 2> units{unit_a / both, unit_b / both};
  const Columns<Dim> columns = fill<Dim>(a, b, units, scratch);
  const double reach = a.reach + b.reach;
  TightPlanes<Dim> tight(a.centre + a.reach / reach * (b.centre - a.centre), far_in_reaches * reach);
  double y[Dim + 1];
  tight.solve(tight.offsets, y);
  int exchanges = 0;
  while (true) {
    double worst = enough * both;
    const int plane = most_violated<Dim>(columns, y, worst);
    if (plane < 0 || ++exchanges > exchange_limit || !tight.exchange(plane, columns, worst, y)) break;
  }
  tight.solve(tight.offsets, y);  // without the rounding of all that moved it
  first = share<Dim>(tight, columns, y, units, both);
  first.exchanges = exchanges;
}

HWY_ATTR void FirstPoint2(const PlacedPotential<2>& a, const PlacedPotential<2>& b, std::vector<double>& scratch,
                          FirstPoint<2>& first) {
  search<2>(a, b, scratch, first);
}
HWY_ATTR void FirstPoint3(const PlacedPotential<3>& a, const PlacedPotential<3>& b, std::vector<double>& scratch,
                          FirstPoint<3>& first) {
  search<3>(a, b, scratch, first);
}

}  // namespace HWY_NAMESPACE
}  // namespace voussoir
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace voussoir {

HWY_EXPORT(FirstPoint2);
HWY_EXPORT(FirstPoint3);

template <int Dim>
FirstPoint<Dim> find_first_point(const PlacedPotential<Dim>& a, const PlacedPotential<Dim>& b,
                                 std::vector<double>& scratch) {
  FirstPoint<Dim> first;
  if (a.planes.empty() || b.planes.empty()) return first;
  if constexpr (Dim == 2)
    HWY_DYNAMIC_DISPATCH(FirstPoint2)(a, b, scratch, first);
  else
    HWY_DYNAMIC_DISPATCH(FirstPoint3)(a, b, scratch, first);
  return first;
}

template FirstPoint<2> find_first_point<2>(const PlacedPotential<2>&, const PlacedPotential<2>&, std::vector<double>&);
template FirstPoint<3> find_first_point<3>(const PlacedPotential<3>&, const PlacedPotential<3>&, std::vector<double>&);

}  // namespace voussoir
#endif
