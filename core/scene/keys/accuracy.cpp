// [accuracy]
#include "core/base/accuracy.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable accuracy_keys() {
  return {"accuracy", {
    {.key = "level", .type = choice, .example = "\"balanced\"",
     .choices = {accuracy_levels.begin(), accuracy_levels.end()},
     .meaning = "sets tolerances, ramps, equilibrium criterion and time step that the scene does not state, to the values that the cases' "
         "studies found for an error of 5 %, 1 % or 0.1 % (critical angles above 15 deg)"},
    {.key = "budget", .type = boolean, .example = "true", .meaning = "after the result, further runs vary the numerical choices "
        "(stiffness, ramp, time step, equilibrium criterion, damping, points per face, …) one at a time: each value is reported with its "
        "sensitivities, and its error bar covers them, not only the search's bracket", .breaks = "costs several times the run itself"},
    {.key = "error_bar", .type = choice, .example = "\"stiffness\"", .choices = {"bracket", "stiffness"},
     .meaning = "bracket: the error bar of a search covers its bracket or its criterion of failure; stiffness: searches that the required "
         "strength judges, and in which blocks slide, are repeated once with joints four times as stiff and increments a fifth as long, "
         "and their bars cover the effect as well. A budget covers more, and takes its place",
     .breaks = "costs one more evaluation of the result"},
    {.key = "error", .type = text, .example = "\"1 %\"",
     .meaning = "largest error bar of the result of a search, relative (\"1 %\") or as an angle (\"0.1 deg\"): an error budget is made, "
         "and its largest contribution is refined until the error bar is small enough. Settings that the scene does not state are those of "
         "level = \"balanced\", from 5 % on those of \"fast\". budget = false switches it off",
     .breaks = "costs several runs; a contribution that cannot be refined is named, and ends the run as incomplete"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
