// [[repeat]]
#include "core/scene/keys/tables.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable copies_keys() {
  return {"copies", {
    {.key = "blocks", .members = {in(&CopiesSpec::blocks)}, .example = "[\"stone\"]",
     .meaning = "blocks to repeat: stone-1, the stated one, stone-2, …; a [[blocks]] table of such a name changes that copy. Parts of a "
         "repeated body (part_of) are listed with it. A later [[repeat]] that names the stone repeats all its copies: stone-1-1, "
         "stone-2-1, …"},
    {.key = "joints", .members = {in(&CopiesSpec::joints)}, .example = "[\"A\"]",
     .meaning = "joints to repeat, like blocks. The subdomain (within) and the joints at which it ends (ends_at) stay in place, except "
         "joints of the same list, which are repeated with it"},
    {.key = "bolts", .members = {in(&CopiesSpec::bolts)}, .example = "[\"roof\"]",
     .meaning = "bolts to repeat, like blocks; each copy is installed by its own name"},
    {.key = "count", .members = {in(&CopiesSpec::count)}, .range = {2, 10000}, .plausible = {2, 2000}, .example = "15",
     .required = true, .no_default = true, .meaning = "number of copies, including the one that is stated"},
    {.key = "shift", .members = {in(&CopiesSpec::shift)}, .unit = "m", .range = sane, .example = "[0.5, 0, 0]",
     .meaning = "displacement from each copy to the next; none without it"},
    {.key = "turn_deg", .members = {in(&CopiesSpec::turn)}, .unit = "deg", .range = {-360, 360},
     .example = "12", .no_default = true,
     .meaning = "rotation from each copy to the next, counter-clockwise, in 3-D seen against the axis; copy k is turned k - 1 times, then "
         "shifted k - 1 times; none without it. A block's stated velocities turn with it"},
    {.key = "about", .members = {in(&CopiesSpec::about)}, .unit = "m", .range = sane, .example = "[0, 0, 0]",
     .meaning = "a point of the axis; required if turn_deg is stated"},
    {.key = "axis", .members = {in(&CopiesSpec::axis)}, .range = sane, .example = "[0, 1, 0]",
     .meaning = "direction of the axis, of any length; in 3-D only, and required there if turn_deg is stated"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
