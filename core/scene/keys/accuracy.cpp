// [accuracy]
#include "core/base/accuracy.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable accuracy_keys() {
  return {"accuracy", {
    {.key = "level", .type = choice, .example = "\"balanced\"",
     .choices = {accuracy_levels.begin(), accuracy_levels.end()},
     .meaning = "sets what the scene leaves out, tolerances, ramps, rest and "
         "time step, as the cases' studies found it for an error of 5 %, 1 % or 0.1 %, of critical angles from 15 deg on"},
    {.key = "budget", .type = boolean, .example = "true", .meaning = "after the answer, runs vary what was chosen, stiffness, ramp, "
         "time step, rest, damping, points a face and the like, one at a time: every value then says what moves it, and "
         "its error bar covers that, not the search's bracket alone", .breaks = "costs several times the answer"},
    {.key = "error", .type = text, .example = "\"1 %\"",
     .meaning = "how wide the error bar of what a search finds may be, of it (\"1 %\") or of an angle (\"0.1 deg\"): with a budget, "
         "and what matters most in it made finer until the bar is as asked. Sets what the scene leaves out as level = \"balanced\" "
         "does, from 5 % on as \"fast\". budget = false switches it off",
     .breaks = "costs several answers; what cannot be refined is named, and ends the run as incomplete"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
