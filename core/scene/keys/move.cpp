// [[stage.move]]
#include "core/scene/keys/ranges.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir {

using enum KeyType;
using namespace key_ranges;

// clang-format off
KeyTable move_keys() {
  return {"move", {
    {.key = "translation", .type = axes, .default_value = "true", .example = "[\"x\"]",
     .meaning = "directions along which the velocity is prescribed; true: all. Along the others the block is as free as "
         "without it"},
  }};
}
// clang-format on

}  // namespace voussoir
