// [[joints]]
#include "core/scene/keys/tables.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable joint_keys() {
  return {"joints", {
    {.key = "name", .members = {in(&JointSpec::name, name)}, .example = "\"A\"", .required = true,
     .meaning = "unique among the joints"},
    {.key = "dip", .members = {degrees(&PlaneSpec::dip)}, .unit = "deg", .range = dip_range,
     .plausible = plausible_dip, .example = "40", .no_default = true,
     .meaning = "angle below the horizontal; required if no normal is stated", .repair = dip_repair,
     .mistake = angle_mistake},
    {.key = "dip_direction", .members = {degrees(&PlaneSpec::dip_direction)}, .unit = "deg", .range = direction_range,
     .plausible = plausible_direction, .example = "130", .no_default = true,
     .meaning = dip_direction_meaning, .repair = direction_repair, .mistake = angle_mistake},
    {.key = "point", .members = {in(&PlaneSpec::point)}, .unit = "m", .range = sane, .example = "[0, 0, 0]",
     .required = true,
     .meaning = "any point of the joint"},
    {.key = "normal", .members = {in(&PlaneSpec::normal)}, .range = {-1, 1}, .example = "[0, 0, 1]",
     .meaning = "unit normal instead of dip and dip_direction: gives the plane to the last bit, as in tables of drawn joint sets"},
    {.key = "properties", .members = {in(&JointSpec::properties, name)}, .example = "\"rock\"",
     .meaning = "name of a joint_properties table; may be left out if there is only one, or one named `default`"},
    {.key = "set", .members = {in(&JointSpec::set, name)}, .example = "\"bedding\"",
     .meaning = "the set that the joint belongs to, used by slicing.order; a joint without one is a set of its own"},
    {.key = "kind", .members = {one_of(&JointSpec::kind,
         {{"rock", JointKind::rock}, {"boundary", JointKind::boundary}, {"construction", JointKind::construction},
          {"fictitious", JointKind::fictitious}})},
     .example = "\"construction\"",
     .meaning = "boundary: one side is not cut further and is fixed; construction: the two sides are one body; fictitious: a cut through "
         "intact rock"},
    {.key = "fixed_side", .members = {one_of(&JointSpec::fixed_side,
         {{"below", JointSide::below}, {"above", JointSide::above}})},
     .example = "\"below\"", .required = true, .when = {"kind", "boundary"},
     .meaning = "the side that later joints do not cut and that never moves"},
    {.key = "within", .type = table, .holds = {"region"},
     .meaning = "subdomain to which the joint is confined: it cuts the blocks that it meets there, and cuts them completely"},
    {.key = "ends_at", .members = {in(&JointSpec::ends_at)}, .example = "[\"A\"]",
     .meaning = "joints stated before it, or excavations with an outline, at which it ends: it is on the side of each that contains its "
         "`point`, and is cut after it. For an excavation that side is beyond the face that the point sees, or the inside. With "
         "slicing.ends = \"ignored\" it does not end there"},
    {.key = "shape", .members = {one_of(&OutlineSpec::shape,
         {{"infinite", OutlineForm::none}, {"rectangle", OutlineForm::rectangle},
          {"ellipse", OutlineForm::ellipse}, {"polygon", OutlineForm::polygon}, {"trace", OutlineForm::rectangle}})},
     .example = "\"rectangle\"",
     .meaning = "outline in the joint's plane about `point` (2-D: trace); the joint cuts the blocks that it meets"},
    {.key = "length", .members = {in(&OutlineSpec::length)}, .unit = "m", .range = positive,
     .plausible = plausible_length, .example = "5", .required = true, .when = {"shape", "rectangle|ellipse|trace"},
     .meaning = "length of the outline along the strike, in 2-D of the trace", .mistake = "was it given in mm or km?"},
    {.key = "width", .members = {in(&OutlineSpec::width)}, .unit = "m", .range = positive,
     .plausible = plausible_length, .example = "5", .required = true, .when = {"shape", "rectangle|ellipse"},
     .meaning = "width of the outline down the dip", .mistake = "was it given in mm or km?"},
    {.key = "corners", .members = {in(&OutlineSpec::corners)}, .unit = "m", .range = sane,
     .example = "[[0, 0, 0], [1, 0, 0], [0, 1, 0]]", .required = true, .when = {"shape", "polygon"},
     .meaning = "corners of a convex polygon in the joint's plane, in order"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
