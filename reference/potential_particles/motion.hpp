// Motions of rounded bodies that are known in closed form or by a quadrature. SI units, radians.
#pragma once

namespace voussoir::reference {

// A ball, or any body that does not turn, on a spring that cannot pull, without damping.
struct BouncingBall {
  double mass = 1;        // kg, > 0
  double stiffness = 1;   // N/m, > 0
  double gravity = 9.81;  // m/s², > 0
};

// From top to top of a ball that is dropped from `height` (m, >= 0) above first contact: 2 v/g of flight, v² = 2 g
// height, and (2/ω)(π - atan(ω v/g)) of contact, ω² = k/m: half a swing about the overlap m g/k, entered and left above
// it.
double ball_period(const BouncingBall& ball, double height);  // s

// A body whose round corner (in space: edge) rolls on a plane and neither slips nor lifts. Its round is an arc whose
// centre is at the distance `arm` from the centroid.
struct RollingCorner {
  double mass = 1;           // kg, > 0
  double inertia = 1;        // kg m², about the centroid, > 0
  double arm = 1;            // m, > 0
  double corner_radius = 0;  // m, of the arc, >= 0
  double start = 0.1;        // rad: initial lean of the arm off the vertical, without motion, 0 < start < π
  double gravity = 9.81;     // m/s², > 0
};

// m: of the centroid above the plane, at a lean: r + L cos φ. Its fall gives the kinetic energy.
double centroid_height(const RollingCorner& body, double lean);

// Speed (rad/s) at a lean that has grown from rest at `start`: the body turns about the point of contact, at the
// distance d from the centroid, d² = L² + r² + 2 r L cos φ, so that (I + m d²) ω²/2 = m g L (cos start - cos φ).
double rolling_speed(const RollingCorner& body, double lean);

// Time (s) until the lean has grown to `lean` (start <= lean <= π), by quadrature of 1/ω over φ = start + s², for which
// the integrand is smooth; relative error 1e-12. Throws std::invalid_argument, std::runtime_error.
double rolling_time(const RollingCorner& body, double lean);

// A square of edge 2 `half` whose corners are arcs of radius r < half about the corners of a square smaller by r, which
// is a potential particle with k = 0. The same for a prism in space. Per unit density and thickness.
struct RoundedSquare {
  double area = 0;     // m²
  double inertia = 0;  // m⁴, about the centroid
  double arm = 0;      // m, of an arc's centre from the centroid
};
RoundedSquare rounded_square(double half, double corner_radius);

}  // namespace voussoir::reference
