#pragma once

// A block on an incline whose weight is applied suddenly: its contact rings, and it slips while the contact force is
// small, although the incline is below the friction angle. SI units, radians.
namespace voussoir::reference {

struct RingingBlock {
  double mass = 0;              // kg
  double incline = 0;           // rad, below the friction angle
  double friction_angle = 0;    // rad
  double normal_stiffness = 0;  // N/m, of the whole joint
  double shear_stiffness = 0;   // N/m
  double gravity = 9.81;        // m/s^2
};

// Plastic slip (m, accumulated) after `time` (s, >= 0). The block is in equilibrium under half of gravity, which then
// doubles: N = m g cos(incline) (1 - cos(wn t)/2), wn^2 = kn/m; along the incline a spring ks and a slider of strength
// N tan(phi) under m g sin(incline). No rotation, no damping. Both phases have closed solutions: a harmonic motion
// while it sticks, twice the integral of a known force while it slips; the end of a phase is bracketed and bisected to
// the last bit. Throws std::invalid_argument on values out of range.
double ringing_slip(const RingingBlock& block, double time);

}  // namespace voussoir::reference
