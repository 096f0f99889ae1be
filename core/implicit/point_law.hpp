// A joint's point over one step of implicit motion: the mean force that acts within the step, whose work is the change
// of the springs' energy plus what they lose, whatever the step. With the overlap u0 before and u1 after the step along
// the path of the point, p = max(u, 0), the slip Δ of the second body relative to the first, the shear T0 before it:
//
//   N = (V(u1) - V(u0))/(u1 - u0) + (c/h + χn k/2) (p1 - p0), not below 0;  V = k p²/2
//   T = Π(T0 - ((1 + χs) ks/2 + cs/h) Δ), Π the return to the disk of radius μ N
//
// c and cs are dashpots; χ = y²/(1 + y²), y = h (k/m)^½/2, dissipates what the step does not resolve. Energy and
// momentum of the discrete gradient: Gonzalez (1996); midpoint return: Simo & Govindjee (1991), IJNME 31, 1319.
//
// N and T are unknowns beside the velocities (a mixed form): then whole steps of Newton's method converge up to rigid
// joints. The equations of a point are solved for its force and its slope, which the system of the bodies needs.
#pragma once

#include "core/geometry/types.hpp"

namespace voussoir {

// of a point for a step of length h
struct PointStep {
  double h = 0;                           // s
  double normal = 0, shear = 0;           // N/m: k and ks
  double friction = 0;                    // μ
  double dashpot = 0, shear_dashpot = 0;  // N s/m: c and cs
  double chi_normal = 0, chi_shear = 0;   // 0: resolved, to 1
  double rho_normal = 0, rho_shear = 0;   // N/m: of joint and step the softer (see softer_of)
  double overlap = 0;                     // m: u0

  double loss() const { return dashpot / h + 0.5 * chi_normal * normal; }                // N/m: D = c/h + χn k/2
  double sticking() const { return 0.5 * (1 + chi_shear) * shear + shear_dashpot / h; }  // N/m
};

// χ of a spring between bodies of which the lighter free one has this mass
double unresolved_share(double stiffness, double mass, double h);

// 1/(h²/m + 1/k): with m/h² alone a resolved joint, with k alone an unresolved one would jump for ever
double softer_of(double stiffness, double mass, double h);

// N of the overlap after the step, and dN/du1; zero force has no slope
struct MeanNormal {
  double force = 0, slope = 0;
};
MeanNormal mean_normal(const PointStep& point, double overlap_after);

// u1 of a force N > 0, and dN/du1 there
struct OverlapAfter {
  double overlap = 0, slope = 0;
};
OverlapAfter overlap_after(const PointStep& point, double force);

// the unknowns of a point
template <int Dim>
struct PointForce {
  double normal = 0;                        // N; below 0 only between iterations
  Vector<Dim> shear = Vector<Dim>::Zero();  // N on the second body, across the normal
};

// The point's equations about its present force, for a motion that closes it to `overlap_after` and slips by `slip`:
// after a further motion δ of the second body relative to the first, the force on the second body is
//
//   force + change - slope δ.
template <int Dim>
struct LinearPoint {
  Matrix<Dim> slope = Matrix<Dim>::Zero();
  Vector<Dim> change = Vector<Dim>::Zero();  // N
  bool presses = false, sticks = false;
  double overlap_error = 0, slip_error = 0;  // m: what the present force leaves of its equations
};

// `from`: shear T0 before the step, N, in the plane of the point.
template <int Dim>
LinearPoint<Dim> linearise(const PointStep& point, const Vector<Dim>& normal, const Vector<Dim>& from,
                           double overlap_after, const Vector<Dim>& slip, const PointForce<Dim>& force);

// What a step leaves: the shear of the spring within the cone of its end, and where the energy went, J.
template <int Dim>
struct PointEnd {
  Vector<Dim> shear = Vector<Dim>::Zero();  // N: T1
  double plastic_slip = 0;                  // m
  double elastic_before = 0, elastic = 0;
  double friction = 0, dashpot = 0, unresolved = 0;  // lost, never negative
  bool stuck = false;
};
template <int Dim>
PointEnd<Dim> end_of_step(const PointStep& point, const Vector<Dim>& from, double overlap_after,
                          const Vector<Dim>& slip, const PointForce<Dim>& force);

}  // namespace voussoir
