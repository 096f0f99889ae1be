// [damping], of a scene and of a stage.
#include "core/base/settings.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable damping_keys() {
  return {"damping", {
    {.key = "statics", .members = {one_of(&DampingSettings::statics,
         {{"adaptive", Statics::adaptive}, {"local", Statics::local}, {"newton", Statics::newton}})},
     .example = "\"local\"",
     .meaning = "how settle stages and the trials of a reduction come to rest; adaptive: dynamic relaxation, by the fewest "
         "steps, in which inertia, time and velocities are fictitious and the other keys of this table mean nothing, and "
         "which after 80 000 steps without rest has Newton's method try; local: the true motion, damped by the other "
         "keys, as in the thesis; newton: Newton's method on the joints, in increments, confirmed by relaxation, to "
         "which it leaves what it cannot decide",
     .breaks = "adaptive is for what is nearly at rest; where the way to rest is an event, as in a fall, choose local"},
    {.key = "increments", .members = {in(&DampingSettings::increments)}, .unit = "1", .range = {1, 1000},
     .example = "4",
     .meaning = "newton: increments in which a ramp of gravity, or a fall of friction in a search, is applied; slip within one increment "
         "is integrated in one step",
     .breaks = "the cost is proportional to their number"},
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
  }};
}
// clang-format on

}  // namespace voussoir::keys
