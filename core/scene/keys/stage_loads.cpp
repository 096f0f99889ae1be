// [[stage]]: the loads that it applies.
#include "core/base/settings.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
std::vector<KeyTable> stage_load_keys() {
  return {{"stage", {
    {.key = "boundary", .type = tables, .holds = {"label", "boundary", "selector"},
     .meaning = "on the outer faces of blocks (those that no joint made) from this stage on: a stress, which replaces earlier boundary "
         "stress on these blocks, or a side that waves leave, by quiet or free_field"},
    {.key = "force", .type = tables, .holds = {"force", "factor", "selector"},
     .meaning = "a force on blocks from this stage on. A time factor, in stages of kind run only, acts during the stage; afterwards the "
         "force keeps its last value"},
  }},
  {"boundary", {
    {.key = "stress", .members = {in(&BoundaryPlan::stress, numbers)}, .unit = "Pa", .range = sane,
     .example = "[50e3, 50e3, 0, 0, 0, 0]",
     .meaning = "compression positive, world axes: xx, yy, zz, yz, zx, xy; in 2-D xx, yy, xy. The force on each face keeps its magnitude "
         "and direction while the block moves",
     .breaks = "needs blocks or fixed rock to push against"},
    {.key = "in_situ", .type = table, .holds = {"in_situ"},
     .meaning = "stress due to the rock's own weight, which grows with depth; `stress`, if stated too, is added"},
    {.key = "quiet", .type = table, .holds = {"medium", "quiet", "motion", "factor"},
     .meaning = "instead of stress: waves leave through the side, which must be named by `side` alone, and one may enter at the bottom. "
         "Blocks that were fixed there are released, their reactions stay as constant forces; stages from here on must be of kind run",
     .breaks = "the side has no spring: a load that changes later makes it creep"},
    {.key = "free_field", .type = table, .holds = {"medium"},
     .meaning = "instead of stress: as quiet, and beyond the side a column of its blocks moves as if the model were not there; of a side, "
         "not bottom or top, whose blocks repeat"},
  }},
  {"medium", {
    {.key = "normal_impedance", .members = {in(&MediumPlan::normal_impedance)}, .unit = "Pa s/m", .range = positive,
     .plausible = {1e5, 1e8}, .example = "5e6", .no_default = true,
     .meaning = "density times the speed of compression waves beyond the side; without it of the side's blocks: √(ρ kn a) of joints "
         "parallel to it at the spacing a", .mistake = "was it given in MPa s/m?"},
    {.key = "shear_impedance", .members = {in(&MediumPlan::shear_impedance)}, .unit = "Pa s/m", .range = positive,
     .plausible = {1e5, 1e8}, .example = "3e6", .no_default = true,
     .meaning = "density times the speed of shear waves; without it of the side's blocks: √(ρ ks a/2) of a square grid", .mistake = "was it given "
         "in MPa s/m?"},
    {.key = "normal_stiffness", .members = {in(&MediumPlan::normal_stiffness)}, .unit = "Pa/m", .range = positive,
     .plausible = {1e7, 2e11}, .example = "1e10", .no_default = true,
     .meaning = "of the joints along the side, half of one of which is before the dashpot; without it that of the joints of its blocks",
     .mistake = "was it given in GPa/m or MPa/m?"},
    {.key = "shear_stiffness", .members = {in(&MediumPlan::shear_stiffness)}, .unit = "Pa/m", .range = positive,
     .plausible = {1e7, 2e11}, .example = "5e9", .no_default = true,
     .meaning = "the same along the joint", .mistake = "was it given in GPa/m or MPa/m?"},
  }},
  {"quiet", {
    {.key = "input", .type = choice, .example = "\"outcrop\"", .choices = {"upgoing", "outcrop", "within"},
     .meaning = "what the motion that enters is, which must be stated with it. upgoing: the wave itself; outcrop: the motion of a free surface, "
         "twice the wave; within: recorded in the rock, refused, because it contains the wave that comes back"},
    {.key = "factor", .type = tables, .holds = {"record"},
     .meaning = "earthquake records that enter, instead of velocities, as factor of [[stage.move]]"},
  }},
  {"in_situ", {
    {.key = "surface", .members = {in(&InSituPlan::surface)}, .unit = "m", .range = sane, .example = "25",
     .required = true, .meaning = "elevation of the ground surface, above which there is no stress"},
    {.key = "k0", .members = {in(&InSituPlan::k0)}, .unit = "1", .range = {0, 1e3},
     .plausible = {.low = 0.1, .high = 10, .or_zero = true}, .example = "0.5", .required = true,
     .meaning = "horizontal over vertical stress. A joint of dip a slips while the stress is applied unless "
         "tan φ ≥ |1 - k0| sin a cos a / (cos² a + k0 sin² a): state a friction angle for this stage", .mistake = "was it given in "
         "percent?"},
    {.key = "k0_y", .members = {in(&InSituPlan::k0_y)}, .unit = "1", .range = {0, 1e3},
     .plausible = {.low = 0.1, .high = 10, .or_zero = true}, .example = "0.8", .no_default = true,
     .meaning = "in 3-D the ratio along y, if it differs from that along x", .mistake = "was it given in percent?"},
    {.key = "unit_weight", .members = {in(&InSituPlan::unit_weight)}, .unit = "N/m³", .range = positive,
     .plausible = {1e4, 5e4}, .example = "26e3", .no_default = true,
     .meaning = "unit weight of the rock; without it the scene's density times gravity",
     .mistake = "was it given in kN/m³, or as a density?"},
  }},
  {"force", {
    {.key = "name", .members = {in(&ForcePlan::name, name)}, .example = "\"crane\"", .required = true,
     .meaning = "a later stage that states a force of this name replaces it"},
    {.key = "force", .members = {in(&ForcePlan::force)}, .unit = "N", .range = sane,
     .plausible = {.low = 1, .high = 1e8, .or_zero = true}, .example = "[0, 0, -5e3]", .required = true,
     .meaning = "force on each of the blocks, world axes; in 2-D N per metre of thickness. All zero: the force of this name "
         "ends", .mistake = "was it given in kN or MN?"},
    {.key = "point", .members = {in(&ForcePlan::point)}, .unit = "m", .range = sane, .example = "[1, 0, 2]",
     .meaning = "point at which it acts, in or on its block, in the initial position; it moves with the block. Without it the force acts "
         "at the centroid of each block"},
    {.key = "turns_with_body", .members = {in(&ForcePlan::turns_with_body)}, .example = "true",
     .meaning = "true: the force turns with the block, like a jack on its face; false: it keeps its direction in space, "
         "like a weight"},
  }},
  // factors of time, of prescribed motions too
  {"factor", {
    {.key = "times_s", .members = {in(&TimeFactor::times, numbers)}, .unit = "s", .range = {0, 1e9}, .example = "[0, 0.1, 1]",
     .meaning = "times since the stage began, ascending, at which `factors` are given"},
    {.key = "factors", .members = {in(&TimeFactor::factors, numbers)}, .range = sane, .example = "[0, 1, 1]",
     .meaning = "factors of the velocities, or of the force, at `times_s`: linear in between, constant before and after"},
    {.key = "frequency_hz", .members = {in(&TimeFactor::frequency)}, .unit = "Hz", .range = {0, 1e9, true}, .plausible = {0.01, 500},
     .example = "2", .no_default = true,
     .meaning = "velocities, or the force, are multiplied by sin(2π frequency_hz t + phase_deg), t since the stage began; and by the "
         "factors if both are given",
     .breaks = "needs about twenty time steps per period", .mistake = "was the period given?"},
    {.key = "phase_deg", .members = {degrees(&TimeFactor::phase)}, .unit = "deg", .range = {-360, 360}, .plausible = plausible_direction,
     .example = "90", .meaning = "phase of that sine; 90: it begins at its maximum", .mistake = angle_mistake},
  }}};
}
// clang-format on

}  // namespace voussoir::keys
