// Shear strength and dilation of rough joints after Barton and Bandis: Barton & Choubey (1977), Rock Mech. 10, 1-54;
// Bandis, Lumsden & Barton (1981), IJRMMS 18, 1-21 (scale); Barton & Bandis (1982) (slip at the peak); Barton, Bandis &
// Bakhtar (1985), IJRMMS 22, 121-140 (mobilisation). With the normal stress σ and the plastic slip β, x = β/peak_slip:
//
//   JRCn = JRC0 (Ln/L0)^(-0.02 JRC0)     JCSn = JCS0 (Ln/L0)^(-0.03 JRC0)     L0: sample_length, Ln: block_length
//   peak_slip = (Ln/500) (JRCn/Ln)^0.33, m
//   i = JRCn log10(JCSn/σ) degrees, within 0 and 70° - φr
//   τ = σ tan φ,  φ = φr x/0.3 for x < 0.3,  φr + m(x) i beyond;  without mobilisation φr + i
//
// where m(x) is the table of mobilised roughness and φr the friction of JointProperties. The joint rises by
// dd = tan(M' m i) dr while its offset r is the largest so far, with M' = dilation_share, never steeper than the
// friction in force; below the farthest offset it falls along the secant.
#pragma once

#include <array>

#include "core/joint_laws/joint_properties.hpp"
#include "text/angle.hpp"

namespace voussoir {

// rad: no friction angle is larger
inline constexpr double largest_friction_angle = 70 * degree;

// sets jrc, jcs and peak_slip by the lengths of block and sample
void scale_to_blocks(BartonBandis& law);

// rad: the angle i of the roughness at a normal stress, Pa
double roughness_angle(const JointProperties& properties, double stress);

// rad: the friction angle of the peak envelope at a normal stress, Pa, which mobilisation reaches at peak_slip
double peak_friction(const JointProperties& properties, double stress);

// The tangent of the peak envelope τ(σ) at a normal stress, Pa: τ = cohesion + tan(friction) σ. Between the stresses of
// the largest angle and of JCS the envelope is concave, so the tangent lies above it.
struct EnvelopeTangent {
  double friction = 0;  // rad, never negative
  double cohesion = 0;  // Pa
};
EnvelopeTangent envelope_tangent(const JointProperties& properties, double stress);

// Pa: below this normal stress the friction angle is the largest one; 0: at no stress
double stress_at_largest_angle(const JointProperties& properties);

// rad: the friction angle after a plastic slip, m, under a normal stress, Pa, and its derivative, rad/m
struct MobilisedAngle {
  double angle = 0, slope = 0;
};
MobilisedAngle mobilised_angle(const JointProperties& properties, double slip, double stress);

// the mean of the roughness that is mobilised between two plastic slips, m, and their middle
struct MobilisedOver {
  double fraction = 0, middle = 0;
};
MobilisedOver mobilised_over(const JointProperties& properties, double from, double to);

// tan of the dilation over such a slip under one normal stress, Pa: never above the friction in force at its middle
double barton_bandis_dilation(const JointProperties& properties, const MobilisedOver& slip, double stress,
                              double strength_factor);

// tan of the largest dilation at any slip and stress
double steepest_roughness(const JointProperties& properties);

// m: plastic slips at which the table of mobilised roughness has a kink; of a law without it those of a peak slip of 0
inline constexpr std::size_t mobilisation_kinks = 8;
std::array<double, mobilisation_kinks> slips_of_kinks(const JointProperties& properties);

}  // namespace voussoir
