// [[monitors]]
#include "core/scene/keys/ranges.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir {

using enum KeyType;
using namespace key_ranges;

// clang-format off
KeyTable monitor_keys() {
  return {"monitors", {
    {.key = "name", .type = name, .example = "\"wedge\"", .required = true,
     .meaning = "unique among the monitors; begins its columns in history.csv"},
    {.key = "quantities", .type = choices, .example = "[\"displacement\", \"rotation\"]",
     .required = true, .choices = {"displacement", "velocity", "rotation", "angular_velocity", "contact_load",
                                  "contact_force"},
     .meaning = "contact_force: resultant over the contacts of a joint, which `joint` names; the others: of one block that a "
         "selector chooses; contact_load: what all contacts exert on it; velocities are those of half a step before"},
    {.key = "joint", .type = name, .example = "\"A\"",
     .meaning = "joint of contact_force"},
  }};
}
// clang-format on

}  // namespace voussoir
