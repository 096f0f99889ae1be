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

}  // namespace voussoir::reference
