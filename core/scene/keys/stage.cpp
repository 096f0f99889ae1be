// [[stage]]: its name and kind.
#include "core/base/settings.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable stage_keys() {
  return {"stage", {
    {.key = "name", .members = {in(&StagePlan::name, name)}, .example = "\"settle\"", .required = true,
     .meaning = "unique among the stages"},
    {.key = "kind", .members = {alternative(&StagePlan::plan, {"settle", "run", "reduce"})}, .example = "\"settle\"",
     .required = true,
     .meaning = "settle: until equilibrium; run: true motion for a given time; reduce: strength is reduced until the model fails"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
