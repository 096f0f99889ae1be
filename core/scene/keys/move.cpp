// [[stage.move]]
#include "core/base/settings.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable move_keys() {
  return {"move", {
    {.key = "translation", .members = {in(&MovePlan::translation)}, .example = "[\"x\"]",
     .meaning = "directions along which the velocity is prescribed; true: all. Along the others the block moves as before"},
    {.key = "factor", .type = tables, .holds = {"record"},
     .meaning = "earthquake records that the blocks follow, instead of velocities: factor = { record = \"file.at2\", … }, or a list of "
         "such tables, one for each component, whose motions are added. The ground rests before a record; after it, it keeps the "
         "velocity of the last value"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
