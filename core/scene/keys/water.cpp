// [[water]], and how it changes in [[stage.water]].
#include "core/scene/keys/tables.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {

// clang-format off
std::vector<KeyTable> water_keys() {
  return {{"water", {
    {.key = "name", .members = {in(&WaterSpec::name, name)}, .example = "\"lake\"", .required = true,
     .meaning = "unique among the waters"},
    {.key = "unit_weight", .members = {in(&WaterSpec::unit_weight)}, .unit = "N/m³", .range = positive,
     .plausible = {9000, 13000}, .example = "10000",
     .meaning = "weight of a unit of volume; water is vertical whatever the direction of gravity, and grows with its factor",
     .mistake = "was it given in kN/m³, or as a density?"},
    {.key = "faces", .members = {in(&WaterSpec::faces)}, .example = "[\"A\"]",
     .no_default = true,
     .meaning = "the faces it is on: \"all\", as without it; \"outer\", those that no rock or boundary joint made (sides of the domain, "
         "blocks given directly, faces of excavations and their outlines, construction joints); or a list of joints and "
         "joint sets, which may hold \"outer\". The others are dry. Water acts whether a joint is open, closed or bonded; "
         "a face takes one water"},
  }},
  {"water_surface", {
    {.key = "level", .members = {in(&WaterSurfaceSpec::level)}, .unit = "m", .range = sane, .example = "90",
     .meaning = "elevation of a water that is level; this, a table or a pressure"},
    {.key = "table", .type = surface, .unit = "m", .range = sane,
     .example = "{ point = [0, 0, 90], dip = 5, dip_direction = 90 }", .holds = {"water_table"},
     .meaning = "its surface. In 2-D points (x, h) of ascending x, straight between them and constant beyond; in 3-D a plane"},
    {.key = "pressure", .members = {in(&WaterSurfaceSpec::pressure)}, .unit = "Pa", .range = {0, 1e12},
     .plausible = {.low = 10, .high = 1e7, .or_zero = true}, .example = "1000",
     .meaning = "a pressure that is the same at every depth", .mistake = "was it given in kPa or MPa?"},
  }},
  {"water_table", {
    {.key = "dip", .members = {degrees(&PlaneSpec::dip)}, .unit = "deg", .range = {0, 80},
     .plausible = {.low = 0.05, .high = 60, .or_zero = true}, .example = "5", .required = true,
     .meaning = "of the water's surface, below the horizontal", .repair = dip_repair, .mistake = angle_mistake},
    {.key = "dip_direction", .members = {degrees(&PlaneSpec::dip_direction)}, .unit = "deg", .range = direction_range,
     .plausible = plausible_direction, .example = "90", .no_default = true,
     .meaning = dip_direction_meaning, .repair = direction_repair, .mistake = angle_mistake},
    {.key = "point", .members = {in(&PlaneSpec::point)}, .unit = "m", .range = sane, .example = "[0, 0, 90]",
     .required = true, .meaning = "any point of the water's surface"},
  }},
  {"water_change", {
    {.key = "name", .members = {in(&WaterChangeSpec::name, name)}, .example = "\"lake\"", .required = true,
     .meaning = "of a [[water]], which changes linearly from what it is to the level, table or pressure stated here: each "
         "number of a table for itself. A level becomes a table, and a table a level, by its points"},
    {.key = "duration_s", .members = {in(&WaterChangeSpec::duration)}, .unit = "s", .range = {0, 1e9, true},
     .plausible = {0.01, 1000}, .example = "10",
     .meaning = "time of the change, from the begin of the stage on, at most its duration_s; this or rate. On the way to "
         "rest by relaxation it is a ramp, as gravity_ramp_s", .mistake = "was it given in ms?"},
    {.key = "rate", .members = {in(&WaterChangeSpec::rate)}, .unit = "m/s", .range = {0, 1e9, true},
     .plausible = {1e-4, 1e5}, .example = "0.25",
     .meaning = "speed of what changes most, m/s, of a pressure Pa/s",
     .breaks = "too fast: the water does not leave the blocks time to follow"},
  }}};
}
// clang-format on

}  // namespace voussoir::keys
