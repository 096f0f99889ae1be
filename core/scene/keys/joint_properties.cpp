// [[joint_properties]]: the parameters of the laws in core/joint_laws.
#include "core/joint_laws/joint_properties.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable joint_property_keys() {
  return {"joint_properties", {
    {.key = "name", .members = {in(&JointProperties::name, name)}, .example = "\"rock\"", .required = true,
     .meaning = "unique among the joint properties; `default`, else the first, serves faces that no joint made"},
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
     .meaning = "friction angle", .repair = "give the angle, not its tangent, below 90 degrees",
     .mistake = friction_mistake},
    {.key = "constant_stiffness", .members = {in(&JointProperties::constant_stiffness)}, .example = "true",
     .meaning = "the stiffness is in N/m whatever the contact area, which then is never computed"},
    {.key = "measured", .type = boolean, .example = "true",
     .meaning = "the stiffness is the rock's: an error budget (accuracy.budget) then tells by how much it moves a value, "
         "but does not take that for an error"},
    {.key = "sub_contacts", .members = {in(&JointProperties::sub_contacts)}, .range = {1, 64}, .example = "4",
     .meaning = "points that carry a joint face, along each of its directions (4: 4 in 2-D, 4 x 4 in 3-D); 1: the "
         "contact point alone",
     .breaks = "with one point a face resists neither spin nor, as a face does, rocking; each more costs time"},
    {.key = "normal_law", .members = {one_of(&JointLaws::normal,
         {{"constant", StiffnessLaw::constant}, {"linear", StiffnessLaw::linear}, {"power", StiffnessLaw::power}})},
     .example = "\"linear\"",
     .meaning = "normal stiffness kn against normal stress σ; constant: kn = normal_stiffness; linear: normal_stiffness + "
         "normal_growth σ, so that σ = normal_stiffness / normal_growth (exp(normal_growth u) - 1) at overlap u; power: "
         "normal_stiffness (σ / 1 Pa)^normal_exponent, the stiffness then being that at 1 Pa",
     .breaks = "stiffness grows with load, and the time step shrinks with its square root"},
    {.key = "normal_growth", .members = {in(&JointProperties::normal_growth)}, .unit = "1/m", .range = positive,
     .plausible = {100, 1e6}, .example = "7.4e4", .required = true, .when = {"normal_law", "linear"},
     .meaning = "gain of normal stiffness per normal stress"},
    {.key = "normal_exponent", .members = {in(&JointProperties::normal_exponent)}, .unit = "1",
     .range = {0, 1, true, true}, .plausible = {0.1, 0.95}, .example = "0.75", .required = true,
     .when = {"normal_law", "power"},
     .meaning = "power of the normal stress", .repair = "at 1 and above no stress ever builds up from none"},
    {.key = "shear_law", .members = {one_of(&JointLaws::shear,
         {{"constant", StiffnessLaw::constant}, {"linear", StiffnessLaw::linear}, {"power", StiffnessLaw::power}})},
     .example = "\"linear\"",
     .meaning = "shear stiffness ks against normal stress σ; constant: ks = shear_stiffness; linear: shear_stiffness + "
         "shear_growth σ; power: shear_stiffness (σ / 1 Pa)^shear_exponent",
     .breaks = "makes or loses energy where the stress changes under shear: `stiffening` in the energy table"},
    {.key = "shear_growth", .members = {in(&JointProperties::shear_growth)}, .unit = "1/m", .range = positive,
     .plausible = {100, 1e6}, .example = "9.7e4", .required = true, .when = {"shear_law", "linear"},
     .meaning = "gain of shear stiffness per normal stress"},
    {.key = "shear_exponent", .members = {in(&JointProperties::shear_exponent)}, .unit = "1", .range = {0, 2, true},
     .plausible = {0.1, 1.5}, .example = "0.7", .required = true, .when = {"shear_law", "power"},
     .meaning = "power of the normal stress"},
    {.key = "friction_law", .members = {one_of(&JointLaws::friction,
         {{"constant", FrictionLaw::constant}, {"hardening", FrictionLaw::hardening},
          {"softening", FrictionLaw::softening}})},
     .example = "\"softening\"",
     .meaning = "friction coefficient μ against accumulated plastic slip β; constant: tan(friction_deg); hardening: "
         "tan(friction_deg) (1 - exp(-β / up)), up = hardening_slip_m (σ / 1 Pa)^hardening_exponent; softening: "
         "tan(friction_deg) - softening_drop (1 - exp(-β / softening_slip_m)); strength reduction changes friction_deg",
     .breaks = "friction that falls faster than the shear spring unloads snaps back: counted as snap_backs"},
    {.key = "hardening_slip_m", .members = {in(&JointProperties::hardening_slip)}, .unit = "m", .range = positive,
     .plausible = {1e-8, 1e-4}, .example = "2e-6", .required = true, .when = {"friction_law", "hardening"},
     .meaning = "plastic slip in which friction gains 63 % of its last value, at a normal stress of 1 Pa"},
    {.key = "hardening_exponent", .members = {in(&JointProperties::hardening_exponent)}, .unit = "1", .range = {0, 2},
     .plausible = {.low = 0.01, .high = 1, .or_zero = true}, .example = "0.213",
     .when = {"friction_law", "hardening"},
     .meaning = "power of the normal stress with which that slip grows"},
    {.key = "softening_drop", .members = {in(&JointProperties::softening_drop)}, .unit = "1", .range = {0, 100, true},
     .plausible = {5e-3, 2}, .example = "0.059266", .required = true, .when = {"friction_law", "softening"},
     .meaning = "friction coefficient lost in the end", .mistake = "was it given in degrees?"},
    {.key = "softening_slip_m", .members = {in(&JointProperties::softening_slip)}, .unit = "m", .range = positive,
     .plausible = {2e-4, 10}, .example = "0.35", .required = true, .when = {"friction_law", "softening"},
     .meaning = "plastic slip in which 63 % of it is lost"},
    {.key = "tension", .members = {in(&JointProperties::tension)}, .unit = "Pa", .range = not_negative,
     .plausible = {.low = 1e3, .high = 2e7, .or_zero = true}, .example = "0.076e6",
     .meaning = "tensile strength of bonded joints, which lasts until the bond breaks by tension or slip; the overlap at "
         "which there is no stress moves to tension / normal_stiffness, and stays there",
     .breaks = "counts only where a stage has made bonds (stage.bond)", .mistake = "was it given in MPa?"},
    {.key = "cohesion", .members = {in(&JointProperties::cohesion)}, .unit = "Pa", .range = not_negative,
     .plausible = {.low = 1e3, .high = 1e8, .or_zero = true}, .example = "0.787e6",
     .meaning = "cohesion of bonded joints, which lasts until the bond breaks by tension or slip",
     .breaks = "counts only where a stage has made bonds (stage.bond)", .mistake = "was it given in MPa?"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
