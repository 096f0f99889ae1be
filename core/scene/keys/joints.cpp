// [[joints]]
#include "core/scene/keys/ranges.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir {

using enum KeyType;
using namespace key_ranges;

// clang-format off
KeyTable joint_keys() {
  return {"joints", {
    {.key = "name", .type = name, .example = "\"A\"", .required = true,
     .meaning = "unique among the joints"},
    {.key = "dip", .unit = "deg", .range = dip_range, .plausible = plausible_dip, .example = "40",
     .meaning = "angle below the horizontal; required where no normal is stated", .repair = dip_repair, .mistake = angle_mistake},
    {.key = "dip_direction", .unit = "deg", .range = direction_range, .plausible = plausible_direction,
     .example = "130",
     .meaning = dip_direction_meaning, .repair = direction_repair, .mistake = angle_mistake},
    {.key = "point", .type = vector, .unit = "m", .range = sane, .example = "[0, 0, 0]",
     .required = true, .meaning = "any point of the joint"},
    {.key = "normal", .type = vector, .range = {-1, 1}, .example = "[0, 0, 1]",
     .meaning = "unit normal instead of dip and dip_direction: the plane to the last bit, as tables of drawn joints have it"},
    {.key = "properties", .type = name, .example = "\"rock\"",
     .meaning = "name of a joint_properties table; may be left out where only one exists or one is named `default`"},
    {.key = "set", .type = name, .example = "\"bedding\"",
     .meaning = "joints of one set, which slicing.order knows; a joint without one is a set of its own"},
    {.key = "kind", .type = choice, .default_value = "\"rock\"", .example = "\"construction\"",
     .choices = {"rock", "boundary", "construction", "fictitious"},
     .meaning = "boundary: one side stays whole and fixed; construction: its two sides are one body; fictitious: intact"},
    {.key = "whole", .type = choice, .example = "\"below\"", .required = true,
     .when = {"kind", "boundary"}, .choices = {"below", "above"},
     .meaning = "the side that later joints do not cut and that never moves"},
    {.key = "within", .type = table, .holds = {"region"},
     .meaning = "subdomain that the joint is confined to: it cuts the blocks that it meets there, and those right through"},
    {.key = "shape", .type = choice, .default_value = "\"infinite\"", .example = "\"rectangle\"",
     .choices = {"infinite", "rectangle", "ellipse", "polygon", "trace"},
     .meaning = "outline in the joint's plane about `point` (2-D: trace); the joint cuts the blocks that it meets"},
    {.key = "length", .unit = "m", .range = positive, .plausible = plausible_length, .example = "5",
     .required = true, .when = {"shape", "rectangle|ellipse|trace"},
     .meaning = "of the outline along the strike, in 2-D of the trace", .mistake = "was it given in mm or km?"},
    {.key = "width", .unit = "m", .range = positive, .plausible = plausible_length, .example = "5",
     .required = true, .when = {"shape", "rectangle|ellipse"},
     .meaning = "of the outline down the dip", .mistake = "was it given in mm or km?"},
    {.key = "corners", .type = points, .unit = "m", .range = sane,
     .example = "[[0, 0, 0], [1, 0, 0], [0, 1, 0]]", .required = true, .when = {"shape", "polygon"},
     .meaning = "corners of a convex polygon in the joint's plane, in order"},
  }};
}
// clang-format on

}  // namespace voussoir
