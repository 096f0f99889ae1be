#pragma once

// A free-standing column on rigid ground, pushed sideways until it tips over its edge. SI units, radians, per metre of
// width out of the plane. Column and ground are rigid; the joint between them has a stiffness per area, transfers no
// tension and does not slip.
namespace voussoir::reference {

struct PushedColumn {
  double breadth = 1;               // m, b
  double height = 3;                // m, h
  double weight = 3 * 2500 * 9.81;  // N/m, W
  double stiffness = 1e10;          // Pa/m, k
};

// a force to the right, when the column stands upright
struct Push {
  double x = 0, y = 3;  // m: its point, from the middle of the base, y > 0
  bool turns = false;   // with the column; else it stays horizontal. Its point always moves with the column
};

// N/m, at which a column on a rigid joint tips: W b/(2 y)
double rigid_push(const PushedColumn& column, const Push& push);

// N/m, under which the column is in equilibrium at this tilt, to the right, one end of its base lifted: the base
// presses along a length L as k times the overlap of its face and the ground, along the normal half way between the
// two, so with k tan(tilt/2) L² two thirds of L from the end that is lifted. Moments about that point leave one
// equation for the force; L follows from the forces along that normal. To the first order in the tilt, with a = (2W/(k
// tilt))^1/2,
//   F (y + (b/2 - x) tilt) = W (b/2 - a/3 - h/2 tilt),     F y = W (b/2 - a/3 - h/2 tilt) if it turns.
// Throws std::invalid_argument if the whole base is pressed, or the tilt is zero.
double push_at(const PushedColumn& column, const Push& push, double tilt);

// The largest of them, the capacity of the column, and its tilt: a/3 falls with growing tilt and h/2 tilt grows. Their
// sum is least at tilt³ = 2W/(9 k h²), where a = 3 h tilt: it reduces b/2 by 3/2 h tilt, so that the loss by the joint
// is proportional to the power -1/3 of its stiffness.
struct Tipping {
  double force = 0;  // N/m
  double tilt = 0;   // rad
};
Tipping tipping(const PushedColumn& column, const Push& push);

// the tilt (rad) at which the column is in equilibrium under a smaller force; std::invalid_argument for others
double tilt_under(const PushedColumn& column, const Push& push, double force);

// A block of mass m, free in space, from rest: displacement (m) and velocity (m/s) along a force F sin(ω t + phase) at
// its centroid.
struct Ride {
  double way = 0, velocity = 0;
};
Ride shaken_ride(double force_over_mass, double angular_frequency, double phase, double time);

// The same under a force that turns with it, off its centroid: the moment stays constant, the block turns by ½ α t²,
// and the force turns with it. The displacement along the force's initial direction, and to the left of it, by
// quadrature of Fresnel's integrals.
struct Spiral {
  double along = 0, aside = 0;  // m
  double turn = 0;              // rad, counter-clockwise
};
Spiral spun_up(double force_over_mass, double moment_over_inertia, double time);

}  // namespace voussoir::reference
