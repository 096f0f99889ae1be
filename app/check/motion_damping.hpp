// What damps true motion: the lines of `voussoir check` about the damping of stages of kind `run`.
#pragma once

#include <string>

#include "core/base/settings.hpp"

namespace voussoir {

// Of critical damping, for a swing of a given frequency on the joints.
struct DampingRatios {
  double joints = 0;   // dashpots of damping.joint_ratio, normal and shear
  double viscous = 0;  // those of viscous_ratio, normal to the joints: at most, of the block whose joint is softest
  double local = 0;    // of local damping, at any frequency
};

// Dashpots in proportion to a stiffness k, c = 2 ξ k/ω0, have the ratio ξ ω/ω0 at ω. That of a contact is ξ of the
// swing of its own block, whose frequency is `joint_frequency`, Hz; 0: unknown, and no dashpot of viscous_ratio is
// reported. Local damping α leaves (1 - α)/(1 + α) of the energy of a half swing: ln((1 + α)/(1 - α))/2π.
DampingRatios damping_at(double frequency, const DampingSettings& damping, double joint_frequency);

// the ratios at 1 and at 10 Hz, and what takes the rest
std::string motion_damping_text(const DampingSettings& damping, double joint_frequency);

}  // namespace voussoir
