#include "reference/small/shear_curve.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir::reference {
namespace {

// the shear stress at which elastic and plastic slip add up to the slip: the plastic slip is found by bisection, since
// the slip grows with it
template <class Friction>
double shear_at(const ShearCurve& curve, double slip, const Friction& friction) {
  double low = 0, high = slip;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (friction(middle) * curve.normal_stress / curve.stiffness + middle < slip ? low : high) = middle;
  }
  return friction(high) * curve.normal_stress;
}

}  // namespace

double perfectly_plastic_shear(const ShearCurve& curve, double slip) {
  return std::min(curve.stiffness * slip, std::tan(curve.friction_angle) * curve.normal_stress);
}

double hardening_shear(const ShearCurve& curve, double scale, double slip) {
  return shear_at(curve, slip,
                  [&](double plastic) { return std::tan(curve.friction_angle) * (1 - std::exp(-plastic / scale)); });
}

double softening_shear(const ShearCurve& curve, double drop, double scale, double slip) {
  const double first = std::tan(curve.friction_angle) * curve.normal_stress;
  if (curve.stiffness * slip <= first) return curve.stiffness * slip;
  return shear_at(curve, slip, [&](double plastic) {
    return std::tan(curve.friction_angle) - drop * (1 - std::exp(-plastic / scale));
  });
}

}  // namespace voussoir::reference
