#pragma once

// A rough joint after Barton and Bandis, sheared in one direction between springs (constant normal stiffness) or
// tilted. Pa, Pa/m, m, rad. Barton & Choubey (1977); Barton, Bandis & Bakhtar (1985), whose table of mobilisation it
// has.
namespace voussoir::reference {

struct RoughJoint {
  double jrc = 0, jcs = 0;  // of the blocks
  double residual_friction = 0;
  double peak_slip = 0;         // 0: the peak envelope at any slip
  double dilation_share = 0.5;  // dilation over the mobilised roughness
};

// scaled from a sample to a block (Bandis et al. 1981), with the slip at the peak (Barton & Bandis 1982)
RoughJoint of_block(RoughJoint sample, double sample_length, double block_length);

// JRC log10(JCS/σ) within 0 and 70 degrees in all
double roughness_at(const RoughJoint& joint, double stress);
double friction_at(const RoughJoint& joint, double plastic_slip, double stress);
double dilation_at(const RoughJoint& joint, double plastic_slip, double stress);

struct ShearedJoint {
  double plastic_slip = 0, normal_stress = 0, shear_stress = 0;
};

// dσ = Ke tan(dilation) dβ, Ke = kn K/(kn + K) of the joint's stiffness kn and that of its surroundings, K, by
// Runge-Kutta of the fourth order, until β + τ/ks is the slip.
ShearedJoint shear_between_springs(const RoughJoint& joint, double normal_stress, double stiffness,
                                   double shear_stiffness, double slip);

// The angle at which a slab slides under its own weight: tan α = tan φ(σ), σ = w cos α, w its weight over its area.
double tilt_angle(const RoughJoint& joint, double weight_per_area);

}  // namespace voussoir::reference
