// [[water]], and its changes in [[stage.water]].
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
     .meaning = "unit weight; the pressure grows downwards along the vertical whatever the direction of gravity, and scales with the "
         "factor of gravity",
     .mistake = "was it given in kN/m³, or as a density?"},
    {.key = "faces", .members = {in(&WaterSpec::faces)}, .example = "[\"A\"]",
     .no_default = true,
     .meaning = "the faces on which it acts: \"all\", the default; \"outer\", those that no rock or boundary joint made (sides of the "
         "domain, "
         "blocks given directly, faces of excavations and their outlines, construction joints); or a list of joints and joint sets, which "
         "may contain \"outer\". The others are dry. Water acts whether a joint is open, closed or bonded; "
         "each face has one water only"},
  }},
  {"water_surface", {
    {.key = "level", .members = {in(&WaterSurfaceSpec::level)}, .unit = "m", .range = sane, .example = "90",
     .meaning = "elevation of a horizontal water level; either this, a table or a pressure"},
    {.key = "table", .type = surface, .unit = "m", .range = sane,
     .example = "{ point = [0, 0, 90], dip = 5, dip_direction = 90 }", .holds = {"water_table"},
     .meaning = "water table. In 2-D points (x, h) of ascending x, linear between them and constant beyond; in 3-D a plane"},
    {.key = "pressure", .members = {in(&WaterSurfaceSpec::pressure)}, .unit = "Pa", .range = {0, 1e12},
     .plausible = {.low = 10, .high = 1e7, .or_zero = true}, .example = "1000",
     .meaning = "a constant pressure, independent of depth", .mistake = "was it given in kPa or MPa?"},
  }},
  {"water_table", {
    {.key = "dip", .members = {degrees(&PlaneSpec::dip)}, .unit = "deg", .range = {0, 80},
     .plausible = {.low = 0.05, .high = 60, .or_zero = true}, .example = "5", .required = true,
     .meaning = "dip of the water table, below the horizontal", .repair = dip_repair, .mistake = angle_mistake},
    {.key = "dip_direction", .members = {degrees(&PlaneSpec::dip_direction)}, .unit = "deg", .range = direction_range,
     .plausible = plausible_direction, .example = "90", .no_default = true,
     .meaning = dip_direction_meaning, .repair = direction_repair, .mistake = angle_mistake},
    {.key = "point", .members = {in(&PlaneSpec::point)}, .unit = "m", .range = sane, .example = "[0, 0, 90]",
     .required = true, .meaning = "any point of the water table"},
  }},
  {"water_change", {
    {.key = "name", .members = {in(&WaterChangeSpec::name, name)}, .example = "\"lake\"", .required = true,
     .meaning = "name of a [[water]] that changes linearly from its present level, table or pressure to the one stated here; in a table "
         "each number changes by itself. A level changes to a table, and a table to a level, point by point"},
    {.key = "duration_s", .members = {in(&WaterChangeSpec::duration)}, .unit = "s", .range = {0, 1e9, true},
     .plausible = {0.01, 1000}, .example = "10",
     .meaning = "duration of the change, from the start of the stage on, at most the stage's duration_s; either this or rate. In a settle "
         "stage by relaxation it is a ramp, like gravity_ramp_s", .mistake = "was it given in ms?"},
    {.key = "rate", .members = {in(&WaterChangeSpec::rate)}, .unit = "m/s", .range = {0, 1e9, true},
     .plausible = {1e-4, 1e5}, .example = "0.25",
     .meaning = "rate of the value that changes most, in m/s, of a pressure in Pa/s",
     .breaks = "too fast: the blocks have no time to follow"},
  }}};
}
// clang-format on

}  // namespace voussoir::keys
