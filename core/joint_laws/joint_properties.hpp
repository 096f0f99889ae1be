// The properties of a joint: the parameters of its laws (joint_law.hpp, elastic_coulomb.hpp).
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>

namespace voussoir {

// how a stiffness depends on the normal stress σ
enum class StiffnessLaw : unsigned char {
  constant,
  linear,      // kn = normal_stiffness + normal_growth σ, ks = shear_stiffness + shear_growth σ
  hyperbolic,  // normal only: kn = normal_stiffness (1 + σ/(normal_stiffness maximum_closure))²
  power        // kn = normal_stiffness (σ / 1 Pa)^normal_exponent, ks = shear_stiffness (σ / 1 Pa)^shear_exponent
};

// how the friction coefficient depends on the plastic slip β
enum class FrictionLaw : unsigned char {
  constant,
  hardening,     // tan φ (1 - e^(-β/u)), u = hardening_slip (σ / 1 Pa)^hardening_exponent
  softening,     // tan φ - softening_drop (1 - e^(-β/softening_slip))
  barton_bandis  // of the normal stress too (barton_bandis.hpp)
};

// how the rise of a joint depends on the distance r by which it has slipped from where it was mated
enum class DilationLaw : unsigned char {
  none,
  constant,  // tan ψ min(r, dilation_until)
  falling    // tan ψ dilation_decay (1 - e^(-r/dilation_decay))
};

// how cohesion depends on the plastic slip β since the bond was made, while the joint stays closed
enum class CohesionLaw : unsigned char {
  brittle,   // none after the first slip
  plastic,   // unchanged
  softening  // residual_cohesion + (cohesion - residual_cohesion) e^(-β/cohesion_slip)
};

// how much of Barton and Bandis' roughness acts
enum class Mobilisation : unsigned char {
  none,  // all of it at any slip: the envelope of limit equilibrium
  table  // what the plastic slip over that at the peak mobilises
};

// The roughness of a joint (barton_bandis.hpp). Without a block and a sample length both strengths are those of the
// blocks.
struct BartonBandis {
  double sample_jrc = 0;                       // 1: joint roughness coefficient of the sample
  double sample_jcs = 0;                       // Pa: compressive strength of its walls
  double sample_length = 0, block_length = 0;  // m; 0: not stated
  double dilation_share = 0.5;                 // 1: dilation over the mobilised roughness angle, M'
  Mobilisation mobilisation = Mobilisation::none;
  double jrc = 0, jcs = 0;  // of the blocks, and
  double peak_slip = 0;     // m: found by scale_to_blocks
};

// which joints have the tension and cohesion of their properties
enum class BondsMade : unsigned char {
  by_stage,  // those that a stage bonds
  as_sliced  // and from the first stage on, once, faces of one stated joint that are opposite each other when sliced
};

// the laws of a joint; their parameters are in its properties
struct JointLaws {
  StiffnessLaw normal = StiffnessLaw::constant, shear = StiffnessLaw::constant;
  FrictionLaw friction = FrictionLaw::constant;
  bool bond = false;  // strength in tension, cohesion or both, of bonds
  DilationLaw dilation = DilationLaw::none;
  bool set_aside = false;  // Barton and Bandis' friction, for the constant one of a stage's friction angle
  std::array<unsigned char, 2> unused{};  // none of its bytes is undefined

  bool depends_on_stress() const { return normal != StiffnessLaw::constant || shear != StiffnessLaw::constant; }

  // Linear springs, constant friction, no bond, no dilation: elastic_coulomb applies. Checked for every contact in
  // every step, so all are compared together.
  bool is_plain() const { return std::bit_cast<std::uint64_t>(*this) == 0; }
};

struct JointProperties {
  std::string name;
  // Pa/m per area, or N/m when the stiffness is constant; if it depends on stress: without stress (linear), or at
  // 1 Pa (power)
  double normal_stiffness = 0;
  double shear_stiffness = 0;       // same unit
  double friction = 0;              // rad, 0 <= friction < pi/2; of hardening the last, of softening the first, of
                                    // Barton and Bandis' law without roughness
  bool constant_stiffness = false;  // N/m for any area, which then is never computed (except with sub-contacts)
  int sub_contacts = 1;             // contact points of a face along each of its directions; 1: the contact's own

  JointLaws laws{};
  // those that no law uses are zero
  double normal_growth = 0, shear_growth = 0;         // 1/m
  double normal_exponent = 0, shear_exponent = 0;     // 0 < . < 1
  double hardening_slip = 0, hardening_exponent = 0;  // m at 1 Pa; 1
  double softening_drop = 0, softening_slip = 0;      // 1; m
  double maximum_closure = 0;                         // m: at which a hyperbolic law's stress is without limit
  double irrecoverable_fraction = 0;                  // of its largest closure, 0 <= . < 1
  BartonBandis barton_bandis{};
  double stated_friction = 0;                     // rad: of the scene, if a stage has set another
  double dilation = 0;                            // rad, ψ
  double dilation_until = 0, dilation_decay = 0;  // m
  double tension = 0, cohesion = 0;               // Pa
  CohesionLaw cohesion_law = CohesionLaw::brittle;
  double residual_cohesion = 0, cohesion_slip = 0;  // Pa, 0 to cohesion; m, 0: at once
  BondsMade bonds = BondsMade::by_stage;

  bool bonds_as_sliced() const { return laws.bond && bonds == BondsMade::as_sliced; }

  bool follows_barton_bandis() const { return laws.friction == FrictionLaw::barton_bandis; }
  bool states_barton_bandis() const { return follows_barton_bandis() || laws.set_aside; }

  bool dilates() const {
    return laws.dilation != DilationLaw::none || (follows_barton_bandis() && barton_bandis.dilation_share > 0);
  }

  // whether it has a JointRise beside its JointState
  bool remembers_place() const {
    return dilates() || irrecoverable_fraction > 0 || (states_barton_bandis() && barton_bandis.dilation_share > 0);
  }

  // whether its friction depends on its slip
  bool mobilises() const {
    if (follows_barton_bandis()) return barton_bandis.mobilisation == Mobilisation::table;
    return laws.friction != FrictionLaw::constant;
  }

  bool softens_cohesion() const {
    return cohesion_law == CohesionLaw::softening && laws.bond && residual_cohesion < cohesion;
  }
};

}  // namespace voussoir
