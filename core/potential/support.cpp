#include "core/potential/support.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/potential/rounding.hpp"

namespace voussoir {
namespace {

constexpr int multiplier_limit = 100;

}  // namespace

template <int Dim>
Support<Dim> find_support(const PlacedPotential<Dim>& potential, const Vector<Dim>& direction, RayScratch& scratch) {
  Support<Dim> support;
  support.point = potential.centre;
  // sqrt(Q), Q = f + 1, grows in proportion to τ on a sphere and beyond one face: Newton's method on sqrt(Q) = 1
  double multiplier = 2 * std::sqrt(potential.plane_weight + potential.sphere_weight);
  double low = 0, high = std::numeric_limits<double>::infinity();
  support.bound = high;
  for (int i = 0; i < multiplier_limit; ++i) {
    const LeastPoint<Dim> least =
        find_least_point<Dim>({{&potential, nullptr}, {1, 0}, multiplier * direction}, support.point, scratch);
    support.iterations += least.iterations;
    if (!least.converged) return support;
    support.point = least.point;
    const PotentialDerivatives<Dim> at = derivatives<Dim>(potential, least.point);

    // f(y) >= f(x) + ∇f·(y - x) bounds direction·y for every y inside, which lies within R of the centre
    const double slope_error = (multiplier * direction - at.gradient).norm();
    const double reach = potential.reach + (least.point - potential.centre).norm();
    const double bound = direction.dot(least.point) + (slope_error * reach - at.value) / multiplier;
    support.bound = std::min(support.bound, bound);

    const double root = std::sqrt(std::max(1 + at.value, 0.0));
    if (std::abs(root - 1) <= 4 * machine_epsilon) {
      support.converged = true;
      return support;
    }
    (root < 1 ? low : high) = multiplier;
    const double rate =
        -multiplier * direction.dot(newton_solution<Dim>(at.hessian, 2 * potential.sphere_weight, direction));
    double next = multiplier + (root > 0 && rate > 0 ? 2 * root * (1 - root) / rate : multiplier);
    if (!(next > low && next < high)) next = std::isfinite(high) ? low + (high - low) / 2 : 2 * low;
    if (next <= low || next >= high || std::abs(next - multiplier) <= 2 * machine_epsilon * multiplier) {
      // rounding of f, which r makes large, ends the search
      support.converged = true;
      return support;
    }
    multiplier = next;
  }
  return support;
}

template <int Dim>
PotentialBox<Dim> bounding_box(const PlacedPotential<Dim>& potential, RayScratch& scratch) {
  PotentialBox<Dim> box;
  for (int k = 0; k < Dim; ++k) {
    const Support<Dim> up = find_support<Dim>(potential, Vector<Dim>::Unit(k), scratch);
    const Support<Dim> down = find_support<Dim>(potential, -Vector<Dim>::Unit(k), scratch);
    // the enclosing sphere bounds it in any case
    box.high[k] = std::min(up.bound, potential.centre[k] + potential.reach);
    box.low[k] = std::max(-down.bound, potential.centre[k] - potential.reach);
  }
  return box;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                        \
  template Support<Dim> find_support<Dim>(const PlacedPotential<Dim>&, const Vector<Dim>&, RayScratch&); \
  template PotentialBox<Dim> bounding_box<Dim>(const PlacedPotential<Dim>&, RayScratch&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
