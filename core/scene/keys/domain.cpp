// [domain]: the region that the joints cut; boxes and planes, which regions share with it.
#include "core/scene/keys/tables.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable domain_keys() {
  return {"domain", {
    {.key = "box", .type = table, .holds = {"box"}, .meaning = "a box aligned with the axes"},
    {.key = "planes", .type = tables, .holds = {"label", "domain.planes"},
     .meaning = "planes that bound the domain, with or without a box"},
  }};
}

KeyTable box_keys() {
  return {"box", {
    {.key = "min", .members = {in(&BoxSpec::min)}, .unit = "m", .range = sane, .example = "[-4, -4, -4]",
     .required = true,
     .meaning = "lowest corner"},
    {.key = "max", .members = {in(&BoxSpec::max)}, .unit = "m", .range = sane, .example = "[4, 4, 0]",
     .required = true,
     .meaning = "highest corner"},
  }};
}

KeyTable domain_plane_keys() {
  return {"domain.planes", {
    {.key = "dip", .members = {degrees(&PlaneSpec::dip)}, .unit = "deg", .range = dip_range,
     .plausible = plausible_dip, .example = "70", .required = true,
     .meaning = "angle below the horizontal", .repair = dip_repair, .mistake = angle_mistake},
    {.key = "dip_direction", .members = {degrees(&PlaneSpec::dip_direction)}, .unit = "deg", .range = direction_range,
     .plausible = plausible_direction, .example = "155", .no_default = true,
     .meaning = dip_direction_meaning, .repair = direction_repair, .mistake = angle_mistake},
    {.key = "point", .members = {in(&PlaneSpec::point)}, .unit = "m", .range = sane, .example = "[0, 0, 0]",
     .required = true,
     .meaning = "any point of the plane"},
    {.key = "keep", .members = {one_of(&DomainPlaneSpec::keep_below, {{"below", true}, {"above", false}})},
     .example = "\"below\"", .required = true,
     .meaning = "the side of the plane that belongs to the domain"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
