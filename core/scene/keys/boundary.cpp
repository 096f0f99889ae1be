// [[stage.boundary]]
#include "core/scene/keys/ranges.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir {

using enum KeyType;
using namespace key_ranges;

// clang-format off
KeyTable boundary_keys() {
  return {"boundary", {
    {.key = "stress", .type = numbers, .unit = "Pa", .range = sane,
     .example = "[50e3, 50e3, 0, 0, 0, 0]", .required = true,
     .meaning = "compression positive, world axes: xx, yy, zz, yz, zx, xy; in 2-D xx, yy, xy. The force on each face keeps "
         "size and direction while the block moves",
     .breaks = "needs blocks or fixed rock to push against"},
  }};
}
// clang-format on

}  // namespace voussoir
