// Joint laws beyond the plain one (Boon 2013, Eqs 4.10-4.14, 4.16-4.18, 6.3-6.7; decisions in
// core/joint_laws/README.md): stiffness that depends on the normal stress, strength in tension, cohesion that
// slip takes or leaves, friction that hardens or softens with slip or follows Barton and Bandis (barton_bandis.hpp).
// The table of scene keys (scene/keys/joint_properties.cpp) repeats parameters and equations for users.
#pragma once

#include "core/joint_laws/elastic_coulomb.hpp"
#include "core/joint_laws/joint_rise.hpp"
#include "core/joint_laws/joint_state.hpp"

namespace voussoir {

struct NormalAnswer {
  double stress = 0;     // Pa, compression positive
  double stiffness = 0;  // Pa/m, tangent
  double energy = 0;     // J/m², ∫σ du from no stress
};

// Stress of a joint closed by `overlap`, m, >= 0. A tensile strength σt shifts the origin to δ0 = σt/kn, where it
// stays: the stress reaches -σt as the overlap reaches 0, and without a bond it is zero below δ0 (Eqs 6.5, 6.6).
//   constant  σ = kn u
//   linear    σ = (k0/c)(e^(c u) - 1)                 integral of dσ/du = k0 + c σ        (Eqs 4.10, 4.12, 4.14)
//   power     σ = ((1-m) k1 u)^(1/(1-m))              integral of dσ/du = k1 (σ/1 Pa)^m   (Eq. 4.13)
//   hyperbolic  σ = ki u/(1 - u/Vm)                   Bandis, Lumsden & Barton (1983)
// Below the largest closure so far, m, of which a fraction ρ is irrecoverable, a hyperbolic law unloads and reloads
// along σ = ki Vm/(1 - ρ) (u - ρ u_max)/(Vm - u), the hyperbola with the same limit through (ρ u_max, 0) and the point
// of unloading. Beyond 0.999 Vm both continue along the tangent of loading, so that every overlap has a stress.
NormalAnswer normal_answer(const JointProperties& properties, double overlap, bool bonded, double largest_closure = 0);

// J/m²: lost for ever by a closure whose largest so far grows from one value to another, m
double crushing_between(const JointProperties& properties, double closure, double largest);

// the largest stiffness of a joint closed by `overlap`, loading or unloading, Pa/m
double stiffest_normal(const JointProperties& properties, double overlap);

// the overlap, m, at a compressive stress, Pa
double overlap_at(const JointProperties& properties, double stress);

// Pa/m at a normal stress, Pa; zero under tension if it is a power of the stress (Eqs 4.11, 4.17)
double shear_stiffness_at(const JointProperties& properties, double stress);

// tan φ after a plastic slip `slip`, m, under a normal stress, Pa, where `friction`, rad, is the joint's own
// (Eqs 4.16, 4.18, 6.7), and its derivative, 1/m. In a search for a factor of safety the joint's friction angle is that
// of tan φ over the factor; here it divides the softening drop, elsewhere the cohesion. Barton and Bandis' law has the
// friction of the properties, undivided, and the factor divides the tangent of its angle.
struct FrictionAnswer {
  double coefficient = 0, slope = 0;
};
FrictionAnswer friction_answer(const JointProperties& properties, double friction, double slip, double stress,
                               double strength_factor = 1);

// The cohesion of a bond, Pa, after the plastic slip `slip`, m, since it was made, and its derivative, Pa/m: c of a
// whole one, c(β) = c_r + (c - c_r) e^(-β/s) of a slipped one, both over the strength factor; none of a lost one.
struct CohesionAnswer {
  double stress = 0, slope = 0;
};
CohesionAnswer cohesion_answer(const JointProperties& properties, Bond bond, double slip, double strength_factor = 1);

// of a bond: what its cohesion adds to the strength
struct Adhesion {
  double area = 0;  // m²
  Bond bond = Bond::lost;
  double slip = 0;  // m, since it was made
};

// The plastic slip p of a return to the cone after the slip β = `plastic_slip`: trial - K p = c(β' + p) A + μ(β + p) N,
// within [0, trial/K], over which the left side minus the right changes from positive to not positive. Hardening makes
// that difference convex, softening of friction or cohesion concave: one root either way, to which Newton's method runs
// from one side. Needs K > 0 and trial > c(β') A + μ(β) N.
struct SlipReturn {
  double slip = 0;         // m
  bool snap_back = false;  // strength fell faster than the spring unloads, N |μ'| + A |c'| > K: no quasi-static path
                           // leads here
};
SlipReturn return_to_cone(const JointProperties& properties, double friction, double plastic_slip, double trial,
                          double stiffness, double normal_force, double stress, double strength_factor = 1,
                          const Adhesion& adhesion = {});

// The place of a joint that remembers one, with the length of the step, s, over which its rise adds to the closing
// speed; 0: it has no speed.
template <int Dim>
struct PlaceOfJoint {
  JointRise<Dim>* rise = nullptr;
  double seconds = 0;
};

// of one with any laws
template <int Dim>
struct LawForce : JointForce<Dim> {
  double grown = 0;     // m, by which the joint rose in this step
  double dilation = 0;  // J given back to the normal spring by the rise of a joint, negative as it rises
  double crushing = 0;  // J lost by closure that will not be recovered
};

// As elastic_coulomb, for a joint with any laws; stiffness per area only. It updates the history's shear force, plastic
// slip, shear stiffness and bond. A joint that remembers its place has it in `place`, whose offset has been rotated to
// the new plane; its overlap is the closure of its spring, that of the bodies and the rise before the step.
template <int Dim>
LawForce<Dim> joint_law(const JointProperties& properties, double friction, double dashpot,
                        const JointKinematics<Dim>& kinematics, JointState<Dim>& history, double strength_factor = 1,
                        PlaceOfJoint<Dim> place = {});

}  // namespace voussoir
