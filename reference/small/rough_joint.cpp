#include "reference/small/rough_joint.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace voussoir::reference {
namespace {

constexpr double degree = std::numbers::pi / 180;

// slip over that at the peak, and the roughness that is mobilised
constexpr double rows[][2] = {{0.3, 0}, {0.6, 0.75}, {1, 1}, {2, 0.85}, {4, 0.7}, {10, 0.5}, {25, 0.4}, {100, 0}};

double mobilised(double x) {
  if (x <= rows[0][0]) return 0;
  for (std::size_t k = 1; k < std::size(rows); ++k)
    if (x <= rows[k][0])
      return std::lerp(rows[k - 1][1], rows[k][1], (x - rows[k - 1][0]) / (rows[k][0] - rows[k - 1][0]));
  return 0;
}

}  // namespace

RoughJoint of_block(RoughJoint sample, double sample_length, double block_length) {
  RoughJoint joint = sample;
  joint.jrc *= std::pow(block_length / sample_length, -0.02 * sample.jrc);
  joint.jcs *= std::pow(block_length / sample_length, -0.03 * sample.jrc);
  joint.peak_slip = block_length / 500 * std::pow(joint.jrc / block_length, 0.33);
  return joint;
}

double roughness_at(const RoughJoint& joint, double stress) {
  return std::clamp(joint.jrc * std::log10(joint.jcs / stress) * degree, 0.0, 70 * degree - joint.residual_friction);
}

double friction_at(const RoughJoint& joint, double plastic_slip, double stress) {
  if (joint.peak_slip == 0) return joint.residual_friction + roughness_at(joint, stress);
  const double x = plastic_slip / joint.peak_slip;
  if (x < 0.3) return joint.residual_friction * x / 0.3;
  return joint.residual_friction + mobilised(x) * roughness_at(joint, stress);
}

double dilation_at(const RoughJoint& joint, double plastic_slip, double stress) {
  const double part = joint.peak_slip == 0 ? 1 : mobilised(plastic_slip / joint.peak_slip);
  return joint.dilation_share * part * roughness_at(joint, stress);
}

ShearedJoint shear_between_springs(const RoughJoint& joint, double normal_stress, double stiffness,
                                   double shear_stiffness, double slip) {
  constexpr int steps = 20000;
  const double h = slip / steps;
  const auto rate = [&](double beta, double stress) { return stiffness * std::tan(dilation_at(joint, beta, stress)); };
  const auto at = [&](double beta, double stress) {
    return ShearedJoint{beta, stress, stress * std::tan(friction_at(joint, beta, stress))};
  };
  const auto slip_of = [&](const ShearedJoint& s) { return s.plastic_slip + s.shear_stress / shear_stiffness; };
  ShearedJoint now = at(0, normal_stress), before = now;
  if (slip_of(now) >= slip) return {0, normal_stress, shear_stiffness * slip};  // elastic
  while (slip_of(now) < slip) {
    before = now;
    const double b = now.plastic_slip, s = now.normal_stress;
    const double k1 = rate(b, s), k2 = rate(b + h / 2, s + h / 2 * k1), k3 = rate(b + h / 2, s + h / 2 * k2),
                 k4 = rate(b + h, s + h * k3);
    now = at(b + h, s + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4));
  }
  const double part = (slip - slip_of(before)) / (slip_of(now) - slip_of(before));
  return {std::lerp(before.plastic_slip, now.plastic_slip, part),
          std::lerp(before.normal_stress, now.normal_stress, part),
          std::lerp(before.shear_stress, now.shear_stress, part)};
}

double tilt_angle(const RoughJoint& joint, double weight_per_area) {
  RoughJoint envelope = joint;
  envelope.peak_slip = 0;
  double low = 0, high = 89 * degree;
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    (friction_at(envelope, 0, weight_per_area * std::cos(middle)) > middle ? low : high) = middle;
  }
}

}  // namespace voussoir::reference
