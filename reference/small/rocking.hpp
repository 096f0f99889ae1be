#pragma once

// A slender block that rocks on its corners (Housner 1963, Bull. Seismol. Soc. Am. 53, 403-417). SI units, radians, per
// metre of width.
namespace voussoir::reference {

struct RockingBlock {
  double breadth = 1;     // m, b
  double height = 4;      // m, h
  double density = 2500;  // kg/m3
  double gravity = 9.81;  // m/s2
};

double slenderness(const RockingBlock& block);        // rad, alpha = atan(b/h)
double rocking_frequency(const RockingBlock& block);  // 1/s, p = (3 g/(4 R))^1/2, R half the diagonal

// Time (s) from rest at `lean` (0 < lean < alpha) until the block stands upright, a quarter of its period.
//   Housner's for slender blocks: acosh(1/(1 - lean/alpha))/p;
//   that of a rigid block on a rigid base, whatever its shape: the integral of d lean over the speed,
//   2 p^2 (cos(alpha - lean) - cos(alpha - .)) being its square.
double housner_quarter_period(const RockingBlock& block, double lean);
double rigid_quarter_period(const RockingBlock& block, double lean);

// The same on a joint without tension, whose stiffness (Pa/m) is spread along the face: the corner sinks in, the
// pressed wedge transfers k tan(lean/2) L^2 at a third of its length L from the corner, along the mean of both faces'
// normals, and k_s L times the slip of that point across it. Newton's laws of the block's three freedoms, from rest
// with the weight supported upright, integrated in time.
double elastic_quarter_period(const RockingBlock& block, double lean, double normal_stiffness, double shear_stiffness);

// rad: by how much it has turned upright after a time (s), short of the quarter period
double elastic_turn(const RockingBlock& block, double lean, double normal_stiffness, double shear_stiffness,
                    double time);

// Ratio of the speeds after and before a rigid block's impact on its other corner: 1 - 3/2 sin^2 alpha.
double housner_restitution(const RockingBlock& block);

// Moment (N m/m) of the base about the middle of the face of a block that does not move at this lean: k b^3/12 lean
// while the whole face is pressed, and for lean > 2 W/(k b^2), when an end has lifted off, W (b/2 - a/3) with the
// contact length a = (2 W/(k lean))^1/2. First order in the lean.
double base_moment(const RockingBlock& block, double lean, double normal_stiffness);

}  // namespace voussoir::reference
