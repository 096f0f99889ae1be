// [[bolts]]
#include "core/scene/keys/tables.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {

// clang-format off
std::vector<KeyTable> bolt_keys() {
  return {{"bolts", {
    {.key = "name", .members = {in(&BoltProperties::name, name)}, .example = "\"roof\"", .required = true,
     .meaning = "unique among the bolts; all bolts of the table have it"},
    {.key = "kind", .members = {one_of(&BoltProperties::kind,
         {{"springs", BoltKind::springs}, {"end_anchored", BoltKind::end_anchored}, {"grouted", BoltKind::grouted}})},
     .example = "\"end_anchored\"",
     .meaning = "springs: a spring at every joint that the bolt crosses when it is installed; end_anchored: one spring from the plate, "
         "where the bolt enters the rock, to its end, which pulls but does not push; grouted: a bar bonded to the rock along its length, "
         "whose force at each joint follows from the bar's equilibrium"},
    {.key = "from", .members = {in(&BoltSpec::from)}, .unit = "m", .range = sane, .example = "[0, 5, 0]",
     .meaning = "collar of a single bolt; it may be outside the rock"},
    {.key = "to", .members = {in(&BoltSpec::to)}, .unit = "m", .range = sane, .example = "[0, 9, 0]",
     .meaning = "its end"},
    {.key = "fan", .type = table, .holds = {"fan"},
     .meaning = "bolts on rays from a centre; either this, or from and to"},
    {.key = "repeat", .type = tables, .holds = {"repeat"},
     .meaning = "copies of the bolts at equal steps: one table for a row along a line, two for rows over a face"},
    {.key = "anchors", .members = {one_of(&BoltProperties::anchors,
         {{"offset", BoltAnchors::offset}, {"at_joint", BoltAnchors::at_joint}, {"midway", BoltAnchors::midway}})},
     .example = "\"midway\"", .when = {"kind", "springs|grouted"},
     .meaning = "where a spring is fixed in its two blocks, or a grouted bar bends when a joint slips; offset: 1.2 diameters from the "
         "joint, or in the middle of a block in which the bolt is shorter than two such lengths; at_joint: at the joint, so that the force "
         "keeps the bolt's direction; midway: in the middle of the bolt's length in each block"},
    {.key = "diameter", .members = {in(&BoltProperties::diameter)}, .unit = "m", .range = {0, 1, true},
     .plausible = {0.01, 0.1}, .example = "0.028", .when = {"anchors", "offset"}, .and_when = {"kind", "springs|grouted"},
     .meaning = "diameter of the bar", .mistake = "was it given in mm?"},
    {.key = "stiffness", .members = {in(&BoltProperties::stiffness)}, .unit = "N/m", .range = stiffness,
     .plausible = {1e6, 1e10}, .example = "2e8", .required = true, .when = {"kind", "springs"},
     .meaning = "axial stiffness of the spring at each joint", .mistake = "was it given in MN/m?"},
    {.key = "axial_stiffness", .members = {in(&BoltProperties::axial_stiffness)}, .unit = "N", .range = stiffness,
     .plausible = {1e6, 1e10}, .example = "1e8", .required = true, .when = {"kind", "end_anchored|grouted"},
     .meaning = "Young's modulus times cross-section; divided by the length, it is the stiffness of an end-anchored bolt's spring",
     .mistake = "was it given in MN?"},
    {.key = "pretension", .members = {in(&BoltProperties::pretension)}, .unit = "N", .range = not_negative,
     .plausible = {.low = 1e3, .high = 1e7, .or_zero = true}, .example = "100e3",
     .meaning = "force of each spring at installation, before its blocks move; for a grouted bolt the force to which its plate is "
         "tightened (requires a plate)",
      .mistake = "was it given in kN?"},
    {.key = "yield", .members = {in(&BoltProperties::yield)}, .unit = "N", .range = positive, .plausible = {1e3, 1e7},
     .example = "250e3", .meaning = "largest axial force, in tension and in compression; unlimited without it",
     .mistake = "was it given in kN?"},
    {.key = "rupture_extension", .members = {in(&BoltProperties::rupture_extension)}, .unit = "m", .range = not_negative,
     .plausible = {.low = 1e-4, .high = 1, .or_zero = true}, .example = "0.05", .when = {"kind", "springs|end_anchored"},
     .meaning = "plastic extension at a joint beyond which the bolt breaks there; 0: it breaks when it yields; requires yield",
     .mistake = "was it given in mm?"},
    {.key = "tension_only", .members = {in(&BoltProperties::tension_only)}, .example = "true", .when = {"kind", "springs"},
     .meaning = "a cable: it goes slack and does not push"},
    {.key = "dowel_stiffness", .members = {in(&BoltProperties::dowel_stiffness)}, .unit = "N/m",
     .range = {0, 1e20}, .plausible = {.low = 1e5, .high = 5e9, .or_zero = true}, .example = "1e7", .when = {"kind", "springs|end_anchored"},
     .meaning = "shear stiffness across the bolt, of each spring; 0: none", .mistake = "was it given in MN/m?"},
    {.key = "dowel_strength", .members = {in(&BoltProperties::dowel_strength)}, .unit = "N", .range = positive,
     .plausible = {1e3, 1e7}, .example = "100e3", .when = {"kind", "springs|end_anchored"},
     .meaning = "largest shear force across the bolt; requires dowel_stiffness", .mistake = "was it given in kN?"},
    {.key = "bond_stiffness", .members = {in(&BoltProperties::bond_stiffness)}, .unit = "N/m2", .range = stiffness,
     .plausible = {1e6, 1e11}, .example = "5e8", .required = true, .when = {"kind", "grouted"},
     .meaning = "shear stiffness of the grout between bar and rock: force per metre of bar and per metre of slip", .mistake = "was it "
         "given in MPa?"},
    {.key = "bond_strength", .members = {in(&BoltProperties::bond_strength)}, .unit = "N/m", .range = positive,
     .plausible = {1e4, 1e7}, .example = "400e3", .when = {"kind", "grouted"},
     .meaning = "largest bond force per metre of bar, beyond which the bar slips; unlimited without it",
     .mistake = "was it given in kN/m?"},
    {.key = "plate", .members = {one_of(&BoltProperties::plate,
         {{"none", Plate::none}, {"spring", Plate::spring}, {"tied", Plate::tied}})},
     .example = "\"spring\"", .when = {"kind", "grouted"},
     .meaning = "at the point where the bolt enters the rock; spring: the plate presses on the rock and never pulls; tied: the bar's head "
         "moves with the rock"},
    {.key = "plate_stiffness", .members = {in(&BoltProperties::plate_stiffness)}, .unit = "N/m", .range = stiffness,
     .plausible = {1e6, 1e10}, .example = "1e8", .required = true, .when = {"plate", "spring"}, .and_when = {"kind", "grouted"},
     .meaning = "stiffness of plate and nut", .mistake = "was it given in MN/m?"},
    {.key = "free_length", .members = {in(&BoltProperties::free_length)}, .unit = "m", .range = not_negative,
     .plausible = {.low = 0.05, .high = 100, .or_zero = true}, .example = "0.5", .when = {"kind", "grouted"},
     .meaning = "ungrouted length of the bar, from the point where it enters the rock", .mistake = "was it given in mm?"},
    {.key = "node_spacing", .members = {in(&BoltProperties::node_spacing)}, .unit = "m", .range = positive,
     .plausible = {0.005, 1}, .example = "0.1", .when = {"kind", "grouted"},
     .meaning = "largest spacing of the nodes at which the bar is bonded to the rock; without it a fifth of sqrt(axial_stiffness / "
         "bond_stiffness), but at least a 200th of the bolt's length",
     .breaks = "the stiffness of a bar across a joint is too low by the fraction spacing² / (8 axial_stiffness / bond_stiffness)",
     .mistake = "was it given in mm?"},
    {.key = "spacing", .members = {in(&BoltSpec::spacing)}, .unit = "m", .range = positive, .plausible = {0.2, 20},
     .example = "1.5",
     .meaning = "in 2-D, spacing of the bolts out of the plane: a slice of 1 m contains 1/spacing of each bolt; 1 without it. Forces are "
         "stated and reported per bolt"},
  }},
  {"fan", {
    {.key = "centre", .members = {in(&FanSpec::centre)}, .unit = "m", .range = sane, .example = "[0, 0, 0]",
     .required = true, .meaning = "point from which the rays start"},
    {.key = "axis", .members = {in(&FanSpec::axis)}, .range = sane, .example = "[0, 1, 0]",
     .meaning = "direction perpendicular to the rays, of any length, for a tunnel its axis; in 3-D only, and required there"},
    {.key = "from_deg", .members = {degrees(&FanSpec::from)}, .unit = "deg", .range = {-360, 360}, .example = "22.5",
     .required = true,
     .meaning = "direction of the first ray, counter-clockwise from the horizontal to the right; in 3-D looking along the axis, from x if "
         "the axis is vertical"},
    {.key = "to_deg", .members = {degrees(&FanSpec::to)}, .unit = "deg", .range = {-360, 360}, .example = "157.5",
     .required = true, .meaning = "upper bound of the rays' directions"},
    {.key = "spacing_deg", .members = {degrees(&FanSpec::spacing)}, .unit = "deg", .range = {0, 360, true},
     .plausible = {1, 180}, .example = "11.25", .required = true, .meaning = "angle between rays", .mistake = angle_mistake},
    {.key = "start", .members = {in(&FanSpec::start)}, .unit = "m", .range = not_negative, .example = "5",
     .meaning = "distance of each bolt's start from the centre; it may be outside the rock"},
    {.key = "length", .members = {in(&FanSpec::length)}, .unit = "m", .range = positive, .plausible = {0.3, 100},
     .example = "7", .required = true, .meaning = "of each bolt", .mistake = "was it given in mm?"},
  }},
  {"repeat", {
    {.key = "step", .members = {in(&RepeatSpec::step)}, .unit = "m", .range = sane, .example = "[0, 1.5, 0]",
     .required = true, .meaning = "from each bolt to the next"},
    {.key = "count", .members = {in(&RepeatSpec::count)}, .range = {2, 10000}, .example = "10", .required = true,
     .meaning = "bolts in the row, with the first"},
  }}};
}
// clang-format on

}  // namespace voussoir::keys
