#include "core/potential/shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voussoir {
namespace {

// a slack's rounding as a fraction of the coordinates it is computed from: the products and sums of two rotated vectors
// lose at most 13 half-ulps
constexpr double slack_rounding = 8 * std::numeric_limits<double>::epsilon();

// squares, their sum and the constant
constexpr double sum_rounding = 8 * std::numeric_limits<double>::epsilon();

}  // namespace

template <int Dim>
void place(const PotentialShape<Dim>& shape, const Matrix<Dim>& rotation, const Vector<Dim>& origin,
           PlacedPotential<Dim>& placed) {
  placed.planes.clear();
  if (shape.sphericity < 1)
    for (const HalfSpace<Dim>& plane : shape.planes) {
      const Vector<Dim> normal = rotation * plane.normal;
      placed.planes.push_back({normal, plane.offset + normal.dot(origin)});
    }
  placed.plane_weight = (1 - shape.sphericity) / (shape.corner_radius * shape.corner_radius);
  placed.sphere_weight = shape.sphericity / (shape.sphere_radius * shape.sphere_radius);
  placed.centre = rotation * shape.centre + origin;
  placed.reach = shape.sphere_radius;
  placed.at_centre = value<Dim>(placed, placed.centre);
}

template <int Dim>
PlacedPotential<Dim> placed(const PotentialShape<Dim>& shape) {
  PlacedPotential<Dim> placed;
  place<Dim>(shape, Matrix<Dim>::Identity(), Vector<Dim>::Zero(), placed);
  return placed;
}

template <int Dim>
double value(const PlacedPotential<Dim>& potential, const Vector<Dim>& point) {
  double squares = 0;
  for (const HalfSpace<Dim>& plane : potential.planes) {
    const double slack = std::max(signed_distance<Dim>(plane, point), 0.0);
    squares += slack * slack;
  }
  return potential.plane_weight * squares + potential.sphere_weight * (point - potential.centre).squaredNorm() - 1;
}

template <int Dim>
PotentialDerivatives<Dim> derivatives(const PlacedPotential<Dim>& potential, const Vector<Dim>& point) {
  constexpr int entries = Dim * (Dim + 1) / 2;
  double slope[Dim]{}, curvature[entries]{}, squares = 0, lost = 0;
  const double far = point.norm() + potential.centre.norm();
  for (const HalfSpace<Dim>& plane : potential.planes) {
    const double slack = signed_distance<Dim>(plane, point);
    if (slack <= 0) continue;
    const double error = slack_rounding * (std::abs(plane.offset) + far);
    squares += slack * slack;
    lost += (2 * slack + error) * error;
    int entry = 0;
    for (int k = 0; k < Dim; ++k) {
      slope[k] += slack * plane.normal[k];
      for (int l = 0; l <= k; ++l)
        curvature[entry++] += plane.normal[k] * plane.normal[l];
    }
  }
  PotentialDerivatives<Dim> at;
  const Vector<Dim> arm = point - potential.centre;
  const double arm_squared = arm.squaredNorm();
  int entry = 0;
  for (int k = 0; k < Dim; ++k) {
    at.gradient[k] = 2 * (potential.plane_weight * slope[k] + potential.sphere_weight * arm[k]);
    for (int l = 0; l <= k; ++l, ++entry)
      at.hessian(l, k) = at.hessian(k, l) =
          2 * (potential.plane_weight * curvature[entry] + (k == l ? potential.sphere_weight : 0));
  }
  at.value = potential.plane_weight * squares + potential.sphere_weight * arm_squared - 1;
  at.rounding = potential.plane_weight * (lost + sum_rounding * squares) +
                potential.sphere_weight * (slack_rounding * far * std::sqrt(arm_squared) + sum_rounding * arm_squared) +
                sum_rounding;
  return at;
}

template <int Dim>
double value_rounding(const PlacedPotential<Dim>& potential, const Vector<Dim>& point) {
  return derivatives<Dim>(potential, point).rounding;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                      \
  template void place<Dim>(const PotentialShape<Dim>&, const Matrix<Dim>&, const Vector<Dim>&, PlacedPotential<Dim>&); \
  template PlacedPotential<Dim> placed<Dim>(const PotentialShape<Dim>&);                                               \
  template double value<Dim>(const PlacedPotential<Dim>&, const Vector<Dim>&);                                         \
  template PotentialDerivatives<Dim> derivatives<Dim>(const PlacedPotential<Dim>&, const Vector<Dim>&);                \
  template double value_rounding<Dim>(const PlacedPotential<Dim>&, const Vector<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
