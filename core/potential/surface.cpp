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
  const double length = direction.norm(), from_centre = (point - potential.centre).norm();
  // the body lies in the sphere of radius R around its centre; twice that is outside at any rounding
  double inside = 0, outside = 2 * (from_centre + potential.reach) / length, t = 0;
  const double blur = rounding * (point.norm() + potential.centre.norm()) / length;
  while (true) {
    // Q(t + x) = q + 2 b x + c x², as long as the same planes count
    const Vector<Dim> x = point + t * direction;
    double q = 0, b = 0, c = 0;
    for (const HalfSpace<Dim>& plane : potential.planes) {
      const double slack = signed_distance<Dim>(plane, x);
      if (slack <= 0) continue;
      const double rate = plane.normal.dot(direction);
      q += slack * slack;
      b += slack * rate;
      c += rate * rate;
    }
    const Vector<Dim> arm = x - potential.centre;
    q = potential.plane_weight * q + potential.sphere_weight * arm.squaredNorm();
    b = potential.plane_weight * b + potential.sphere_weight * arm.dot(direction);
    c = potential.plane_weight * c + potential.sphere_weight * (length * length);
    (q < 1 ? inside : outside) = t;
    const double root = std::sqrt(std::max(b * b + c * (1 - q), 0.0));
    const bool turns = q < 1 && b < 0;  // the parabola still falls
    const double numerator = turns ? root - b : 1 - q, denominator = turns ? c : b + root;
    double next = inside + (outside - inside) / 2;
    if (std::abs(numerator) < denominator * (outside - inside)) {
      const double move = numerator / denominator;
      if (std::abs(move) <= blur + rounding * t) return t + move;
      if (t + move > inside && t + move < outside) next = t + move;
    }
    if (next <= inside || next >= outside) return next;
    t = next;
  }
}

template double distance_to_surface<2>(const PlacedPotential<2>&, const Vector<2>&, const Vector<2>&);
template double distance_to_surface<3>(const PlacedPotential<3>&, const Vector<3>&, const Vector<3>&);

}  // namespace voussoir
