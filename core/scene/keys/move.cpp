// [[stage.move]]
#include "core/base/settings.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable move_keys() {
  return {"move", {
    {.key = "translation", .members = {in(&MovePlan::translation)}, .example = "[\"x\"]",
     .meaning = "directions along which the velocity is prescribed; true: all. Along the others the block moves as before"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
