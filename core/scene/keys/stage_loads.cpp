// [[stage]]: the loads that it brings.
#include "core/scene/keys/tables.hpp"
#include "core/settings.hpp"

namespace voussoir::keys {

// clang-format off
std::vector<KeyTable> stage_load_keys() {
  return {{"stage", {
    {.key = "boundary", .type = tables, .holds = {"label", "boundary", "selector"},
     .meaning = "stress on the outer faces of blocks, those that no joint made, from this stage on; it replaces what the "
         "blocks bore before"},
    {.key = "force", .type = tables, .holds = {"force", "factor", "selector"},
     .meaning = "a force on blocks from this stage on. Its factor of time, in stages of kind run only, runs while the stage "
         "lasts; afterwards the force stays as it ended"},
  }},
  {"boundary", {
    {.key = "stress", .members = {in(&BoundaryPlan::stress, numbers)}, .unit = "Pa", .range = sane,
     .example = "[50e3, 50e3, 0, 0, 0, 0]", .required = true,
     .meaning = "compression positive, world axes: xx, yy, zz, yz, zx, xy; in 2-D xx, yy, xy. The force on each face keeps "
         "size and direction while the block moves",
     .breaks = "needs blocks or fixed rock to push against"},
  }},
  {"force", {
    {.key = "name", .members = {in(&ForcePlan::name, name)}, .example = "\"crane\"", .required = true,
     .meaning = "a later stage that states a force of this name replaces it"},
    {.key = "force", .members = {in(&ForcePlan::force)}, .unit = "N", .range = sane,
     .plausible = {.low = 1, .high = 1e8, .or_zero = true}, .example = "[0, 0, -5e3]", .required = true,
     .meaning = "on each of the blocks, world axes; in 2-D N per metre of thickness. All zero: no force of this name acts "
         "any more", .mistake = "was it given in kN or MN?"},
    {.key = "point", .members = {in(&ForcePlan::point)}, .unit = "m", .range = sane, .example = "[1, 0, 2]",
     .meaning = "where it acts, in or on its block, as the scene has it before anything moves; the point then moves with "
         "the block. Without it the force acts at the centroid of each block"},
    {.key = "turns_with_body", .members = {in(&ForcePlan::turns_with_body)}, .example = "true",
     .meaning = "true: the force turns with the block, like a jack on its face; false: it keeps its direction in space, "
         "like a weight"},
  }},
  // of time, of prescribed motions too
  {"factor", {
    {.key = "times_s", .members = {in(&TimeFactor::times, numbers)}, .unit = "s", .range = {0, 1e9}, .example = "[0, 0.1, 1]",
     .meaning = "times since the stage began, ascending, at which `factors` are given"},
    {.key = "factors", .members = {in(&TimeFactor::factors, numbers)}, .range = sane, .example = "[0, 1, 1]",
     .meaning = "what the velocities, or the force, are multiplied by at `times_s`: linear in between, constant before and after"},
    {.key = "frequency_hz", .members = {in(&TimeFactor::frequency)}, .unit = "Hz", .range = {0, 1e9, true}, .plausible = {0.01, 500},
     .example = "2", .no_default = true,
     .meaning = "velocities, or the force, are multiplied by sin(2π frequency_hz t + phase_deg), t since the stage began; times the "
         "factors where both are given",
     .breaks = "needs some twenty steps a period", .mistake = "was the period given?"},
    {.key = "phase_deg", .members = {degrees(&TimeFactor::phase)}, .unit = "deg", .range = {-360, 360}, .plausible = plausible_direction,
     .example = "90", .meaning = "of that sine: 90 begins at its full value", .mistake = angle_mistake},
  }}};
}
// clang-format on

}  // namespace voussoir::keys
