#pragma once

// Shear stress of a joint that is sheared in one direction under a constant normal stress, by the joint's total slip:
// elastic slip τ/ks and plastic slip β. Pa, Pa/m, m, rad. Boon (2013), Eqs 4.18 and 6.7.
namespace voussoir::reference {

struct ShearCurve {
  double normal_stress = 0, stiffness = 0;  // ks at this stress
  double friction_angle = 0;
};

// constant friction
double perfectly_plastic_shear(const ShearCurve& curve, double slip);

// μ = tan φ (1 - e^(-β/scale)); plastic from the first slip on
double hardening_shear(const ShearCurve& curve, double scale, double slip);

// μ = tan φ - drop (1 - e^(-β/scale)); elastic up to tan φ. The spring must be stiff enough to follow:
// stiffness > normal_stress drop / scale.
double softening_shear(const ShearCurve& curve, double drop, double scale, double slip);

}  // namespace voussoir::reference
