// [accuracy]
#include "core/accuracy.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable accuracy_keys() {
  return {"accuracy", {
    {.key = "level", .type = choice, .example = "\"balanced\"", .required = true,
     .choices = {accuracy_levels.begin(), accuracy_levels.end()},
     .meaning = "sets what the scene leaves out, tolerances, ramps, rest and "
         "time step, as the cases' studies found it for an error of 5 %, 1 % or 0.1 %, of critical angles from 15 deg on"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
