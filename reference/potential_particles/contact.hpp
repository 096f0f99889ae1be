// Contacts of potential particles that need no solver (Boon 2013, appendix A). Lengths in m, values of f without unit.
#pragma once

namespace voussoir::reference {

struct PotentialContactForm {
  double from_first;  // m, of the contact point from the first body's centre, inner corner or inner face
  double overlap;     // m, along the normal; negative: a gap
  double value;       // max(f_A, f_B) at the point
};

// k = 1: D_A / R_A = D_B / R_B on the line of centres
PotentialContactForm touching_spheres(double radius_a, double radius_b, double distance);

// k = 0: what face, right-angled edge or right-angled corner of the inner body each is nearest to the other, whose
// outward directions oppose each other. Q = t²/r² at the distance t from the inner body, so that t_A / r_A = t_B / r_B;
// the inner bodies are `gap` apart.
PotentialContactForm touching_features(double corner_radius_a, double corner_radius_b, double gap);

// How far rounding pulls in, along its bisector, where `faces` planes meet at right angles, all of which the sharp
// body's feature and the rounded body's faces share: (sqrt(faces) - 1) r.
double recess(int faces, double corner_radius);

// Eq. A.10 as printed, without s_A = s_B, for two spheres: minimise D_A / R_A + D_B / R_B on D_A + D_B = distance. It
// is least at an end: the distance from the first centre.
double unlinked_spheres(double radius_a, double radius_b, double distance);

}  // namespace voussoir::reference
