#pragma once

#include <vector>

// Moments in closed rings and regular polygons, per metre of tunnel, inextensible members. Sagging positive (tension on
// the inside), thrust compression positive, pressure positive inwards, angles from the crown.
namespace voussoir::reference {

struct MemberForces {
  double moment = 0;  // N m per metre
  double thrust = 0;  // N per metre
};

// Circular ring, radius a, under a vertical pressure p per horizontal length from above and below:
// M = (p a^2/4) cos 2t, N = p a sin^2 t (Young, Budynas & Sadegh 2011, Roark's Formulas, table 9.2).
MemberForces ring_under_vertical_pressure(double pressure, double radius, double angle_from_crown);

// Regular polygon of n >= 3 sides with stiff corners, circumradius a, under a pressure q normal to its sides: by
// symmetry no corner turns, so each side is a clamped beam of length L = 2 a sin(pi/n): M(x) = q x (L - x)/2 - q
// L^2/12, that is -q a^2 sin^2(pi/n)/3 at a vertex and half of that, positive, at mid-side; N = q a cos(pi/n). fraction
// = x/L in 0..1. This is the ripple of Boon (2013), Fig. 5.39.
MemberForces polygon_under_pressure(double pressure, double circumradius, int sides, double fraction);

// Pressure on a straight member from its moments: minus the second derivative of the least-squares parabola (Boon 2013,
// appendix I, where sagging is negative and the pressure is 2w). position in m. Needs three different positions.
double pressure_from_moments(const std::vector<double>& position, const std::vector<double>& moment);

// Smoothing of moments (Boon 2013, Eqs I.1-I.4): radial pressures at equally spaced angles k 2 pi/count from the crown
// on a ring of radius a; their resultant is balanced by a shear A cos t + B sin t. With p = sum p_n cos(n t - f_n),
// equilibrium M''' + M' = -a^2 (p' + tau) and closure give M = a^2 sum_{n >= 2} p_n cos(n t - f_n)/(n^2 - 1). At least
// four angles. Throws std::invalid_argument, as the others do, on values out of range.
std::vector<double> ring_moments(const std::vector<double>& pressure, double radius);

}  // namespace voussoir::reference
