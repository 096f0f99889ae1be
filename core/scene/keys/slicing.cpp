// [slicing]
#include "core/scene/keys/tables.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable slicing_keys() {
  return {"slicing", {
    {.key = "smallest_inscribed_radius", .members = {in(&SlicingSpec::smallest_inscribed_radius)}, .unit = "m",
     .range = not_negative, .plausible = {.low = 1e-3, .high = 50, .or_zero = true}, .example = "0.01",
     .meaning = "a block is not cut if a smaller block would result; outlines of excavations always cut, and smaller remaining pieces are "
         "excavated too, unless the excavation states smallest_piece",
     .breaks = "slivers shorten the time step", .mistake = "was it given in mm?"},
    {.key = "largest_aspect_ratio", .members = {in(&SlicingSpec::largest_aspect_ratio)}, .unit = "1",
     .range = not_negative, .plausible = {.low = 10, .high = 1e5, .or_zero = true}, .example = "8000",
     .meaning = "longest over shortest edge of a block's bounding box; a cut that would exceed it is not made; 0: no bound"},
    {.key = "most_blocks", .members = {in(&SlicingSpec::most_blocks)}, .range = {1, 1e9}, .plausible = {1000, 1e7},
     .example = "100000",
     .meaning = "largest number of blocks; joints that make more are refused; a block takes 2 kB"},
    {.key = "order", .members = {one_of(&SlicingSpec::order,
         {{"size", CuttingOrder::by_size}, {"given", CuttingOrder::given},
          {"alternating", CuttingOrder::alternating}})},
     .example = "\"given\"",
     .meaning = "order of the cuts; size: large outlines first, joints of equal size set by set in turn; given: as in the file; "
         "alternating: one joint of every set in turn. Except with `given`, boundary joints come first and construction joints last"},
    {.key = "ends", .members = {one_of(&SlicingSpec::ends,
         {{"extended", JointEnds::extended}, {"healed", JointEnds::healed}, {"ignored", JointEnds::ignored}})},
     .example = "\"healed\"",
     .meaning = "extended: a joint cuts completely through every block that it meets; healed: partial cuts are removed; ignored: every "
         "joint is treated as infinite"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
