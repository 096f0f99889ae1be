// Keys that tables which choose blocks have in common: name, choice, restraint, velocity.
#include "core/scene/keys/tables.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable label_keys() {
  return {"label", {
    {.key = "name", .type = name, .example = "\"base\"",
     .meaning = "name by which --set can address this table; without it by its number, from 1"},
  }};
}

KeyTable selector_keys() {
  return {"selector", {
    {.key = "all", .members = {in(&Selector::all)}, .example = "true", .meaning = "every block"},
    {.key = "bodies", .members = {in(&Selector::names)}, .example = "[\"slider\"]",
     .meaning = "blocks of these names"},
    {.key = "above", .members = {in(&Selector::above)}, .example = "[\"A\", \"B\"]",
     .meaning = "blocks whose centroid is above all these joints (on the side of the upward normal; if the joint is vertical, on the side "
         "to which it dips)"},
    {.key = "below", .members = {in(&Selector::below)}, .example = "[\"A\"]",
     .meaning = "blocks whose centroid is below all these joints"},
    {.key = "inside", .members = {in(&Selector::inside)}, .unit = "m", .range = sane, .example = "[0.5, 0.5, -1]",
     .meaning = "the block that contains this point"},
    {.key = "side", .members = {in(&Selector::sides)}, .example = "[\"bottom\"]",
     .meaning = "blocks with a face that no joint made on one of these outermost sides of the model: left, right, bottom or top; in 3-D "
         "west, east, "
         "south, north, bottom or top"},
    {.key = "box", .type = table, .holds = {"box"}, .meaning = "blocks whose centroid is in this box"},
  }};
}

KeyTable restrain_keys() {
  return {"restrain", {
    {.key = "translation", .members = {in(&RestrainSpec::translation)}, .example = "[\"x\", \"y\"]",
     .meaning = "directions without movement; true: all"},
    {.key = "rotation", .members = {in(&RestrainSpec::rotation)}, .example = "true",
     .meaning = "axes without rotation; true: all (2-D: only true)"},
  }};
}

KeyTable motion_keys() {
  return {"motion", {
    {.key = "velocity", .members = {in(&MotionSpec::velocity)}, .unit = "m/s", .range = sane,
     .plausible = plausible_speed, .example = "[0, 0, -1]",
     .meaning = "velocity of the centroid"},
    {.key = "angular_velocity", .members = {in(&MotionSpec::angular_velocity, spin)}, .unit = "rad/s", .range = sane,
     .plausible = plausible_speed, .example = "[0, 0, 1]",
     .meaning = "world axes; in 2-D one number, counter-clockwise"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
