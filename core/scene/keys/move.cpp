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
    {.key = "times_s", .type = numbers, .unit = "s", .range = {0, 1e9}, .example = "[0, 0.1, 1]",
     .meaning = "times since the stage began, ascending, at which `factors` are given"},
    {.key = "factors", .type = numbers, .range = sane, .example = "[0, 1, 1]",
     .meaning = "what the velocities are multiplied by at `times_s`: linear in between, constant before and after"},
    {.key = "frequency_hz", .unit = "Hz", .range = {0, 1e9, true}, .plausible = {0.01, 500},
     .example = "2",
     .meaning = "the velocities are multiplied by sin(2π frequency_hz t + phase_deg), t since the stage began; times the "
         "factors where both are given",
     .breaks = "needs some twenty steps a period", .mistake = "was the period given?"},
    {.key = "phase_deg", .unit = "deg", .range = {-360, 360}, .plausible = plausible_direction, .default_value = "0",
     .example = "90", .meaning = "of that sine: 90 begins at full velocity", .mistake = angle_mistake},
  }};
}
// clang-format on

}  // namespace voussoir
