// Static solution method, and [damping], of a scene and of a stage.
#include "core/base/settings.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

namespace {

KeyMember method() {
  return one_of(&StaticsSettings::method,
                {{"adaptive", Statics::adaptive}, {"local", Statics::local}, {"newton", Statics::newton}});
}

KeyMember increments() {
  return in(&StaticsSettings::increments);
}

constexpr Range some{1, 1000};

}  // namespace

// clang-format off
std::vector<KeyRow> statics_rows() {
  return {
    {.key = "statics", .members = {method()}, .example = "\"local\"",
     .meaning = "static solution method of settle stages and of the trials of a reduction; adaptive: dynamic relaxation, by the "
         "fewest steps, in which inertia, time and velocities are fictitious and [damping] means nothing, and which after "
         "80 000 steps without equilibrium has Newton's method try; local: the true motion under [damping], as in the "
         "thesis; newton: implicit static solver (Newton-Raphson on the joints), in increments, confirmed by relaxation, "
         "to which it leaves bodies that it cannot decide",
     .breaks = "adaptive is for bodies that are nearly in equilibrium; if the path to equilibrium is an event, as in a fall, "
         "choose local"},
    {.key = "static_increments", .members = {increments()}, .unit = "1", .range = some, .example = "4",
     .meaning = "newton: increments in which a ramp of gravity, or a fall of friction in a search, is applied; a joint that "
         "slips within one slips along its chord",
     .breaks = "the cost grows with them"},
    {.key = "static_slip", .members = {in(&StaticsSettings::slip)}, .unit = "1", .range = {1e-3, 10},
     .plausible = {0.05, 2}, .example = "0.1",
     .meaning = "newton, searches that the required strength judges: slip of a body, in elastic displacements of its joints, "
         "after which a trial's reference state is updated; --budget takes a fifth of it",
     .breaks = "large: shear locked in by settling dies away too slowly along the chord, and the critical angle is too high"},
  };
}

KeyTable stage_statics_keys() {
  return {"stage", {
    {.key = "statics", .members = {method()}, .example = "\"newton\"", .no_default = true,
     .meaning = "replaces the scene's static solution method within this stage"},
    {.key = "static_increments", .members = {increments()}, .unit = "1", .range = some, .example = "4", .no_default = true,
     .meaning = "replaces the scene's within this stage"},
  }};
}

KeyTable damping_keys() {
  return {"damping", {
    {.key = "local", .members = {in(&DampingSettings::local)}, .unit = "1", .range = fraction,
     .plausible = {.low = 0.01, .high = 0.95, .or_zero = true}, .example = "0",
     .meaning = "fraction by which each force component is reduced when it drives the motion (Cundall); a stage that does not state it "
         "takes the scene's; 0 in stages of kind run if neither states it",
     .repair = "0 for dynamics, 0.7 to reach equilibrium",
     .breaks = "at 0 the model does not come to equilibrium by itself; above 0.9 failure is delayed"},
    {.key = "viscous_ratio", .members = {in(&DampingSettings::viscous_ratio)}, .unit = "1", .range = {0, 10},
     .plausible = {.low = 1e-3, .high = 1, .or_zero = true}, .example = "0.1",
     .meaning = "normal dashpot of every contact, as a fraction of critical damping",
     .breaks = "large values shorten the time step"},
    {.key = "joint_ratio", .members = {in(&DampingSettings::joint_ratio)}, .unit = "1", .range = {0, 1},
     .plausible = {.low = 1e-3, .high = 0.2, .or_zero = true}, .example = "0.02",
     .meaning = "implicit time steps: dashpots in proportion to the joints' normal and shear stiffness, as a fraction of critical damping at "
         "joint_frequency_hz; half of it at half the frequency", .mistake = "was it given in percent?"},
    {.key = "joint_frequency_hz", .members = {in(&DampingSettings::joint_frequency)}, .unit = "Hz", .range = {0, 1e6, true},
     .plausible = {0.1, 1e3}, .example = "5", .meaning = "the frequency at which joint_ratio is stated"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
