#pragma once

#include <array>
#include <vector>

// Closed forms for small cases every rigid-block code should pass. SI units, radians.
namespace voussoir::reference {

// --- a block on an incline (Newton 1687, Coulomb 1785; any textbook of mechanics)

struct Incline {
  double angle = 0;             // of the plane below horizontal, 0..pi/2
  double friction_angle = 0;    // 0 <= angle < pi/2, the same at rest and in motion
  double gravity = 9.81;        // m/s^2, > 0
  double initial_velocity = 0;  // m/s down the plane, >= 0
};

// The friction angle below which a block starts to slide: the angle of the plane.
double incline_critical_friction(const Incline& incline);

// Distance (m) down the plane after `time` (s, >= 0): v0 t + g (sin - cos tan phi) t^2/2 until it stops; a block at
// rest with friction_angle >= angle stays.
double incline_distance(const Incline& incline, double time);
double incline_velocity(const Incline& incline, double time);  // m/s

// --- the same block on a plane that is shaken along its slope (Newmark 1965, Geotechnique 15, 139-160)

// The plane moves at speed sin(2 pi frequency time) up the slope.
struct ShakenIncline {
  Incline incline;       // starts at rest on the plane: initial_velocity is not used
  double speed = 0;      // m/s, >= 0
  double frequency = 1;  // Hz, > 0
};

struct ShakenPosition {
  double distance = 0;  // m down the plane, relative to it
  double velocity = 0;  // m/s, the same
};

// Slips while the plane's acceleration up the slope exceeds a = g (tan phi cos - sin), and after that until the speeds
// are equal again: between t0 and t the relative velocity is v(t) - v(t0) - a (t - t0). Throws std::invalid_argument
// when the block slides without shaking, or when the plane's acceleration is so great that it slips upwards, too.
ShakenPosition shaken_block(const ShakenIncline& shaken, double time);

// Slip, m, of a block on level ground that is given a speed (m/s, > 0) at a constant acceleration and keeps it
// (Newmark's rectangular pulse): V²/2 (1/a - 1/A), a what friction holds, A the acceleration, m/s², 0 < a; 0 if A <= a.
double slip_of_pulse(double speed, double acceleration, double held);

// By how much a friction angle that falls at `rate` (rad/s, > 0) is below the plane's angle (rad) when the block has
// slid by `distance` (m, > 0), local damping taking the fraction `damping` (0..<1) of the force that drives it: (6 X
// cos(angle) r^2/((1 - damping) g))^(1/3), the leading term. With the next one it is 1 + tan(angle) bias/6 times this.
double incline_rate_bias(const Incline& incline, double distance, double rate, double damping);

// --- a block that meets a spring and a dashpot which cannot pull

struct Bounce {
  double mass = 1;           // kg, > 0
  double stiffness = 1;      // N/m, > 0
  double damping_ratio = 0;  // c / (2 sqrt(k m)), >= 0
  double impact_speed = 1;   // m/s into the contact, > 0
  double gravity = 0;        // m/s^2 into the contact, >= 0
};

struct BounceResult {
  bool rebounds = true;        // false: the force never returns to zero, the block stays in contact
  double duration = 0;         // s, until the force is zero; 0 without rebound
  double restitution = 0;      // speed away / impact_speed when the force is zero; 0 without rebound
  double end_overlap = 0;      // m, still positive when a damped contact ends
  double maximum_overlap = 0;  // m
};

// With w = sqrt(k/m), z the damping ratio, s = sqrt(1 - z^2), without gravity: the force k x + c v is zero at
// w s t = pi - 2 asin z = 2 acos z, where e = exp(-2 z acos(z)/s); the overlap is largest, (v/w) exp(-z acos(z)/s), at
// w s t = acos z. (Schwager & Poschel 2007, Granular Matter 9, 465-469, in one formula for all z by acos z/s ->
// acosh z/sqrt(z^2-1) above z = 1.) With gravity the end is a bracketed root of the same oscillation about the overlap
// m g/k. The contact ends where the force is zero, not where the overlap is. Throws std::invalid_argument.
BounceResult bounce(const Bounce& bounce);

// --- a column of equal blocks, each on a spring, the lowest on fixed ground

struct Column {
  int blocks = 1;         // N >= 1
  double mass = 1;        // kg each, > 0
  double stiffness = 1;   // N/m of every joint, > 0
  double gravity = 9.81;  // m/s^2
};

// Overlap of joint j = 0 (ground) .. N-1 (top): (N - j) m g/k, m.
std::vector<double> column_overlaps(const Column& column);

// Natural frequency (rad/s) of mode = 1..N of the fixed-free chain: 2 sqrt(k/m) sin((2 mode - 1) pi/(2 (2 N + 1))).
double column_frequency(const Column& column, int mode = 1);

// --- a body turning freely

// Principal moments of inertia of a box with these edges, kg m^2.
std::array<double, 3> box_inertia(double mass, const std::array<double, 3>& edges);

struct FreeRotation {
  std::array<double, 3> inertia{};           // principal moments, any order, > 0, each at most the sum of the others
  std::array<double, 3> angular_velocity{};  // at time zero, along the principal axes, rad/s
};

// Angular velocity along the body's principal axes at `time` (s) from Euler's equations by Jacobi's elliptic functions
// (Landau & Lifshitz 1976, Mechanics, section 37; any order of the moments, any start). Near the separatrix (rotation
// about the middle axis) the error grows with time like the motion itself. Throws std::invalid_argument on values out
// of range.
std::array<double, 3> free_rotation(const FreeRotation& body, double time);

// Period (s) of that motion, 4 K/lambda; +infinity on the separatrix, and for steady rotation, which has none.
double free_rotation_period(const FreeRotation& body);

// The same angular velocity (rad/s) along the axes that the body had at time zero: its attitude, a quaternion, is
// integrated by Runge and Kutta's method of fourth order in steps of at most 0.005 rad, which leaves some 1e-11 per rad
// turned.
std::array<double, 3> free_rotation_in_space(const FreeRotation& body, double time);

// --- a block that falls over an edge which neither slips nor lifts

struct FallOver {
  double mass = 1;        // kg, > 0
  double inertia = 1;     // kg m^2 about the edge, > 0
  double arm = 1;         // m from the edge to the centroid, > 0
  double start = 0.1;     // rad: initial lean of the arm off the vertical, without motion, 1e-6 <= start < pi
  double gravity = 9.81;  // m/s^2, > 0
};

// Time (s) until the lean has grown to `lean` (rad, start <= lean <= pi): a pendulum from above. With k^2 = m g arm/I,
// q = cos(start/2) and sin(b) = cos(lean/2)/q it is (K(q) - F(b, q))/k, F and K Legendre's elliptic integrals of the
// first kind, incomplete and complete (Landau & Lifshitz 1976, Mechanics, section 11). Throws std::invalid_argument.
double fall_over_time(const FallOver& block, double lean);

}  // namespace voussoir::reference
