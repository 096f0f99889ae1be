#include "core/potential/first_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace voussoir {
namespace {

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

// the normals of a regular simplex
template <int Dim>
Vector<Dim> far_normal(int k) {
  if constexpr (Dim == 2)
    return k == 0 ? Vector<2>(0, 1) : Vector<2>((k == 1 ? -1 : 1) * std::sqrt(0.75), -0.5);
  else
    return Vector<3>(k < 2 ? 1 : -1, k % 2 == 0 ? 1 : -1, k == 0 || k == 3 ? 1 : -1) / std::sqrt(3.0);
}

// The tight planes of the dual simplex. With C = columns (a_i, u_i): C μ = (0, …, 0, 1) and (x, -t) C = d.
template <int Dim>
struct TightPlanes {
  static constexpr int size = Dim + 1;
  std::array<int, size> planes;  // of A, then of B; far ones below zero
  double inverse[size][size];    // rows: of the planes
  std::array<double, size> offsets;

  TightPlanes(const Vector<Dim>& around, double far) {
    for (int k = 0; k < size; ++k) {
      const Vector<Dim> normal = far_normal<Dim>(k);
      planes[k] = -1 - k;
      offsets[k] = far + normal.dot(around);
      for (int j = 0; j < Dim; ++j)
        inverse[k][j] = normal[j] * Dim / size;
      inverse[k][Dim] = 1.0 / size;
    }
  }
  double multiplier(int k) const { return std::max(inverse[k][Dim], 0.0); }
  // (x, -t) for the offsets
  std::array<double, size> solve(const std::array<double, size>& right) const {
    std::array<double, size> y{};
    for (int k = 0; k < size; ++k)
      for (int j = 0; j < size; ++j)
        y[j] += inverse[k][j] * right[k];
    return y;
  }
  // the plane enters for the first that loses its multiplier; false: it cannot
  bool exchange(int plane, const HalfSpace<Dim>& half_space, double unit) {
    double pivots[size], least = std::numeric_limits<double>::infinity();
    int leave = -1;
    for (int k = 0; k < size; ++k) {
      pivots[k] = inverse[k][Dim] * unit;
      for (int j = 0; j < Dim; ++j)
        pivots[k] += inverse[k][j] * half_space.normal[j];
      if (pivots[k] <= least_pivot) continue;
      const double ratio = multiplier(k) / pivots[k];
      if (ratio < least || (ratio == least && pivots[k] > pivots[leave])) {
        least = ratio;
        leave = k;
      }
    }
    if (leave < 0) return false;
    const double factor = 1 / pivots[leave];
    for (int j = 0; j < size; ++j)
      inverse[leave][j] *= factor;
    for (int k = 0; k < size; ++k)
      if (k != leave)
        for (int j = 0; j < size; ++j)
          inverse[k][j] -= pivots[k] * inverse[leave][j];
    planes[leave] = plane;
    offsets[leave] = half_space.offset;
    return true;
  }
};

// the most violated plane of one body
template <int Dim>
void find_violated(const HalfSpaces<Dim>& planes, const std::array<double, Dim + 1>& y, double unit, int number,
                   double& worst, int& plane) {
  const double allowed = -unit * y[Dim];
  for (const HalfSpace<Dim>& half_space : planes) {
    double violation = -half_space.offset - allowed;
    for (int j = 0; j < Dim; ++j)
      violation += half_space.normal[j] * y[j];
    if (violation > worst) {
      worst = violation;
      plane = number;
    }
    ++number;
  }
}

// the slacks in proportion to the multipliers
template <int Dim>
FirstPoint<Dim> share(const TightPlanes<Dim>& tight, int planes_of_a, const std::array<double, Dim + 1>& y,
                      const std::array<double, 2>& units, double both) {
  constexpr int size = Dim + 1;
  FirstPoint<Dim> first;
  std::array<double, 2> squares{};
  for (int k = 0; k < size; ++k) {
    if (tight.planes[k] < 0) {
      if (tight.multiplier(k) > far_multiplier) return first;
      continue;
    }
    squares[tight.planes[k] >= planes_of_a] += tight.multiplier(k) * tight.multiplier(k);
  }
  if (!(squares[0] > 0 && squares[1] > 0)) return first;
  first.found = true;
  const double of_a = units[0] * std::sqrt(squares[0]), of_b = units[1] * std::sqrt(squares[1]);
  first.ratio = of_a / of_b;
  const double least = -y[Dim] / (of_a + of_b);
  first.level = least / both;
  std::array<double, size> at = y;
  if (first.level > 0) {
    std::array<double, size> moved = tight.offsets;
    for (int k = 0; k < size; ++k) {
      const bool second = tight.planes[k] >= planes_of_a;
      if (tight.planes[k] >= 0)
        moved[k] += least * units[second] * units[second] * tight.multiplier(k) / (second ? of_b : of_a);
    }
    at = tight.solve(moved);  // its t is zero: the planes pass through the point
  }
  for (int j = 0; j < Dim; ++j)
    first.point[j] = at[j];
  return first;
}

}  // namespace

template <int Dim>
FirstPoint<Dim> find_first_point(const PlacedPotential<Dim>& a, const PlacedPotential<Dim>& b) {
  if (a.planes.empty() || b.planes.empty()) return {};
  // t is measured in both radii together
  const double unit_a = 1 / std::sqrt(a.plane_weight), unit_b = 1 / std::sqrt(b.plane_weight), both = unit_a + unit_b;
  const std::array<double, 2> units{unit_a / both, unit_b / both};
  const int planes_of_a = static_cast<int>(a.planes.size());
  const double reach = a.reach + b.reach;
  TightPlanes<Dim> tight(a.centre + a.reach / reach * (b.centre - a.centre), far_in_reaches * reach);
  int exchanges = 0;
  while (true) {
    const std::array<double, Dim + 1> y = tight.solve(tight.offsets);
    double worst = enough * both;
    int plane = -1;
    find_violated<Dim>(a.planes, y, units[0], 0, worst, plane);
    find_violated<Dim>(b.planes, y, units[1], planes_of_a, worst, plane);
    const bool in_b = plane >= planes_of_a;
    if (plane < 0 || ++exchanges > exchange_limit ||
        !tight.exchange(plane, in_b ? b.planes[plane - planes_of_a] : a.planes[plane], units[in_b])) {
      FirstPoint<Dim> first = share<Dim>(tight, planes_of_a, y, units, both);
      first.exchanges = exchanges;
      return first;
    }
  }
}

template FirstPoint<2> find_first_point<2>(const PlacedPotential<2>&, const PlacedPotential<2>&);
template FirstPoint<3> find_first_point<3>(const PlacedPotential<3>&, const PlacedPotential<3>&);

}  // namespace voussoir
