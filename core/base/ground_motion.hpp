// A motion of the ground that was recorded: values at equal intervals, and those that follow by integration.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace voussoir {

// what the values of a record are; the quantity is linear between them
enum class MotionQuantity { acceleration, velocity, displacement };

// Made by core/load/ground_motion.hpp. The ground rests before the first value. After the last one its acceleration is
// zero, or, if displacements were recorded, its velocity.
struct GroundMotion {
  std::string name;  // of its file
  MotionQuantity quantity = MotionQuantity::acceleration;
  double interval = 0;  // s, between values
  double begins = 0;    // s, time of the first value since the stage began

  // at the values, corrected; as many entries as values, or none if they do not follow from the quantity
  std::vector<double> acceleration;  // m/s², if accelerations were recorded
  std::vector<double> velocity;      // m/s, unless displacements were recorded
  std::vector<double> displacement;  // m, from the first value on

  // before the correction of the baseline
  double stated_end_velocity = 0, stated_end_displacement = 0;  // m/s, m
  double taken_off = 0;    // largest magnitude of what the correction took off, in the unit of the quantity
  double stated_peak = 0;  // of the quantity

  double duration() const { return interval * static_cast<double>(displacement.size() - 1); }  // s
};

// a record along a direction
struct RecordedMotion {
  std::vector<double> direction;  // unit vector, as many entries as dimensions
  std::shared_ptr<const GroundMotion> motion;
};

}  // namespace voussoir
