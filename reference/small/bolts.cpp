#include "reference/small/bolts.hpp"

#include <cmath>

namespace voussoir::reference {

double bolt_over_joint(double stiffness, double length, double pretension, double opening, double slip) {
  return stiffness * (std::hypot(length + opening, slip) - length) + pretension;
}

double pretension_left(double pretension, double stiffness, double joint_stiffness, double area) {
  const double joint = joint_stiffness * area;
  return pretension * joint / (joint + stiffness);
}

double bolted_block_friction(double weight, double dip, double force, double angle) {
  return std::atan((weight * std::sin(dip) - force * std::cos(angle)) /
                   (weight * std::cos(dip) + force * std::sin(angle)));
}

double pull_out_stiffness(double axial_stiffness, double bond_stiffness, double length) {
  return std::sqrt(axial_stiffness * bond_stiffness) * std::tanh(length * std::sqrt(bond_stiffness / axial_stiffness));
}

double bar_over_opening(double axial_stiffness, double bond_stiffness, double bond_strength, double opening) {
  if (opening < 2 * bond_strength / bond_stiffness) return 0.5 * std::sqrt(axial_stiffness * bond_stiffness) * opening;
  return std::sqrt(axial_stiffness * bond_strength * (opening - bond_strength / bond_stiffness));
}

}  // namespace voussoir::reference
