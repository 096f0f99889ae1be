// What tables that choose blocks have in common: name, choice, restraint, velocity.
#include "core/scene/keys/ranges.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir {

using enum KeyType;
using namespace key_ranges;

// clang-format off
KeyTable label_keys() {
  return {"label", {
    {.key = "name", .type = name, .example = "\"base\"",
     .meaning = "so that --set can address this table by name; otherwise by its number, from 1"},
  }};
}

KeyTable selector_keys() {
  return {"selector", {
    {.key = "all", .type = boolean, .default_value = "false", .example = "true",
     .meaning = "every block"},
    {.key = "bodies", .type = names, .example = "[\"slider\"]",
     .meaning = "blocks of these names"},
    {.key = "above", .type = names, .example = "[\"A\", \"B\"]",
     .meaning = "blocks whose centroid lies above all these joints (on the side of the upward normal; to the side it "
         "dips to where the joint is vertical)"},
    {.key = "below", .type = names, .example = "[\"A\"]",
     .meaning = "blocks whose centroid lies below all these joints"},
    {.key = "inside", .type = vector, .unit = "m", .range = sane, .example = "[0.5, 0.5, -1]",
     .meaning = "the block that holds this point"},
  }};
}

KeyTable restrain_keys() {
  return {"restrain", {
    {.key = "translation", .type = axes, .example = "[\"x\", \"y\"]",
     .meaning = "directions without movement; true: all"},
    {.key = "rotation", .type = axes, .example = "true",
     .meaning = "axes without rotation; true: all (2-D: only true)"},
  }};
}

KeyTable motion_keys() {
  return {"motion", {
    {.key = "velocity", .type = vector, .unit = "m/s", .range = sane, .plausible = plausible_speed,
     .example = "[0, 0, -1]",
     .meaning = "velocity of the centroid"},
    {.key = "angular_velocity", .type = spin, .unit = "rad/s", .range = sane,
     .plausible = plausible_speed, .example = "[0, 0, 1]",
     .meaning = "world axes; in 2-D one number, counter-clockwise"},
  }};
}
// clang-format on

}  // namespace voussoir
