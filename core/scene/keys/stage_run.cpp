// [[stage]]: keys of the kinds settle and run.
#include "core/base/settings.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable stage_run_keys() {
  return {"stage", {
    {.key = "gravity_ramp_s", .members = {in(&GravityPlan::ramp)}, .unit = "s", .range = {0, 1e9},
     .plausible = plausible_ramp, .example = "0.5", .when = {"kind", "settle|run"},
     .meaning = "gravity grows from zero to its full value within this time, at most duration_s",
     .breaks = "0 loads the joints dynamically, without damping to twice the weight",
     .mistake = "was it given in ms?"},
    {.key = "gravity_to", .members = {in(&GravityPlan::to)}, .unit = "1", .range = {0, 1e6},
     .plausible = plausible_factor, .example = "2", .when = {"kind", "settle|run"},
     .meaning = "multiple of the scene's gravity that acts at the end of the ramp, which then starts from the previous stage's value, or "
         "from the start of the stage if there is no ramp. Without it a ramp is from 0 to 1, and a stage without ramp does not change "
         "gravity"},
    {.key = "water", .type = tables, .when = {"kind", "settle|run"}, .holds = {"water_change", "water_surface"},
     .meaning = "waters that rise, fall or change within the stage, and then keep their last value"},
    {.key = "excavation_forces", .type = table, .when = {"kind", "settle|run"}, .holds = {"excavation_forces"},
     .meaning = "the forces by which excavated rock supported the rest, in this stage and in stages before that state "
         "them, are not removed at once: they stay as loads and fall within the stage"},
    {.key = "time_limit_s", .members = {in(&SettlePlan::time_limit)}, .unit = "s", .range = {0, 1e9, true},
     .plausible = {0.1, 1e4}, .example = "60", .when = {"kind", "settle"},
     .meaning = "the stage gives up if equilibrium is not reached by then", .mistake = "was it given in ms?"},
    {.key = "step_limit", .members = {in(&SettlePlan::step_limit), in(&ReducePlan::step_limit)}, .unit = "steps",
     .range = count, .plausible = {1e4, 1e8}, .example = "2000000", .when = {"kind", "settle|reduce"},
     .meaning = "the stage (reduce: a trial) gives up if equilibrium is not reached in this number of steps"},
    {.key = "duration_s", .members = {in(&RunPlan::duration)}, .unit = "s", .range = {0, 1e9, true},
     .plausible = {1e-3, 1000}, .example = "2", .required = true, .when = {"kind", "run"},
     .meaning = "simulated time", .mistake = "was it given in ms?"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
