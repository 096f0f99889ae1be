#pragma once

#include "reference/tunnel/ring_moment.hpp"

// Thrust and moment of an arc of a circle in a circular bed, its ends free, under its own weight. Small displacements,
// no shear deformation, per metre of tunnel.
namespace voussoir::reference {

// The bed resists the arc's displacement radially and along it everywhere, in tension as well as in compression.
struct BeddedArc {
  double radius = 0;             // m, of its axis and of the bed
  double half_angle = 0;         // rad, from its lowest point to each end
  double axial_stiffness = 0;    // EA, N
  double bending_stiffness = 0;  // EI, N m2
  double normal_stiffness = 0;   // of the bed, Pa/m, > 0
  double shear_stiffness = 0;    // Pa/m, > 0
  double weight = 0;             // Pa, of the arc's length: density × gravity × thickness
};

// At an angle (rad) from the lowest point. With inward displacement w and u along the arc, away from the lowest point,
// the energy ∫ EA/2 ((w - u')/a)² + EI/2 ((w" + u')/a²)² + K/2 w² + Ks/2 u² a dθ and the loads -γ cos θ, -γ sin θ give,
// with e = EI/(EA a²), k = K a²/EA, ks = Ks a²/EA, G = γ a²/EA,
//   (w - u') + e (w"" + u"') + k w = -G cos θ
//   (w - u')' - e (w" + u')' + ks u = -G sin θ
// and free ends: w - u' = 0, w" + u' = 0, w"' + u" = 0. A particular solution A cos θ, B sin θ and three even ones
// cosh λθ, R sinh λθ, whose λ² are the roots of e x³ + e (2 - ks) x² + ((1 + k)(1 + e) - 1) x - (1 + k) ks = 0.
MemberForces bedded_arc(const BeddedArc& arc, double angle);

// The same on a rigid bed without resistance to sliding, of an arc that does not shorten: γ a (cos θ - cos θ0).
double sliding_arc_thrust(const BeddedArc& arc, double angle);

}  // namespace voussoir::reference
