// [slicing]
#include "core/scene/keys/tables.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable slicing_keys() {
  return {"slicing", {
    {.key = "smallest_inscribed_radius", .members = {in(&SlicingSpec::smallest_inscribed_radius)}, .unit = "m",
     .range = not_negative, .plausible = {.low = 1e-3, .high = 50, .or_zero = true}, .example = "0.01",
     .meaning = "a cut that would leave a smaller block is not made in that block; outlines of excavations are cut all the same, and what they leave of blocks that is smaller goes, too, where they state no smallest_piece",
     .breaks = "slivers shorten the time step", .mistake = "was it given in mm?"},
    {.key = "largest_aspect_ratio", .members = {in(&SlicingSpec::largest_aspect_ratio)}, .unit = "1",
     .range = not_negative, .plausible = {.low = 10, .high = 1e5, .or_zero = true}, .example = "8000",
     .meaning = "longest over shortest edge of a block's box; a cut that would leave more is not made; 0: any"},
    {.key = "most_blocks", .members = {in(&SlicingSpec::most_blocks)}, .range = {1, 1e9}, .plausible = {1000, 1e7},
     .example = "100000",
     .meaning = "joints that make more are refused; 2 kB a block"},
    {.key = "order", .members = {one_of(&SlicingSpec::order,
         {{"size", CuttingOrder::by_size}, {"given", CuttingOrder::given},
          {"alternating", CuttingOrder::alternating}})},
     .example = "\"given\"",
     .meaning = "of the cuts: large outlines first and joints of one size set by set in turn; as in the file; or one joint "
         "of every set in turn. But for `given`, boundary joints come first and construction joints last"},
    {.key = "ends", .members = {one_of(&SlicingSpec::ends,
         {{"extended", JointEnds::extended}, {"healed", JointEnds::healed}, {"ignored", JointEnds::ignored}})},
     .example = "\"healed\"",
     .meaning = "extended: a joint cuts right through what it meets; healed: what it parts in part is one body again"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
