// [[joint_properties]]: the parameters of the laws in core/joint_laws.
#include "core/joint_laws/joint_properties.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {
namespace {

constexpr Range length_of_blocks{1e-3, 1e4};  // powers of their ratio are finite

}  // namespace

// clang-format off
KeyTable joint_property_keys() {
  return {"joint_properties", {
    {.key = "name", .members = {in(&JointProperties::name, name)}, .example = "\"rock\"", .required = true,
     .meaning = "unique among the joint properties; `default`, or else the first, applies to faces that no joint made"},
    {.key = "normal_stiffness", .members = {in(&JointProperties::normal_stiffness)}, .unit = "Pa/m",
     .range = stiffness, .plausible = plausible_stiffness, .example = "10e9", .required = true,
     .meaning = "normal stress per overlap (N/m with constant_stiffness)",
     .breaks = "too soft: blocks sink into each other; too stiff: the time step shrinks with its square root",
     .mistake = stiffness_mistake},
    {.key = "shear_stiffness", .members = {in(&JointProperties::shear_stiffness)}, .unit = "Pa/m", .range = stiffness,
     .plausible = plausible_stiffness, .example = "1e9", .required = true,
     .meaning = "shear stress per slip before sliding (N/m with constant_stiffness)", .mistake = stiffness_mistake},
    {.key = "friction_deg", .members = {degrees(&JointProperties::friction)}, .unit = "deg", .range = friction_range,
     .plausible = plausible_friction, .example = "35", .required = true,
     .meaning = "friction angle; of Barton and Bandis' law that without roughness, φr, below 70 degrees", .repair = "give the angle, not its tangent, below 90 degrees",
     .mistake = friction_mistake},
    {.key = "constant_stiffness", .members = {in(&JointProperties::constant_stiffness)}, .example = "true",
     .meaning = "the stiffness is in N/m and independent of the contact area, which is not computed"},
    {.key = "measured", .type = boolean, .example = "true",
     .meaning = "the stiffness was measured: an error budget (accuracy.budget) then reports a value's sensitivity to it, but does not "
         "count it as an error"},
    {.key = "sub_contacts", .members = {in(&JointProperties::sub_contacts)}, .range = {1, 64}, .example = "4",
     .meaning = "number of contact points of a joint face along each of its directions (4: 4 in 2-D, 4 x 4 in 3-D); 1: the contact point "
         "only",
     .breaks = "with one point a face does not resist twist, nor rocking as a real face does; more points cost time"},
    {.key = "normal_law", .members = {one_of(&JointLaws::normal,
         {{"constant", StiffnessLaw::constant}, {"linear", StiffnessLaw::linear},
          {"hyperbolic", StiffnessLaw::hyperbolic}, {"power", StiffnessLaw::power}})},
     .example = "\"linear\"",
     .meaning = "normal stiffness kn against normal stress σ; constant: kn = normal_stiffness; linear: normal_stiffness + "
         "normal_growth σ, so that σ = normal_stiffness / normal_growth (exp(normal_growth u) - 1) at overlap u; hyperbolic: normal_stiffness (1 + σ / (normal_stiffness maximum_closure_m))², so that σ = normal_stiffness u / "
         "(1 - u / maximum_closure_m); power: normal_stiffness "
         "(σ / 1 Pa)^normal_exponent, so that normal_stiffness is the stiffness at 1 Pa",
     .breaks = "stiffness grows with load, and the time step shrinks with its square root"},
    {.key = "normal_growth", .members = {in(&JointProperties::normal_growth)}, .unit = "1/m", .range = positive,
     .plausible = {100, 1e6}, .example = "7.4e4", .required = true, .when = {"normal_law", "linear"},
     .meaning = "increase of normal stiffness per normal stress"},
    {.key = "normal_exponent", .members = {in(&JointProperties::normal_exponent)}, .unit = "1",
     .range = {0, 1, true, true}, .plausible = {0.1, 0.95}, .example = "0.75", .required = true,
     .when = {"normal_law", "power"},
     .meaning = "exponent of the normal stress", .repair = "it must be below 1: from 1 on no stress builds up from zero"},
    {.key = "maximum_closure_m", .members = {in(&JointProperties::maximum_closure)}, .unit = "m", .range = positive,
     .plausible = {1e-6, 2e-3}, .example = "2e-4", .required = true, .when = {"normal_law", "hyperbolic"},
     .meaning = "closure that no stress exceeds (Bandis' Vm); at 0.999 of it the law continues along its tangent",
     .breaks = "stiffness grows with the square of the stress, and the time step shrinks with its square root",
     .mistake = "was it given in mm?"},
    {.key = "irrecoverable_fraction", .members = {in(&JointProperties::irrecoverable_fraction)}, .unit = "1",
     .range = {0, 0.99}, .example = "0.4", .when = {"normal_law", "hyperbolic"},
     .meaning = "fraction of the largest closure so far that remains without stress, until the joint has opened by more; unloading and "
         "reloading follow the hyperbola of the same maximum_closure_m through that closure and the largest one; 0: elastic"},
    {.key = "shear_law", .members = {one_of(&JointLaws::shear,
         {{"constant", StiffnessLaw::constant}, {"linear", StiffnessLaw::linear}, {"power", StiffnessLaw::power}})},
     .example = "\"linear\"",
     .meaning = "shear stiffness ks against normal stress σ; constant: ks = shear_stiffness; linear: shear_stiffness + "
         "shear_growth σ; power: shear_stiffness (σ / 1 Pa)^shear_exponent",
     .breaks = "creates or loses energy if the normal stress changes under shear: `stiffening` in the energy table"},
    {.key = "shear_growth", .members = {in(&JointProperties::shear_growth)}, .unit = "1/m", .range = positive,
     .plausible = {100, 1e6}, .example = "9.7e4", .required = true, .when = {"shear_law", "linear"},
     .meaning = "increase of shear stiffness per normal stress"},
    {.key = "shear_exponent", .members = {in(&JointProperties::shear_exponent)}, .unit = "1", .range = {0, 2, true},
     .plausible = {0.1, 1.5}, .example = "0.7", .required = true, .when = {"shear_law", "power"},
     .meaning = "exponent of the normal stress"},
    {.key = "friction_law", .members = {one_of(&JointLaws::friction,
         {{"constant", FrictionLaw::constant}, {"hardening", FrictionLaw::hardening},
          {"softening", FrictionLaw::softening}, {"barton_bandis", FrictionLaw::barton_bandis}})},
     .example = "\"softening\"",
     .meaning = "friction coefficient μ against accumulated plastic slip β; constant: tan(friction_deg); hardening: "
         "tan(friction_deg) (1 - exp(-β / up)), up = hardening_slip_m (σ / 1 Pa)^hardening_exponent; softening: "
         "tan(friction_deg) - softening_drop (1 - exp(-β / softening_slip_m)); barton_bandis: tan(friction_deg + i), at most 70 degrees, with "
         "the roughness angle i = jrc log10(jcs / σ) under the normal stress σ; strength reduction changes friction_deg, and divides "
         "Barton and Bandis' shear strength",
     .breaks = "friction that falls faster than the shear spring unloads causes snap-back, counted as snap_backs"},
    {.key = "hardening_slip_m", .members = {in(&JointProperties::hardening_slip)}, .unit = "m", .range = positive,
     .plausible = {1e-8, 1e-4}, .example = "2e-6", .required = true, .when = {"friction_law", "hardening"},
     .meaning = "plastic slip at which friction has reached 63 % of its final value, at a normal stress of 1 Pa"},
    {.key = "hardening_exponent", .members = {in(&JointProperties::hardening_exponent)}, .unit = "1", .range = {0, 2},
     .plausible = {.low = 0.01, .high = 1, .or_zero = true}, .example = "0.213",
     .when = {"friction_law", "hardening"},
     .meaning = "exponent with which hardening_slip_m grows with the normal stress"},
    {.key = "softening_drop", .members = {in(&JointProperties::softening_drop)}, .unit = "1", .range = {0, 100, true},
     .plausible = {5e-3, 2}, .example = "0.059266", .required = true, .when = {"friction_law", "softening"},
     .meaning = "total loss of the friction coefficient", .mistake = "was it given in degrees?"},
    {.key = "softening_slip_m", .members = {in(&JointProperties::softening_slip)}, .unit = "m", .range = positive,
     .plausible = {2e-4, 10}, .example = "0.35", .required = true, .when = {"friction_law", "softening"},
     .meaning = "plastic slip at which 63 % of softening_drop is lost"},
    {.key = "jrc", .members = {in(&BartonBandis::sample_jrc)}, .unit = "1", .range = {0, 40},
     .plausible = {.low = 1, .high = 20, .or_zero = true}, .example = "10", .required = true,
     .when = {"friction_law", "barton_bandis"},
     .meaning = "joint roughness coefficient JRC, of the sample if sample_length_m is stated, else of the blocks"},
    {.key = "jcs", .members = {in(&BartonBandis::sample_jcs)}, .unit = "Pa", .range = positive,
     .plausible = {1e6, 5e8}, .example = "30e6", .required = true, .when = {"friction_law", "barton_bandis"},
     .meaning = "compressive strength of the joint's walls JCS, of the sample if sample_length_m is stated, else of the blocks",
     .mistake = "was it given in MPa?"},
    {.key = "block_length_m", .members = {in(&BartonBandis::block_length)}, .unit = "m", .range = length_of_blocks,
     .plausible = {0.02, 100}, .example = "0.5", .no_default = true, .when = {"friction_law", "barton_bandis"},
     .meaning = "length Ln of the blocks along the joint; with sample_length_m L0 it corrects JRC to JRC (Ln/L0)^(-0.02 JRC), JCS to JCS "
         "(Ln/L0)^(-0.03 JRC); peak strength is at a plastic slip of Ln/500 (JRC/Ln)^0.33"},
    {.key = "sample_length_m", .members = {in(&BartonBandis::sample_length)}, .unit = "m", .range = length_of_blocks,
     .plausible = {0.02, 2}, .example = "0.1", .no_default = true, .when = {"friction_law", "barton_bandis"},
     .meaning = "length L0 of the sample that has jrc and jcs; without it both are those of the blocks, and are not corrected",
     .breaks = "values of a laboratory's sample without their correction are too strong for blocks"},
    {.key = "mobilisation", .members = {one_of(&BartonBandis::mobilisation,
         {{"none", Mobilisation::none}, {"table", Mobilisation::table}})},
     .example = "\"table\"", .when = {"friction_law", "barton_bandis"},
     .meaning = "part of i that acts against accumulated plastic slip; none: all of it at any slip, the envelope of limit equilibrium; "
         "table: that of Barton, Bandis and Bakhtar (1985), which rises to the peak and falls to friction_deg at 100 times its slip, and "
         "needs block_length_m",
     .breaks = "with the table a joint has no strength before any slip, and Newton's method is left to relaxation"},
    {.key = "dilation_share", .members = {in(&BartonBandis::dilation_share)}, .unit = "1", .range = {0, 1},
     .plausible = {.low = 0.1, .high = 1, .or_zero = true}, .example = "0.5", .when = {"friction_law", "barton_bandis"},
     .meaning = "dilation angle over the mobilised part of i, Barton and Choubey's 1/M; 0: the joint does not dilate"},
    {.key = "dilation_law", .members = {one_of(&JointLaws::dilation,
         {{"none", DilationLaw::none}, {"constant", DilationLaw::constant}, {"falling", DilationLaw::falling}})},
     .example = "\"constant\"",
     .meaning = "rise of a joint against its distance r of slip from where it was mated, not against its accumulated slip, so that slip "
         "back to there closes it; constant: tan(dilation_deg) r up to r = dilation_until_m; falling: tan(dilation_deg) dilation_decay_m "
         "(1 - exp(-r / dilation_decay_m)). It adds nothing to the strength at a normal stress: friction_deg is the total peak angle",
     .breaks = "stress grows in a block that is confined as it slips; a rise without limit lifts it for ever"},
    {.key = "dilation_deg", .members = {degrees(&JointProperties::dilation)}, .unit = "deg", .range = friction_range,
     .plausible = {.low = 0.5, .high = 30, .or_zero = true}, .example = "8", .required = true,
     .when = {"dilation_law", "constant|falling"},
     .meaning = "dilation angle at the beginning of slip, at most friction_deg or what softening leaves of it; in a search, and if a stage "
         "lowers friction_deg, at most the friction in force",
     .mistake = angle_mistake},
    {.key = "dilation_until_m", .members = {in(&JointProperties::dilation_until)}, .unit = "m", .range = positive,
     .plausible = {1e-4, 1}, .example = "0.005", .required = true, .when = {"dilation_law", "constant"},
     .meaning = "distance of slip from where the joint was mated beyond which it rises no more (3DEC's dilation-zero)",
     .mistake = "was it given in mm?"},
    {.key = "dilation_decay_m", .members = {in(&JointProperties::dilation_decay)}, .unit = "m", .range = positive,
     .plausible = {1e-4, 1}, .example = "0.002", .required = true, .when = {"dilation_law", "falling"},
     .meaning = "distance of slip at which the tangent of the dilation angle has fallen to 37 %",
     .mistake = "was it given in mm?"},
    {.key = "tension", .members = {in(&JointProperties::tension)}, .unit = "Pa", .range = not_negative,
     .plausible = {.low = 1e3, .high = 2e7, .or_zero = true}, .example = "0.076e6",
     .meaning = "tensile strength of bonds, until they are pulled beyond it or slip, under every cohesion_law; no factor of safety divides "
         "it; the overlap of zero stress is shifted to tension / normal_stiffness, permanently",
     .breaks = "acts where there are bonds: see bonds", .mistake = "was it given in MPa?"},
    {.key = "cohesion", .members = {in(&JointProperties::cohesion)}, .unit = "Pa", .range = not_negative,
     .plausible = {.low = 1e3, .high = 1e8, .or_zero = true}, .example = "0.787e6",
     .meaning = "cohesion c of bonds, until slip takes it as cohesion_law says or the joint opens, which takes all of it permanently",
     .breaks = "acts where there are bonds: see bonds", .mistake = "was it given in MPa?"},
    {.key = "cohesion_law", .members = {one_of(&JointProperties::cohesion_law,
         {{"plastic", CohesionLaw::plastic}, {"softening", CohesionLaw::softening}, {"brittle", CohesionLaw::brittle}})},
     .example = "\"plastic\"",
     .meaning = "cohesion c(β) against the plastic slip β since the bond was made, as long as the joint stays closed; plastic: c(β) = "
         "cohesion, limit equilibrium's assumption; softening: residual_cohesion + (cohesion - residual_cohesion) exp(-β / "
         "cohesion_slip_m); brittle: 0 after the first slip. A search for the factor of safety divides c(β)",
     .breaks = "plastic is unsafe if the joint is brittle, and a laboratory's residual cohesion is not it; brittle cohesion that several joints "
         "share makes a factor of safety depend on shear_stiffness / normal_stiffness"},
    {.key = "residual_cohesion", .members = {in(&JointProperties::residual_cohesion)}, .unit = "Pa", .range = not_negative,
     .plausible = {.low = 1e3, .high = 1e8, .or_zero = true}, .example = "0.05e6", .when = {"cohesion_law", "softening"},
     .meaning = "cohesion that any slip leaves, at most cohesion", .mistake = "was it given in MPa?"},
    {.key = "cohesion_slip_m", .members = {in(&JointProperties::cohesion_slip)}, .unit = "m", .range = not_negative,
     .plausible = {.low = 1e-5, .high = 1, .or_zero = true}, .example = "0.002", .required = true,
     .when = {"cohesion_law", "softening"},
     .meaning = "plastic slip at which 63 % of cohesion - residual_cohesion is lost; 0: lost at the first slip",
     .breaks = "cohesion that falls faster than the shear spring unloads causes snap-back, counted as snap_backs"},
    {.key = "bonds", .members = {one_of(&JointProperties::bonds,
         {{"as_sliced", BondsMade::as_sliced}, {"by_stage", BondsMade::by_stage}})},
     .example = "\"as_sliced\"",
     .meaning = "where tension and cohesion act; as_sliced: from the first stage on, once, between faces of one joint that are opposite each "
         "other when sliced, as each is first compressed (a contact that is lost, or formed later, has none), and where a stage bonds; "
         "by_stage: only where a stage bonds (stage.bond). Interfaces of linings are bonded when the lining is installed",
     .breaks = "weight that comes on suddenly, in a stage of kind run, may part a joint, which loses its cohesion permanently: settle first"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
