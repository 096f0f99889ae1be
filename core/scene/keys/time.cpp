// [time] and [equilibrium]
#include "core/base/settings.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable time_keys() {
  return {"time", {
    {.key = "fraction", .members = {in(&TimeSettings::fraction)}, .unit = "1", .range = {0, 1, true},
     .plausible = {1e-3, 1}, .example = "0.1",
     .meaning = "time step as a fraction of the stability limit; in stages of kind run 0.1 if it is not stated",
     .breaks = "above 0.2 (0.1 without damping) contacts that open and close gain energy"},
    {.key = "step_s", .members = {in(&TimeSettings::step)}, .unit = "s", .range = {0, 1e9, true},
     .plausible = {5e-7, 0.02}, .example = "1e-4",
     .meaning = "a fixed time step instead of the estimate",
     .breaks = "required if no blocks ever touch; unstable above the stability limit",
     .mistake = "was it given in ms or µs?"},
    {.key = "integration", .members = {one_of(&TimeSettings::integration,
         {{"explicit", Integration::explicit_steps}, {"implicit", Integration::implicit_steps}})},
     .example = "\"implicit\"",
     .meaning = "true motion, in stages of kind run. explicit: leapfrog, whose step follows the stiffest joint; implicit: the "
         "energy-momentum midpoint rule with dissipation of what a step does not resolve, whose step follows the motion (error_m, or step_s)"},
    {.key = "error_m", .members = {in(&TimeSettings::error)}, .unit = "m", .range = {0, 1e3},
     .plausible = {.low = 1e-7, .high = 1e-3, .or_zero = true}, .example = "1e-5",
     .meaning = "integration = \"implicit\": a step moves no block by more than this otherwise than two halves of it would; 0: 1e-5 of the "
         "median inscribed radius of the free blocks",
     .breaks = "too large: impacts and onsets of slip are not resolved", .mistake = "was it given in mm?"},
    {.key = "half_error", .members = {in(&TimeSettings::half_error)}, .example = "true",
     .meaning = "integration = \"implicit\": each such stage is run once more with half of error_m, and the change of its largest "
         "displacement is reported",
     .breaks = "the stage takes more than twice the time"},
  }};
}

KeyTable equilibrium_keys() {
  return {"equilibrium", {
    {.key = "unbalanced", .members = {in(&EquilibriumSettings::unbalanced)}, .unit = "1", .range = {0, 1, true},
     .plausible = {1e-9, 5e-3}, .example = "1e-7",
     .meaning = "equilibrium: for every free block the unbalanced force and moment stay below this fraction of the mean "
         "force of contacts and supports, or of relief loads (excavation_forces), applied forces or water where these are larger",
     .breaks = "too large: slow sliding is taken for equilibrium"},
    {.key = "window", .members = {in(&EquilibriumSettings::window)}, .unit = "steps", .range = {1, 1e6},
     .plausible = {2, 1000}, .example = "50",
     .meaning = "number of consecutive steps that must be in equilibrium"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
