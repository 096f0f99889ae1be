// The numbers of a scene that may move its answer: which keys, in which unit they are shown, how they are set.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/scene/node.hpp"

namespace voussoir {

// What sets the size of a step: a turn, a length beside that of the blocks, or a share of the value.
enum class KeyScale { angle, length, share };

struct MovingKey {
  std::string key;         // as after --set, with a part of it in words: "joints.A.point along its normal"
  std::string unit;        // of its value, as the scene states it
  double value = 0;        // of the scene
  double shown = 1;        // the shown unit, in the key's unit
  std::string shown_unit;  // "10 kPa"
  double usual = 1;        // change that is usual, in the key's unit
  KeyScale scale = KeyScale::share;
  double below = std::numeric_limits<double>::infinity();  // how far it may go down from its value, and up
  double above = std::numeric_limits<double>::infinity();
  std::function<std::vector<std::string>(double distance)> overrides{};  // as after --set
};

// stiffnesses of joints move runs alone
enum class MovedAnswer { of_rigid_blocks, run };

// All keys of the table of app/derivatives/moving_keys.cpp that the tree states, in the table's order. `tree` is a
// scene's effective tree (Scene::tree). Joints whose plane is given by its normal, and planes that dip 0 without a
// direction, have no dip and direction here.
std::vector<MovingKey> moving_keys(const Node& tree, MovedAnswer of = MovedAnswer::of_rigid_blocks);

}  // namespace voussoir
