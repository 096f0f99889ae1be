// [domain]: what the joints cut, and the boxes and planes that regions share with it.
#include "core/scene/keys/ranges.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir {

using enum KeyType;
using namespace key_ranges;

// clang-format off
KeyTable domain_keys() {
  return {"domain", {
    {.key = "box", .type = table, .holds = {"box"},
     .meaning = "a box along the axes"},
    {.key = "planes", .type = tables, .holds = {"label", "domain.planes"},
     .meaning = "planes that bound the domain, with the box or without it"},
  }};
}

KeyTable box_keys() {
  return {"box", {
    {.key = "min", .type = vector, .unit = "m", .range = sane, .example = "[-4, -4, -4]",
     .required = true, .meaning = "lowest corner"},
    {.key = "max", .type = vector, .unit = "m", .range = sane, .example = "[4, 4, 0]", .required = true,
     .meaning = "highest corner"},
  }};
}

KeyTable domain_plane_keys() {
  return {"domain.planes", {
    {.key = "dip", .unit = "deg", .range = dip_range, .plausible = plausible_dip, .example = "70",
     .required = true, .meaning = "angle below the horizontal", .repair = dip_repair, .mistake = angle_mistake},
    {.key = "dip_direction", .unit = "deg", .range = direction_range,
     .plausible = plausible_direction, .example = "155",
     .meaning = dip_direction_meaning, .repair = direction_repair, .mistake = angle_mistake},
    {.key = "point", .type = vector, .unit = "m", .range = sane, .example = "[0, 0, 0]",
     .required = true, .meaning = "any point of the plane"},
    {.key = "keep", .type = choice, .example = "\"below\"", .required = true,
     .choices = {"below", "above"}, .meaning = "the side of the plane that belongs to the domain"},
  }};
}
// clang-format on

}  // namespace voussoir
