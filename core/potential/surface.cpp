#include "core/potential/surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voussoir {
namespace {

constexpr double rounding = 2 * std::numeric_limits<double>::epsilon();

}  // namespace

template <int Dim>
double distance_to_surface(const PlacedPotential<Dim>& potential, const Vector<Dim>& point,
                           const Vector<Dim>& direction) {
  // the body lies in the sphere of radius R around its centre; twice that is outside whatever rounding does
  double inside = 0, outside = 2 * ((point - potential.centre).norm() + potential.reach) / direction.norm();
  double t = outside;
  while (true) {
    const Vector<Dim> x = point + t * direction;
    double squares = 0, slope = 0;
    for (const HalfSpace<Dim>& plane : potential.planes) {
      const double slack = std::max(signed_distance<Dim>(plane, x), 0.0);
      squares += slack * slack;
      slope += slack * plane.normal.dot(direction);
    }
    const Vector<Dim> arm = x - potential.centre;
    const double root = std::sqrt(potential.plane_weight * squares + potential.sphere_weight * arm.squaredNorm());
    slope = potential.plane_weight * slope + potential.sphere_weight * arm.dot(direction);
    (root < 1 ? inside : outside) = t;
    double next = slope > 0 ? t - (root - 1) * root / slope : inside;
    if (!(next > inside && next < outside)) next = inside + (outside - inside) / 2;
    if (next <= inside || next >= outside || std::abs(next - t) <= rounding * t) return next;
    t = next;
  }
}

template double distance_to_surface<2>(const PlacedPotential<2>&, const Vector<2>&, const Vector<2>&);
template double distance_to_surface<3>(const PlacedPotential<3>&, const Vector<3>&, const Vector<3>&);

}  // namespace voussoir
