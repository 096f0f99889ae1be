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

// k = 0: which face, right-angled edge or right-angled corner of the inner body each has nearest to the other; their
// outward directions oppose each other. Q = t²/r² at the distance t from the inner body, so that t_A / r_A = t_B / r_B;
// the inner bodies are `gap` apart.
PotentialContactForm touching_features(double corner_radius_a, double corner_radius_b, double gap);

// By how much rounding pulls in, along its bisector, if `faces` planes meet at right angles, all of which the sharp
// body's feature and the rounded body's faces share: (sqrt(faces) - 1) r.
double recess(int faces, double corner_radius);

// The same for k > 0 and one r, to first order in r/R, lengths over r. Over lengths of r the spheres' terms k |x -
// c|²/R² are constants, κ_A = k part_a and κ_B = k part_b: (1 - k) T_A² + κ_A = (1 - k) T_B² + κ_B, T_A + T_B = gap,
// and each surface is at (1 - k) T² + κ = 1.
struct RoundedForm {
  double from_first, from_second;  // T_A, T_B: of the contact point beyond the inner features
  double overlap;
};
RoundedForm rounded_features(double sphericity, double part_a, double part_b, double gap);

// By how much a contact `along` a face or an edge from the sphere's centre tilts the normal, over r, 1/m: the sphere's
// gradient there over that of the planes, k along / R² to (1 - k) T / r.
double tilt(double sphericity, double along, double sphere_radius, double from_feature);

// Eq. A.10 as printed, without s_A = s_B, for two spheres: minimise D_A / R_A + D_B / R_B on D_A + D_B = distance. It
// is least at an end: the distance from the first centre.
double unlinked_spheres(double radius_a, double radius_b, double distance);

// Eq. A.3 without f_A = f_B, for spheres and right-angled features: minimise t_A² / a² + t_B² / b² on t_A + t_B = gap,
// so that t_A : t_B = a² : b². The distance from the first; and the overlap a + b - gap below which this point is
// outside the larger body, so that no contact is seen: with a > b, t_A < a only if a + b - gap > b (1 - b / a).
double unlinked_squares(double length_a, double length_b, double gap);
double unseen_overlap(double length_a, double length_b);

}  // namespace voussoir::reference
