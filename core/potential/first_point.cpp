#include "core/potential/first_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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

// The simplex that bounds the program before any plane does: the distance of its planes from the point p that divides
// the line of centres as the spheres' radii, over the sum of the radii, or over the distance of the centres if that is
// larger. A point x of both spheres has (Stewart's theorem)
//   |x - p|² <= (R_B |x - c_A|² + R_A |x - c_B|²) / (R_A + R_B) <= R_A R_B <= ((R_A + R_B) / 2)²,
// so that half contains all contacts; the program's optimum may be a little farther out, as corners recede. The nearer
// the planes, the fewer exchanges.
constexpr double far_in_reaches = 0.6;

// A pivot below this would spoil the inverse. The program only gives a start, so that a plane may be left out.
constexpr double least_pivot = 1e-9;

// violated by less than this fraction of t's unit, a plane may wait for Newton's method
constexpr double enough = 1e-3;

// several times the need of any pair; more is a cycle of degenerate planes
constexpr int exchange_limit = 100;

// the multiplier that a far plane may have at the optimum
constexpr double far_multiplier = 1e-6;

// the planes' columns are filled up to a multiple of the widest register
constexpr int most_lanes = 8;

// of the tight planes, of which there are three or four
constexpr int tight_lanes = 4;

// The search for the most violated plane stores a plane's number in the last bits of its violation, which is so
// compared to 4e-12 of itself.
constexpr std::uint64_t number_bits = (std::uint64_t{1} << 14) - 1;
constexpr std::size_t most_planes = number_bits - most_lanes;

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

// the plane most violated by more than `least` at y = (x, -t), of equal ones the first; -1: none
template <int Dim>
HWY_INLINE int most_violated(const Columns<Dim>& columns, const double (&y)[Dim + 1], double least) {
  const hn::CappedTag<double, most_lanes> d;
  const hn::RebindToUnsigned<decltype(d)> bits;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto number_mask = hn::Set(bits, number_bits), next = hn::Set(bits, static_cast<std::uint64_t>(lanes));
  auto number = hn::Sub(number_mask, hn::Iota(bits, 0));  // falls from plane to plane
  auto worst = hn::BitCast(d, hn::AndNot(number_mask, hn::BitCast(bits, hn::Set(d, least))));
  for (int i = 0; i < columns.stride; i += lanes) {
    const double* at = columns.numbers + i;
    auto violation = hn::Mul(hn::LoadU(d, at), hn::Set(d, y[0]));
    HWY_UNROLL(4)
    for (int k = 1; k < Dim; ++k)
      violation = hn::Add(violation, hn::Mul(hn::LoadU(d, at + k * columns.stride), hn::Set(d, y[k])));
    violation = hn::Add(violation, hn::Mul(hn::LoadU(d, at + (Dim + 1) * columns.stride), hn::Set(d, y[Dim])));
    violation = hn::Sub(violation, hn::LoadU(d, at + Dim * columns.stride));
    const auto numbered = hn::Or(hn::AndNot(number_mask, hn::BitCast(bits, violation)), number);
    worst = hn::Max(worst, hn::BitCast(d, numbered));
    number = hn::Sub(number, next);
  }
  const std::uint64_t found = hn::GetLane(hn::BitCast(bits, hn::MaxOfLanes(d, worst))) & number_bits;
  return found == 0 ? -1 : static_cast<int>(number_bits - found);
}

// The tight planes of the dual simplex. With C = columns (a_i, u_i): C μ = (0, …, 0, 1) and (x, -t) C = d.
template <int Dim>
struct TightFaces {
  static constexpr int size = Dim + 1;
  int planes[size];                        // far ones below zero
  double inverse[size][tight_lanes] = {};  // column k: of the plane k, its offset's coefficients in y, and last its μ
  double offsets[size];

  HWY_INLINE TightFaces(const Vector<Dim>& around, double far) {
    for (int k = 0; k < size; ++k) {
      const std::array<double, Dim> normal = far_normal<Dim>(k);
      planes[k] = -1 - k;
      offsets[k] = far;
      for (int j = 0; j < Dim; ++j) {
        offsets[k] += normal[j] * around[j];
        inverse[j][k] = normal[j] * Dim / size;
      }
      inverse[Dim][k] = 1.0 / size;
    }
  }
  HWY_INLINE double multiplier(int k) const { return std::max(inverse[Dim][k], 0.0); }
  // (x, -t) for the offsets
  HWY_INLINE void solve(const double (&right)[size], double (&y)[size]) const {
    for (int j = 0; j < size; ++j) {
      y[j] = inverse[j][0] * right[0];
      HWY_UNROLL(4)
      for (int k = 1; k < size; ++k)
        y[j] += inverse[j][k] * right[k];
    }
  }
  // The plane enters for the first that loses its multiplier, and y = (x, -t) moves onto it; false: it cannot.
  HWY_INLINE bool exchange(int plane, const Columns<Dim>& columns, double (&y)[size]) {
    double entering[size], violation = -columns.get(Dim, plane);
    HWY_UNROLL(4)
    for (int j = 0; j < size; ++j) {
      entering[j] = columns.get(j < Dim ? j : Dim + 1, plane);
      violation += entering[j] * y[j];
    }
    double pivots[tight_lanes], reciprocals[tight_lanes];
    const int leave = leaving(entering, pivots, reciprocals);
    if (leave < 0) return false;
    const hn::CappedTag<double, tight_lanes> d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    HWY_UNROLL(4)
    for (int j = 0; j < size; ++j) {
      const double row = inverse[j][leave] * reciprocals[leave];
      y[j] -= violation * row;
      for (int k = 0; k < tight_lanes; k += lanes) {
        const auto others = hn::Sub(hn::LoadU(d, inverse[j] + k), hn::Mul(hn::LoadU(d, pivots + k), hn::Set(d, row)));
        const auto leaves = hn::Eq(hn::Iota(d, k), hn::Set(d, static_cast<double>(leave)));
        hn::StoreU(hn::IfThenElse(leaves, hn::Set(d, row), others), d, inverse[j] + k);
      }
    }
    planes[leave] = plane;
    offsets[leave] = columns.get(Dim, plane);
    return true;
  }

 private:
  // the plane of the least multiplier over pivot, of equal ones of the largest pivot; -1: none
  HWY_INLINE int leaving(const double (&entering)[size], double (&pivots)[tight_lanes],
                         double (&reciprocals)[tight_lanes]) const {
    const hn::CappedTag<double, tight_lanes> d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    double ratios[tight_lanes];
    for (int k = 0; k < tight_lanes; k += lanes) {
      auto pivot = hn::Mul(hn::LoadU(d, inverse[0] + k), hn::Set(d, entering[0]));
      HWY_UNROLL(4)
      for (int j = 1; j < size; ++j)
        pivot = hn::Add(pivot, hn::Mul(hn::LoadU(d, inverse[j] + k), hn::Set(d, entering[j])));
      const auto fit = hn::Gt(pivot, hn::Set(d, least_pivot));
      const auto one = hn::Set(d, 1.0), reciprocal = hn::Div(one, hn::IfThenElse(fit, pivot, one));
      const auto multiplier = hn::Max(hn::LoadU(d, inverse[Dim] + k), hn::Zero(d));
      const auto none = hn::Set(d, std::numeric_limits<double>::infinity());
      hn::StoreU(pivot, d, pivots + k);
      hn::StoreU(reciprocal, d, reciprocals + k);
      hn::StoreU(hn::IfThenElse(fit, hn::Mul(multiplier, reciprocal), none), d, ratios + k);
    }
    int leave = 0;
    HWY_UNROLL(4)
    for (int k = 1; k < size; ++k)
      if (ratios[k] < ratios[leave] || (ratios[k] == ratios[leave] && pivots[k] > pivots[leave])) leave = k;
    return pivots[leave] > least_pivot ? leave : -1;
  }
};

// the slacks in proportion to the multipliers
template <int Dim>
HWY_INLINE FirstPoint<Dim> share(const TightFaces<Dim>& tight, const Columns<Dim>& columns, const double (&y)[Dim + 1],
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
  if (a.planes.size() + b.planes.size() > most_planes) return;
  // t is measured in both radii together
  const double unit_a = 1 / std::sqrt(a.plane_weight), unit_b = 1 / std::sqrt(b.plane_weight), both = unit_a + unit_b;
  const std::array<double, 2> units{unit_a / both, unit_b / both};
  const Columns<Dim> columns = fill<Dim>(a, b, units, scratch);
  const double reach = a.reach + b.reach;
  const Vector<Dim> line = b.centre - a.centre;
  TightFaces<Dim> tight(a.centre + a.reach / reach * line, far_in_reaches * std::max(reach, line.norm()));
  double y[Dim + 1];
  tight.solve(tight.offsets, y);
  int exchanges = 0;
  while (true) {
    const int plane = most_violated<Dim>(columns, y, enough * both);
    if (plane < 0 || ++exchanges > exchange_limit || !tight.exchange(plane, columns, y)) break;
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
