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
    {.key = "shape", .members = {one_of(&BlockSpec::shape, {{"half_spaces", BlockShape::half_spaces},
         {"potential", BlockShape::potential}})},
     .example = "\"potential\"",
     .meaning = "potential: a rounded body, where (1 - k) Σ max(a·x - d, 0)² / r² + k |x - c|² / R² <= 1 over the planes "
         "a·x <= d that planes or box state: each face lies about r outside its plane. Contacts of such bodies are points, "
         "with the joint_properties of faces that no joint made, of constant_stiffness"},
    {.key = "corner_radius", .members = {in(&ParticleSpec::corner_radius)}, .unit = "m", .range = positive,
     .example = "0.2", .when = {"shape", "potential"},
     .meaning = "r: rounds edges and corners; needed where sphericity is below 1",
     .repair = "the radius of edges between planes at right angles, for example 0.05"},
    {.key = "sphericity", .members = {in(&ParticleSpec::sphericity)}, .unit = "1", .range = {0, 1},
     .plausible = {.low = 1e-3, .high = 1, .or_zero = true}, .example = "0.02", .required = true,
     .when = {"shape", "potential"},
     .meaning = "k: the fraction of the sphere, 0 (planes and r alone) to 1 (a sphere)",
     .breaks = "at 0 no point of two faces that lie on each other is chosen; 0.01 does"},
    {.key = "sphere_radius", .members = {in(&ParticleSpec::sphere_radius)}, .unit = "m", .range = positive,
     .example = "2", .when = {"shape", "potential"},
     .meaning = "R: of the sphere, which encloses the body; without it the least that does",
     .repair = "leave it out for the least radius that encloses the body"},
    {.key = "centre", .members = {in(&ParticleSpec::centre)}, .unit = "m", .range = sane, .example = "[0, 0, 1]",
     .when = {"shape", "potential"},
     .meaning = "c: of the sphere, inside the body; without it the centroid of the planes moved out by r"},
    {.key = "mass_tolerance", .members = {in(&ParticleSpec::mass_tolerance)}, .unit = "1", .range = {1e-6, 0.1},
     .plausible = {1e-5, 1e-2}, .example = "1e-4", .when = {"shape", "potential"},
     .meaning = "bound of the error of volume, centroid and inertia, over the volume; none of a sphere",
     .breaks = "0.1 s a block at 1e-3, five times as much at 1e-5; the error itself is a hundred times smaller"},
    {.key = "part_of", .members = {in(&BlockSpec::part_of, name)}, .example = "\"slider\"",
     .meaning = "another block: both are convex parts of one rigid body, which has that block's name, density and motion. "
         "Parts of one body may touch but not overlap"},
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
