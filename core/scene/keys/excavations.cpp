// [[excavations]], and the convex regions, to which joints may be confined too.
#include "core/scene/keys/tables.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable excavation_keys() {
  return {"excavations", {
    {.key = "name", .members = {in(&ExcavationSpec::name, name)}, .example = "\"tunnel\"", .required = true,
     .meaning = "unique among the excavations"},
    {.key = "outline", .members = {in(&ExcavationSpec::outline)}, .example = "true",
     .meaning = "cut blocks along the region's faces by construction joints, after all other joints; without it blocks are excavated or "
         "kept whole"},
    {.key = "smallest_piece", .members = {in(&ExcavationSpec::smallest_piece)}, .unit = "m",
     .range = not_negative, .plausible = {.low = 1e-3, .high = 50, .or_zero = true}, .example = "0.1",
     .meaning = "inscribed radius below which the remaining piece of a cut block is excavated too; slicing.smallest_inscribed_radius "
         "without it",
     .breaks = "slivers shorten the time step", .mistake = "was it given in mm?"},
  }};
}

KeyTable region_keys() {
  return {"region", {
    {.key = "box", .type = table, .holds = {"box"}, .meaning = "a box aligned with the axes"},
    {.key = "cylinder", .type = table, .holds = {"cylinder"}, .meaning = "a tunnel, in 2-D a circle"},
    {.key = "planes", .type = tables, .holds = {"domain.planes"}, .meaning = "planes that bound the region"},
  }};
}

KeyTable cylinder_keys() {
  return {"cylinder", {
    {.key = "from", .members = {in(&CylinderSpec::from)}, .unit = "m", .range = sane, .example = "[0, -1, 0]",
     .required = true,
     .meaning = "one end of the axis; in 2-D the centre"},
    {.key = "to", .members = {in(&CylinderSpec::to)}, .unit = "m", .range = sane, .example = "[0, 1, 0]",
     .meaning = "the other end; in 3-D only, and required there"},
    {.key = "radius", .members = {in(&CylinderSpec::radius)}, .unit = "m", .range = positive,
     .plausible = plausible_length, .example = "3", .required = true,
     .meaning = "radius of the circle that the sides touch", .mistake = "was it given in mm or km?"},
    {.key = "sides", .members = {in(&CylinderSpec::sides)}, .range = {3, 256}, .example = "12",
     .meaning = "number of sides of the polygon that replaces the circle"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
