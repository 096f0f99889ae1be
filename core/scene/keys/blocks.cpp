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
     .meaning = "half-spaces `normal · x <= offset` whose intersection is the block"},
    {.key = "box", .type = table, .holds = {"box"}, .meaning = "a box aligned with the axes"},
    {.key = "shape", .members = {one_of(&BlockSpec::shape, {{"half_spaces", BlockShape::half_spaces},
         {"potential", BlockShape::potential}})},
     .example = "\"potential\"",
     .meaning = "potential: a rounded body, the points x with (1 - k) Σ max(a·x - d, 0)² / r² + k |x - c|² / R² <= 1 over the planes a·x "
         "<= d given by planes or box: each face is about r outside its plane. Such bodies touch at points; their joint_properties are "
         "those of faces that no joint made, and must state constant_stiffness"},
    {.key = "corner_radius", .members = {in(&ParticleSpec::corner_radius)}, .unit = "m", .range = positive,
     .example = "0.2", .when = {"shape", "potential"},
     .meaning = "r: rounds edges and corners; required if sphericity is below 1",
     .repair = "the radius of edges between planes at right angles, for example 0.05"},
    {.key = "sphericity", .members = {in(&ParticleSpec::sphericity)}, .unit = "1", .range = {0, 1},
     .plausible = {.low = 1e-3, .high = 1, .or_zero = true}, .example = "0.02", .required = true,
     .when = {"shape", "potential"},
     .meaning = "k: fraction of the sphere, from 0 (planes and r only) to 1 (a sphere)",
     .breaks = "at 0 the contact point of two parallel faces is not unique; 0.01 is enough to make it so"},
    {.key = "sphere_radius", .members = {in(&ParticleSpec::sphere_radius)}, .unit = "m", .range = positive,
     .example = "2", .when = {"shape", "potential"},
     .meaning = "R: radius of the sphere, which encloses the body; without it the smallest possible",
     .repair = "leave it out for the smallest radius that encloses the body"},
    {.key = "centre", .members = {in(&ParticleSpec::centre)}, .unit = "m", .range = sane, .example = "[0, 0, 1]",
     .when = {"shape", "potential"},
     .meaning = "c: centre of the sphere, inside the body; without it the centroid of the body bounded by the planes moved outwards by r"},
    {.key = "mass_tolerance", .members = {in(&ParticleSpec::mass_tolerance)}, .unit = "1", .range = {1e-6, 0.1},
     .plausible = {1e-5, 1e-2}, .example = "1e-4", .when = {"shape", "potential"},
     .meaning = "bound of the relative error of volume, centroid and inertia; a sphere has none",
     .breaks = "0.1 s per block at 1e-3, five times as much at 1e-5; the actual error is about a hundred times smaller"},
    {.key = "part_of", .members = {in(&BlockSpec::part_of, name)}, .example = "\"slider\"",
     .meaning = "another block: both are convex parts of one rigid body, which takes that block's name, density and motion. "
         "Parts of one body may touch but not overlap"},
    {.key = "density", .members = {in(&BlockSpec::density)}, .unit = "kg/m³", .range = positive,
     .plausible = plausible_density, .example = "2500",
     .meaning = "replaces the scene's density", .repair = "rock has 2000 to 3000 kg/m³", .mistake = density_mistake},
    {.key = "velocity", .members = {in(&MotionSpec::velocity)}, .unit = "m/s", .range = sane,
     .plausible = plausible_speed, .example = "[0, 0, -1]",
     .meaning = "velocity when the first stage begins; zero without it"},
    {.key = "angular_velocity", .members = {in(&MotionSpec::angular_velocity, spin)}, .unit = "rad/s", .range = sane,
     .plausible = plausible_speed, .example = "[0, 0, 1]",
     .meaning = "angular velocity when the first stage begins, world axes; in 2-D one number, counter-clockwise"},
    {.key = "fixed", .members = {in(&BlockSpec::fixed)}, .example = "true", .meaning = "the block never moves"},
  }};
}

KeyTable block_plane_keys() {
  return {"blocks.planes", {
    {.key = "normal", .members = {in(&BlockPlaneSpec::normal)}, .range = sane, .example = "[0, 0, 1]",
     .required = true,
     .meaning = "outward normal, of any length except zero"},
    {.key = "offset", .members = {in(&BlockPlaneSpec::offset)}, .unit = "m", .range = sane, .example = "1",
     .meaning = "`normal · x` on the plane, for the normal as given"},
    {.key = "point", .members = {in(&BlockPlaneSpec::point)}, .unit = "m", .range = sane, .example = "[0, 0, 1]",
     .meaning = "any point of the plane, instead of offset; loses no digits far from the origin"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
