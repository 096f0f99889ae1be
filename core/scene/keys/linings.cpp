// [[linings]]
#include "core/scene/keys/tables.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable lining_keys() {
  return {"linings", {
    {.key = "name", .members = {in(&LiningProperties::name, name)}, .example = "\"shell\"", .required = true,
     .meaning = "unique among linings and bolts"},
    {.key = "excavation", .members = {in(&LiningSpec::excavation, name)}, .example = "\"tunnel\"", .required = true,
     .meaning = "the [[excavations]] against whose outline the lining is cast; it must state outline = true"},
    {.key = "joint_properties", .members = {in(&LiningSpec::interface_properties, name)}, .example = "\"rock_to_lining\"", .required = true,
     .meaning = "properties of the interface between lining and rock: stiffness per area, friction and, if stated, tension and cohesion, "
         "which act from casting until the bond breaks"},
    {.key = "nodes", .members = {in(&LiningSpec::nodes)}, .range = {3, 100000}, .plausible = {24, 2000}, .example = "100", .required = true,
     .meaning = "number of nodes, on rays at equal angles from the middle of the outline; their spacing should be less than that of the "
         "joints along the outline"},
    {.key = "from_deg", .members = {degrees(&LiningSpec::from)}, .unit = "deg", .range = {-360, 360}, .example = "0",
     .meaning = "direction of the first node, counter-clockwise from the horizontal to the right; of a ring 0 without it"},
    {.key = "to_deg", .members = {degrees(&LiningSpec::to)}, .unit = "deg", .range = {-360, 720}, .example = "180",
     .meaning = "direction of the last node, if the lining has two ends; without it the lining is a ring"},
    {.key = "thickness", .members = {in(&LiningProperties::thickness)}, .unit = "m", .range = positive,
     .plausible = {0.02, 3}, .example = "0.3", .required = true,
     .meaning = "thickness of the section", .mistake = "was it given in mm?"},
    {.key = "young_modulus", .members = {in(&LiningProperties::young_modulus)}, .unit = "Pa", .range = stiffness,
     .plausible = {1e8, 5e11}, .example = "25e9", .required = true,
     .meaning = "Young's modulus of the lining; divide it by 1 - ν² for plane strain", .mistake = "was it given in GPa?"},
    {.key = "density", .members = {in(&LiningProperties::density)}, .unit = "kg/m³", .range = positive,
     .plausible = plausible_density, .example = "2400", .meaning = "density of the lining", .mistake = density_mistake},
    {.key = "bending_stiffness", .members = {in(&LiningProperties::bending_stiffness)}, .unit = "N m²/m", .range = stiffness,
     .plausible = {1e3, 1e11}, .example = "56e6",
     .meaning = "bending stiffness EI of 1 m of lining; without it young_modulus thickness³ / 12", .mistake = "was it given in MN m²/m?"},
    {.key = "compressive_strength", .members = {in(&LiningProperties::compressive_strength)}, .unit = "Pa", .range = positive,
     .plausible = {1e6, 3e8}, .example = "25e6",
     .meaning = "with tensile_strength: the utilisation of the lining is reported, from the largest stress of an elastic section; nothing "
         "breaks", .mistake = "was it given in MPa?"},
    {.key = "tensile_strength", .members = {in(&LiningProperties::tensile_strength)}, .unit = "Pa", .range = positive,
     .plausible = {1e5, 5e7}, .example = "2e6", .meaning = "see compressive_strength", .mistake = "was it given in MPa?"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
