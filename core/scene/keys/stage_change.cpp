// [[stage]]: the changes at its start.
#include "core/base/settings.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable stage_change_keys() {
  return {"stage", {
    {.key = "damping", .type = table, .holds = {"damping"},
     .meaning = "replaces the scene's damping within this stage"},
    {.key = "time", .type = table, .when = {"kind", "run"}, .holds = {"time"},
     .meaning = "replaces the scene's time steps within this stage: explicit or implicit ones, and how long they are"},
    {.key = "fix", .type = tables, .holds = {"label", "selector"},
     .meaning = "blocks fixed before the stage begins"},
    {.key = "release", .type = tables, .holds = {"label", "selector"},
     .meaning = "blocks set free before the stage begins"},
    {.key = "remove", .type = tables, .holds = {"label", "selector"},
     .meaning = "blocks excavated before the stage begins"},
    {.key = "excavate", .members = {in(&Change::excavate)}, .example = "[\"tunnel\"]",
     .meaning = "names of [[excavations]] that are excavated before the stage begins instead of before the first stage: until then their "
         "blocks are not cut apart. A block that loses a part keeps its motion and the forces of its other joints; remaining pieces "
         "smaller than slicing.smallest_inscribed_radius are excavated too"},
    {.key = "install", .members = {in(&Change::install)}, .example = "[\"roof\"]",
     .meaning = "names of [[bolts]] and [[linings]] that are installed before the stage begins, after its excavations, in the current "
         "position of the blocks"},
    {.key = "move", .type = tables, .when = {"kind", "run"},
     .holds = {"label", "motion", "move", "factor", "selector"},
     .meaning = "blocks whose motion is prescribed while the stage lasts, whatever the load on them; their other degrees of freedom are "
         "unchanged, those of a fixed block stay fixed. Afterwards a fixed block stops, a free one keeps its velocity"},
    {.key = "friction_deg", .members = {degrees(&Change::friction)}, .unit = "deg", .range = friction_range,
     .plausible = plausible_friction, .example = "30",
     .meaning = "friction angle of every joint from this stage on, whatever an earlier search has made it; joints of Barton and Bandis' law "
         "have Coulomb's with it, until a stage states friction_as_stated", .mistake = friction_mistake},
    {.key = "friction_as_stated", .members = {in(&Change::friction_as_stated)}, .example = "true",
     .meaning = "every joint has from this stage on the friction of its joint_properties again, and its own law: Barton and Bandis', which "
         "an earlier friction_deg has replaced"},
    {.key = "friction", .type = tables, .holds = {"friction"},
     .meaning = "friction angle of single joint properties, by name, from this stage on; it takes precedence over friction_deg and friction_as_stated"},
    {.key = "bond", .members = {in(&Change::bond)}, .example = "true",
     .meaning = "bonds closed joints that state tension or cohesion, at contacts that are compressed, or are so before they open by a "
         "thousandth of the smallest inscribed radius; for joints whose properties have bonds by_stage, and those that were made or parted later"},
    {.key = "zero_slip", .members = {in(&Change::zero_slip)}, .example = "true",
     .meaning = "the plastic slip of every joint is set to zero before the stage begins, so that hardening or softening of friction starts "
         "there, as after the generation of in-situ stress"},
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
     .meaning = "name of the joint_properties"},
    {.key = "friction_deg", .members = {degrees(&FrictionPlan::friction)}, .unit = "deg", .range = friction_range,
     .plausible = plausible_friction, .example = "30", .no_default = true,
     .meaning = "their friction angle from this stage on; needed, unless as_stated", .mistake = friction_mistake},
    {.key = "as_stated", .members = {in(&FrictionPlan::as_stated)}, .example = "true",
     .meaning = "they have the friction and the law of their joint_properties again, instead of an angle"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
