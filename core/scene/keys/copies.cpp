// [[repeat]]
#include "core/scene/keys/tables.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable copies_keys() {
  return {"copies", {
    {.key = "blocks", .members = {in(&CopiesSpec::blocks)}, .example = "[\"stone\"]",
     .meaning = "blocks that are repeated: stone-1, where it is stated, stone-2, …; a table of [[blocks]] of such a name "
         "changes that copy. Parts of a repeated body (part_of) are listed beside it. A later [[repeat]] that names the "
         "stone repeats all its copies: stone-1-1, stone-2-1, …"},
    {.key = "joints", .members = {in(&CopiesSpec::joints)}, .example = "[\"A\"]",
     .meaning = "joints that are repeated, as blocks are. Its subdomain (within) and what it ends at (ends_at) stay where "
         "they are, but a joint that is repeated beside it goes along"},
    {.key = "bolts", .members = {in(&CopiesSpec::bolts)}, .example = "[\"roof\"]",
     .meaning = "bolts that are repeated, as blocks are; each copy is installed by its own name"},
    {.key = "count", .members = {in(&CopiesSpec::count)}, .range = {2, 10000}, .plausible = {2, 2000}, .example = "15",
     .required = true, .no_default = true, .meaning = "of all, with the one that is stated"},
    {.key = "shift", .members = {in(&CopiesSpec::shift)}, .unit = "m", .range = sane, .example = "[0.5, 0, 0]",
     .meaning = "from each copy to the next; none without it"},
    {.key = "turn_deg", .members = {in(&CopiesSpec::turn)}, .unit = "deg", .range = {-360, 360},
     .example = "12", .no_default = true,
     .meaning = "from each copy to the next, counter-clockwise, in 3-D as seen against the axis; copy k is turned k - 1 times "
         "as far, then shifted k - 1 times as far; no turn without it. Velocities that a block states turn with it"},
    {.key = "about", .members = {in(&CopiesSpec::about)}, .unit = "m", .range = sane, .example = "[0, 0, 0]",
     .meaning = "a point of the axis; needed where turn_deg is stated"},
    {.key = "axis", .members = {in(&CopiesSpec::axis)}, .range = sane, .example = "[0, 1, 0]",
     .meaning = "its direction, of any length; in 3-D only, and needed there where turn_deg is stated"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
