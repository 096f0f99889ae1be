#pragma once

#include "reference/wedge/wedge.hpp"

// The wedge as a rigid block with three translations on two elastic, perfectly plastic Coulomb joints, followed
// quasi-statically: gravity is applied in small steps at a high friction angle, then friction falls until no
// equilibrium is left. Unlike limit equilibrium it keeps the history: settling under gravity locks shear across the
// sliding direction, which raises the normal forces, so the block holds to a slightly lower angle than the closed form.
//
// Law per unit area (elastic, perfectly plastic Mohr-Coulomb joints as in Boon 2013, section 4.8):
//   sigma = kn <w>,  w the overlap;   tau += -ks (slip);   |tau| <= sigma tan(phi), radial return, no dilation.
// Weight, kn and the size of the block cancel; ks/kn and area_a/area_b do not. For planes 40/130 and 60/220, gravity
// applied at 60 degrees or more, in degrees (step error below 0.0005; closed form 33.3572):
//
//   area_a/area_b   ks/kn = 0.1     0.5        1          2
//        0.8        33.325     33.252     33.195     33.142
//        1.0        33.353     33.318     33.274     33.229     (33.267 at ks/kn = 1 if gravity is applied at 36)
//        1.1305     33.357     33.345     33.320     33.293     (vertical face, dip direction 180)
//     1.3 to 5      33.3572 throughout, the closed form (but 33.341 at 1.3, ks/kn = 1, if gravity is applied at 36)
//
// So a comparison needs the areas of its own block: wedge_faces. The model neglects rotations, and the inertia of a
// reduction at a finite rate, which limits its use.
//
// Water lifts the block off its planes by the planes' uplift forces; sigma is then the effective stress. The
// order of loading matters as much as the joints' stiffness. The wedge of cases/wedge (areas 0.814083 and 0.773385 m^2,
// 4584.2747 N) under 1 kPa on both planes (closed form 46.6373), in degrees:
//
//   ks/kn   water with gravity, 70 degrees   water after gravity, 70    water after gravity, at 48 to 50
//    0.01           46.608                         46.608                     46.602 to 46.604
//    0.1            46.410                         46.410                     46.382 to 46.389
//     1             45.937                         45.937                     45.917 to 45.923
//
// Another calculation, whose path is not stated, gives 46.38 and 45.92 for the last two rows: the last column, in which
// friction was already low when the water was applied. A scene's water grows with gravity's factor: the first.
namespace voussoir::reference {

struct ElasticPlasticWedge {
  Wedge wedge;                  // friction angles are ignored; cohesion must be zero
  double area_a = 1;            // m^2, > 0
  double area_b = 1;            // m^2, > 0
  double normal_stiffness = 1;  // Pa/m, > 0
  double shear_stiffness = 1;   // Pa/m, > 0
};

struct WedgePathSettings {
  double friction_start = 1.2217304763960306;  // radians (70 degrees): gravity is applied at this angle
  int gravity_steps = 100;
  bool uplift_with_gravity = true;             // false: after it, in as many steps, still at friction_start
  double friction_step = 8.7266462599716e-06;  // radians (0.0005 degrees), near failure; wider far from it
  double smallest_step = 1e-9;                 // radians: the bracket on the critical angle
};

struct WedgePathResult {
  double critical_friction = 0;  // radians: the last angle with an equilibrium
  double step_error = 0;         // radians: its change when both step sizes are halved, the uncertainty of the path
  double normal_force_a = 0;     // at that angle
  double normal_force_b = 0;
  double start_shear_ratio_a = 0;  // |T|/N after gravity, before the friction falls
  double start_shear_ratio_b = 0;
};

// Each step solves the three force balances by Newton with the consistent (unsymmetric) tangent; the friction step is
// halved until smallest_step when no equilibrium is found. Throws std::invalid_argument on values out of range or when
// the block does not hold under gravity at friction_start.
WedgePathResult elastic_plastic_path(const ElasticPlasticWedge& block, const WedgePathSettings& settings = {});

struct WedgeFaces {
  double area_a = 0;  // m^2
  double area_b = 0;
  double volume = 0;  // m^3
};

// Faces of the tetrahedron cut by a horizontal top and a slope face, the line of intersection daylighting `height`
// (m, > 0) below the crest plane. Throws std::invalid_argument if the face does not cut a finite wedge: it must dip
// more steeply along the line than the line plunges.
WedgeFaces wedge_faces(const Wedge& wedge, double face_dip, double face_dip_direction, double height);

// Uplift forces (N) on those faces when their joints hold still water of this unit weight (N/m^3) up to `level` (m, 0
// .. height) above the lowest corner and the slope's face is dry: the wet part of a face is a triangle like the face,
// at a third of its depth on the mean.
struct WedgeUplift {
  double a = 0, b = 0;
};
WedgeUplift wedge_uplift(const WedgeFaces& faces, double height, double level, double unit_weight);

}  // namespace voussoir::reference
