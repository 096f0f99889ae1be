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
     .meaning = "springs: a spring at every joint that the bolt crosses when it is installed; end_anchored: one from the plate, "
         "where the bolt enters the rock, to its end, which pulls but does not push; grouted: a bar that a bond ties to "
         "the rock along it, with the force at each joint that its equilibrium says"},
    {.key = "from", .members = {in(&BoltSpec::from)}, .unit = "m", .range = sane, .example = "[0, 5, 0]",
     .meaning = "collar of a single bolt; it may lie in the open"},
    {.key = "to", .members = {in(&BoltSpec::to)}, .unit = "m", .range = sane, .example = "[0, 9, 0]",
     .meaning = "its end"},
    {.key = "fan", .type = table, .holds = {"fan"},
     .meaning = "bolts on rays from a centre; this, or from and to"},
    {.key = "repeat", .type = tables, .holds = {"repeat"},
     .meaning = "the same bolts once more at equal steps: one for a row along a line, two for rows over a face"},
    {.key = "anchors", .members = {one_of(&BoltProperties::anchors,
         {{"offset", BoltAnchors::offset}, {"at_joint", BoltAnchors::at_joint}, {"midway", BoltAnchors::midway}})},
     .example = "\"midway\"", .when = {"kind", "springs|grouted"},
     .meaning = "where a spring is fixed in its two blocks, or a grouted bar bends as a joint slips; offset: 1.2 diameters from the joint, or in the middle of a block in "
         "which the bolt is shorter than two such lengths; at_joint: at the joint, the force then keeps the bolt's direction; "
         "midway: in the middle of the bolt's length in each block"},
    {.key = "diameter", .members = {in(&BoltProperties::diameter)}, .unit = "m", .range = {0, 1, true},
     .plausible = {0.01, 0.1}, .example = "0.028", .when = {"anchors", "offset"}, .and_when = {"kind", "springs|grouted"},
     .meaning = "of the bar", .mistake = "was it given in mm?"},
    {.key = "stiffness", .members = {in(&BoltProperties::stiffness)}, .unit = "N/m", .range = stiffness,
     .plausible = {1e6, 1e10}, .example = "2e8", .required = true, .when = {"kind", "springs"},
     .meaning = "along the bolt, of its spring at each joint", .mistake = "was it given in MN/m?"},
    {.key = "axial_stiffness", .members = {in(&BoltProperties::axial_stiffness)}, .unit = "N", .range = stiffness,
     .plausible = {1e6, 1e10}, .example = "1e8", .required = true, .when = {"kind", "end_anchored|grouted"},
     .meaning = "Young's modulus times section; of an end-anchored bolt, over its length it is the spring's stiffness",
     .mistake = "was it given in MN?"},
    {.key = "pretension", .members = {in(&BoltProperties::pretension)}, .unit = "N", .range = not_negative,
     .plausible = {.low = 1e3, .high = 1e7, .or_zero = true}, .example = "100e3",
     .meaning = "force of each spring when it is installed, before its blocks give way; of a grouted bolt that to which its plate "
         "is tightened, which it needs",
      .mistake = "was it given in kN?"},
    {.key = "yield", .members = {in(&BoltProperties::yield)}, .unit = "N", .range = positive, .plausible = {1e3, 1e7},
     .example = "250e3", .meaning = "largest axial force, in tension and in compression; without it there is none",
     .mistake = "was it given in kN?"},
    {.key = "rupture_extension", .members = {in(&BoltProperties::rupture_extension)}, .unit = "m", .range = not_negative,
     .plausible = {.low = 1e-4, .high = 1, .or_zero = true}, .example = "0.05", .when = {"kind", "springs|end_anchored"},
     .meaning = "plastic extension at one joint beyond which the bolt breaks there; 0: where it yields; needs yield",
     .mistake = "was it given in mm?"},
    {.key = "tension_only", .members = {in(&BoltProperties::tension_only)}, .example = "true", .when = {"kind", "springs"},
     .meaning = "a cable: it goes slack and does not push"},
    {.key = "dowel_stiffness", .members = {in(&BoltProperties::dowel_stiffness)}, .unit = "N/m",
     .range = {0, 1e20}, .plausible = {.low = 1e5, .high = 5e9, .or_zero = true}, .example = "1e7", .when = {"kind", "springs|end_anchored"},
     .meaning = "across the bolt, at each spring; 0: none", .mistake = "was it given in MN/m?"},
    {.key = "dowel_strength", .members = {in(&BoltProperties::dowel_strength)}, .unit = "N", .range = positive,
     .plausible = {1e3, 1e7}, .example = "100e3", .when = {"kind", "springs|end_anchored"},
     .meaning = "largest force across the bolt; needs dowel_stiffness", .mistake = "was it given in kN?"},
    {.key = "bond_stiffness", .members = {in(&BoltProperties::bond_stiffness)}, .unit = "N/m2", .range = stiffness,
     .plausible = {1e6, 1e11}, .example = "5e8", .required = true, .when = {"kind", "grouted"},
     .meaning = "of the grout between bar and rock: force per metre of bar and metre of slip", .mistake = "was it given in MPa?"},
    {.key = "bond_strength", .members = {in(&BoltProperties::bond_strength)}, .unit = "N/m", .range = positive,
     .plausible = {1e4, 1e7}, .example = "400e3", .when = {"kind", "grouted"},
     .meaning = "largest force of the bond per metre of bar, beyond which the bar slips; without it there is none",
     .mistake = "was it given in kN/m?"},
    {.key = "plate", .members = {one_of(&BoltProperties::plate,
         {{"none", Plate::none}, {"spring", Plate::spring}, {"tied", Plate::tied}})},
     .example = "\"spring\"", .when = {"kind", "grouted"},
     .meaning = "where the bolt enters the rock; spring: it presses on the rock and never pulls; tied: it moves with the rock"},
    {.key = "plate_stiffness", .members = {in(&BoltProperties::plate_stiffness)}, .unit = "N/m", .range = stiffness,
     .plausible = {1e6, 1e10}, .example = "1e8", .required = true, .when = {"plate", "spring"}, .and_when = {"kind", "grouted"},
     .meaning = "of plate and nut", .mistake = "was it given in MN/m?"},
    {.key = "free_length", .members = {in(&BoltProperties::free_length)}, .unit = "m", .range = not_negative,
     .plausible = {.low = 0.05, .high = 100, .or_zero = true}, .example = "0.5", .when = {"kind", "grouted"},
     .meaning = "of the bar from where it enters the rock, without grout", .mistake = "was it given in mm?"},
    {.key = "node_spacing", .members = {in(&BoltProperties::node_spacing)}, .unit = "m", .range = positive,
     .plausible = {0.005, 1}, .example = "0.1", .when = {"kind", "grouted"},
     .meaning = "at most, of the points at which bar and rock are tied; without it a fifth of sqrt(axial_stiffness / bond_stiffness), "
         "but no less than a 200th of the bolt's length",
     .breaks = "the stiffness of a bar over a joint is too low by its square over 8 axial_stiffness / bond_stiffness",
     .mistake = "was it given in mm?"},
    {.key = "spacing", .members = {in(&BoltSpec::spacing)}, .unit = "m", .range = positive, .plausible = {0.2, 20},
     .example = "1.5",
     .meaning = "in the plane, of the bolts along the third direction: a slice of 1 m holds one over spacing of each; 1 without it. "
         "Forces are stated and reported of one bolt"},
  }},
  {"fan", {
    {.key = "centre", .members = {in(&FanSpec::centre)}, .unit = "m", .range = sane, .example = "[0, 0, 0]",
     .required = true, .meaning = "where the rays begin"},
    {.key = "axis", .members = {in(&FanSpec::axis)}, .range = sane, .example = "[0, 1, 0]",
     .meaning = "direction that the rays stand across, in 3-D only, and needed there: of a tunnel its own, of any length"},
    {.key = "from_deg", .members = {degrees(&FanSpec::from)}, .unit = "deg", .range = {-360, 360}, .example = "22.5",
     .required = true,
     .meaning = "of the first ray, counter-clockwise from the horizontal to the right, in 3-D as one looks along the "
         "axis, about a vertical one from x"},
    {.key = "to_deg", .members = {degrees(&FanSpec::to)}, .unit = "deg", .range = {-360, 360}, .example = "157.5",
     .required = true, .meaning = "no ray lies beyond it"},
    {.key = "spacing_deg", .members = {degrees(&FanSpec::spacing)}, .unit = "deg", .range = {0, 360, true},
     .plausible = {1, 180}, .example = "11.25", .required = true, .meaning = "between rays", .mistake = angle_mistake},
    {.key = "start", .members = {in(&FanSpec::start)}, .unit = "m", .range = not_negative, .example = "5",
     .meaning = "of each bolt from the centre; it may lie in the open"},
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
