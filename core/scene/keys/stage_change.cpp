// [[stage]]: what changes when it begins.
#include "core/base/settings.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable stage_change_keys() {
  return {"stage", {
    {.key = "damping", .type = table, .holds = {"damping"},
     .meaning = "replaces the scene's damping within this stage"},
    {.key = "fix", .type = tables, .holds = {"label", "selector"},
     .meaning = "blocks fixed before the stage begins"},
    {.key = "release", .type = tables, .holds = {"label", "selector"},
     .meaning = "blocks set free before the stage begins"},
    {.key = "remove", .type = tables, .holds = {"label", "selector"},
     .meaning = "blocks excavated before the stage begins"},
    {.key = "excavate", .members = {in(&Change::excavate)}, .example = "[\"tunnel\"]",
     .meaning = "names of [[excavations]] that are taken out before the stage begins, and not before the first stage: until "
         "then their blocks are whole. A block that loses a part keeps moving and keeps the forces of its other joints; what "
         "is left of it in smaller pieces than slicing.smallest_inscribed_radius goes, too"},
    {.key = "install", .members = {in(&Change::install)}, .example = "[\"roof\"]",
     .meaning = "names of [[bolts]] and [[linings]] that are put in as the blocks stand before the stage begins, after what it takes out"},
    {.key = "move", .type = tables, .when = {"kind", "run"},
     .holds = {"label", "motion", "move", "factor", "selector"},
     .meaning = "blocks whose motion is prescribed while the stage lasts, whatever the load on them; their other "
         "freedoms stay as they are, those of a fixed block are held. Afterwards a fixed block stands, a free one keeps moving"},
    {.key = "friction_deg", .members = {degrees(&Change::friction)}, .unit = "deg", .range = friction_range,
     .plausible = plausible_friction, .example = "30",
     .meaning = "friction angle of every joint from this stage on, whatever a search left it at", .mistake = friction_mistake},
    {.key = "friction", .type = tables, .holds = {"friction"},
     .meaning = "friction angle of joint properties by name from this stage on, those that friction_deg does not mean"},
    {.key = "bond", .members = {in(&Change::bond)}, .example = "true",
     .meaning = "bonds joints that are closed and state tension or cohesion: where they press, or first do before they "
         "part by a thousandth of the smallest inscribed radius; a bond breaks once, by tension or slip"},
    {.key = "zero_slip", .members = {in(&Change::zero_slip)}, .example = "true",
     .meaning = "the plastic slip of every joint is set to zero before the stage begins, so that friction that hardens or "
         "softens does so from here on, as after the generation of stresses"},
  }};
}

KeyTable excavation_forces_keys() {
  return {"excavation_forces", {
    {.key = "remaining", .members = {in(&ExcavationForcesPlan::remaining)}, .unit = "1", .range = {0, 1},
     .plausible = {.low = 0.01, .high = 1, .or_zero = true}, .example = "0.4", .required = true,
     .meaning = "fraction of these forces that still acts when the stage has ended, and until a later stage states a smaller "
         "one; at most the fraction before, 0: none acts; the convergence-confinement method's relaxation is "
         "λ = 1 - remaining", .mistake = "was it given in percent?"},
    {.key = "duration_s", .members = {in(&ExcavationForcesPlan::duration)}, .unit = "s", .range = {0, 1e9, true},
     .plausible = plausible_ramp, .example = "1", .no_default = true,
     .meaning = "time within which they fall to it, linearly, from the begin of the stage on. In a stage of kind run at "
         "most its duration_s, which it is where it is not stated; in one of kind settle it must be stated and is a ramp, "
         "as gravity_ramp_s", .mistake = "was it given in ms?"},
  }};
}

KeyTable stage_friction_keys() {
  return {"friction", {
    {.key = "name", .members = {in(&FrictionPlan::properties, name)}, .example = "\"rock\"", .required = true,
     .meaning = "of the joint_properties"},
    {.key = "friction_deg", .members = {degrees(&FrictionPlan::friction)}, .unit = "deg", .range = friction_range,
     .plausible = plausible_friction, .example = "30", .required = true,
     .meaning = "their friction angle from this stage on", .mistake = friction_mistake},
  }};
}
// clang-format on

}  // namespace voussoir::keys
