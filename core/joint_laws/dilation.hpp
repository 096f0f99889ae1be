// Dilation of a joint: its rise as a function of its offset from the place where it was mated, and slip against a
// normal stress that grows as it rises.
#pragma once

#include <functional>
#include <span>

#include "core/joint_laws/joint_properties.hpp"

namespace voussoir {

// tan ψ in force: never above the coefficient of friction in force, which softening may still reach; otherwise slip
// would make energy. `friction`, rad, and the factor as friction_answer takes them.
double dilation_in_force(const JointProperties& properties, double friction, double strength_factor = 1);

// tan ψ of the steepest rise that the joint may have at any slip and stress
double steepest_dilation(const JointProperties& properties);

// m, after the offset r, m, with tan ψ = `tangent`:
//   constant  tan ψ min(r, r0)
//   falling   tan ψ r1 (1 - e^(-r/r1))
double rise_at(const JointProperties& properties, double tangent, double offset);

// Slip from an offset in the direction of the trial's shear force.
struct OffsetPath {
  double along = 0;   // m: the offset's component in that direction; negative: slip returns
  double across = 0;  // m

  double length(double slip) const;
};

// A force that is left over after a slip: continuous, positive at 0, and not at the slip `most`.
struct SlipExcess {
  double most = 0;     // m
  double at_zero = 0;  // N
  double noise = 0;    // N: of its rounding; an excess below it is none
  bool falls = false;  // whether it falls on the way back, too
  std::function<double(double)> at;
};

// The least slip in [0, most] at which there is no excess left. The rise has a kink where the offset reaches the limit
// of the dilation, and at its smallest, and the excess at some slips of its own, `kinks`, in any order. On the way back
// it may rise, and is looked at on several parts of the way: continuous slip ends at the first root.
double first_slip(const JointProperties& properties, const OffsetPath& path, const SlipExcess& excess,
                  std::span<const double> kinks = {});

}  // namespace voussoir
