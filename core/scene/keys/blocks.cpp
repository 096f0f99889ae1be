// [[blocks]]
#include "core/scene/keys/tables.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable block_keys() {
  return {"blocks", {
    {.key = "name", .members = {in(&BlockSpec::name, name)}, .example = "\"slider\"", .required = true,
     .meaning = "unique among the blocks"},
    {.key = "vertices", .members = {in(&BlockSpec::vertices)}, .unit = "m", .range = sane,
     .example = "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]",
     .meaning = "all corners of a convex block, in any order"},
    {.key = "planes", .type = tables, .holds = {"blocks.planes"},
     .meaning = "the half-spaces `normal · x <= offset` that the block lies in"},
    {.key = "box", .type = table, .holds = {"box"}, .meaning = "a box along the axes"},
    {.key = "part_of", .members = {in(&BlockSpec::part_of, name)}, .example = "\"slider\"",
     .meaning = "another block: both are convex parts of one rigid body, which has that block's name, density and motion"},
    {.key = "density", .members = {in(&BlockSpec::density)}, .unit = "kg/m³", .range = positive,
     .plausible = plausible_density, .example = "2500",
     .meaning = "replaces the scene's density", .repair = "rock has 2000 to 3000 kg/m³", .mistake = density_mistake},
    {.key = "velocity", .members = {in(&MotionSpec::velocity)}, .unit = "m/s", .range = sane,
     .plausible = plausible_speed, .example = "[0, 0, -1]",
     .meaning = "when the first stage begins; at rest without it"},
    {.key = "angular_velocity", .members = {in(&MotionSpec::angular_velocity, spin)}, .unit = "rad/s", .range = sane,
     .plausible = plausible_speed, .example = "[0, 0, 1]",
     .meaning = "when the first stage begins, world axes; in 2-D one number, counter-clockwise"},
    {.key = "fixed", .members = {in(&BlockSpec::fixed)}, .example = "true", .meaning = "the block never moves"},
  }};
}

KeyTable block_plane_keys() {
  return {"blocks.planes", {
    {.key = "normal", .members = {in(&BlockPlaneSpec::normal)}, .range = sane, .example = "[0, 0, 1]",
     .required = true,
     .meaning = "outward normal, of any length but zero"},
    {.key = "offset", .members = {in(&BlockPlaneSpec::offset)}, .unit = "m", .range = sane, .example = "1",
     .meaning = "`normal · x` on the plane, for the normal as given"},
    {.key = "point", .members = {in(&BlockPlaneSpec::point)}, .unit = "m", .range = sane, .example = "[0, 0, 1]",
     .meaning = "any point of the plane, instead of offset; keeps its digits far from the origin"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
