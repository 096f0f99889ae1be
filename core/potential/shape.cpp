#include "core/potential/shape.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/half_space_inl.hpp"
#include "core/potential/rounding.hpp"

namespace voussoir {
namespace {

// squares, their sum and the constant
constexpr double sum_rounding = 8 * machine_epsilon;

// planes and centre are placed
template <int Dim>
void weigh(const PotentialShape<Dim>& shape, PlacedPotential<Dim>& placed) {
  placed.plane_weight = (1 - shape.sphericity) / (shape.corner_radius * shape.corner_radius);
  placed.sphere_weight = shape.sphericity / (shape.sphere_radius * shape.sphere_radius);
  placed.reach = shape.sphere_radius;
}

}  // namespace

// of each particle of a pair, Eq. A.4, in one frame, Eq. A.5
template <int Dim>
void place(const PotentialShape<Dim>& shape, const Matrix<Dim>& rotation, const Vector<Dim>& origin,
           PlacedPotential<Dim>& placed) {
  placed.planes.resize(shape.sphericity < 1 ? shape.planes.size() : 0);
  for (std::size_t i = 0; i < placed.planes.size(); ++i) {
    HalfSpace<Dim>& plane = placed.planes[i];
    plane.normal.noalias() = rotation * shape.planes[i].normal;
    plane.offset = shape.planes[i].offset + plane.normal.dot(origin);
  }
  placed.centre = rotation * shape.centre + origin;
  weigh<Dim>(shape, placed);
}

template <int Dim>
void place(const PotentialShape<Dim>& shape, PlacedPotential<Dim>& placed) {
  if (shape.sphericity < 1)
    placed.planes = shape.planes;
  else
    placed.planes.clear();
  placed.centre = shape.centre;
  weigh<Dim>(shape, placed);
}

template <int Dim>
PlacedPotential<Dim> placed(const PotentialShape<Dim>& shape) {
  PlacedPotential<Dim> placed;
  place<Dim>(shape, placed);
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
  Vector<Dim> slope = Vector<Dim>::Zero();
  Matrix<Dim> curvature = Matrix<Dim>::Zero();
  PotentialDerivatives<Dim> at;
  for (const HalfSpace<Dim>& plane : potential.planes) {
    const double slack = signed_distance<Dim>(plane, point);
    if (slack <= 0) continue;
    ++at.planes;
    at.squares += slack * slack;
    slope += slack * plane.normal;
    curvature.noalias() += plane.normal * plane.normal.transpose();
  }
  const Vector<Dim> arm = point - potential.centre;
  at.gradient = 2 * (potential.plane_weight * slope + potential.sphere_weight * arm);
  at.hessian = 2 * (potential.plane_weight * curvature + potential.sphere_weight * Matrix<Dim>::Identity());
  at.value = potential.plane_weight * at.squares + potential.sphere_weight * arm.squaredNorm() - 1;
  return at;
}

// Each slack s = a·x - d is off by at most `error`, as |d| <= |x| + s and no s exceeds the root of the sum of squares;
// Σ s is at most that root times sqrt(planes).
template <int Dim>
double value_rounding(const PlacedPotential<Dim>& potential, const Vector<Dim>& point,
                      const PotentialDerivatives<Dim>& at) {
  const double far = point.norm() + potential.centre.norm(), root = std::sqrt(at.squares);
  const double error = placed_rounding * (far + point.norm() + root);
  const double lost = (2 * std::sqrt(at.planes) * root + at.planes * error) * error;
  const double arm = (point - potential.centre).norm();
  return potential.plane_weight * (lost + sum_rounding * at.squares) +
         potential.sphere_weight * arm * (placed_rounding * far + sum_rounding * arm) + sum_rounding;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                      \
  template void place<Dim>(const PotentialShape<Dim>&, const Matrix<Dim>&, const Vector<Dim>&, PlacedPotential<Dim>&); \
  template void place<Dim>(const PotentialShape<Dim>&, PlacedPotential<Dim>&);                                         \
  template PlacedPotential<Dim> placed<Dim>(const PotentialShape<Dim>&);                                               \
  template double value<Dim>(const PlacedPotential<Dim>&, const Vector<Dim>&);                                         \
  template PotentialDerivatives<Dim> derivatives<Dim>(const PlacedPotential<Dim>&, const Vector<Dim>&);                \
  template double value_rounding<Dim>(const PlacedPotential<Dim>&, const Vector<Dim>&,                                 \
                                      const PotentialDerivatives<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
