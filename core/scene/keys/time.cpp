// [time] and [equilibrium]
#include "core/base/settings.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable time_keys() {
  return {"time", {
    {.key = "fraction", .members = {in(&TimeSettings::fraction)}, .unit = "1", .range = {0, 1, true},
     .plausible = {1e-3, 1}, .example = "0.1",
     .meaning = "time step as a fraction of the stability limit; in stages of kind run 0.1 where it is not stated",
     .breaks = "above 0.2 (0.1 without damping) contacts that open and close gain energy"},
    {.key = "step_s", .members = {in(&TimeSettings::step)}, .unit = "s", .range = {0, 1e9, true},
     .plausible = {5e-7, 0.02}, .example = "1e-4",
     .meaning = "a fixed time step instead of the estimate",
     .breaks = "needed where no block ever touches; unstable above the limit",
     .mistake = "was it given in ms or µs?"},
  }};
}

KeyTable equilibrium_keys() {
  return {"equilibrium", {
    {.key = "unbalanced", .members = {in(&EquilibriumSettings::unbalanced)}, .unit = "1", .range = {0, 1, true},
     .plausible = {1e-9, 5e-3}, .example = "1e-7",
     .meaning = "at rest when for every free block unbalanced force and momentum stay below this fraction of the mean "
         "force of contacts and supports, or of relief loads (excavation_forces), applied forces or water where these are larger",
     .breaks = "too loose: a slow slide passes as rest"},
    {.key = "window", .members = {in(&EquilibriumSettings::window)}, .unit = "steps", .range = {1, 1e6},
     .plausible = {2, 1000}, .example = "50",
     .meaning = "number of steps in a row that must be at rest"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
