// [output]
#include "core/base/settings.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable output_keys() {
  return {"output", {
    {.key = "history_interval_s", .members = {in(&OutputPlan::history_interval)}, .unit = "s", .range = {0, 1e9},
     .plausible = {.low = 1e-6, .high = 5, .or_zero = true}, .example = "0.01",
     .meaning = "time between rows of history.csv; 0: about 200 rows per stage", .mistake = "was it given in ms?"},
    {.key = "frame_interval_s", .members = {in(&OutputPlan::frame_interval)}, .unit = "s", .range = {0, 1e9},
     .plausible = {.low = 5e-4, .high = 50, .or_zero = true}, .example = "0.1",
     .meaning = "time between ParaView frames; 0: at the end of each stage only", .mistake = "was it given in ms?"},
    {.key = "frames", .members = {in(&OutputPlan::frames)}, .example = "false",
     .meaning = "write ParaView frames"},
    {.key = "view", .members = {in(&OutputPlan::view)}, .example = "true",
     .meaning = "write view.html, an interactive 3-D page, with the same frames as for ParaView"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
