// Angles are radians in the code and degrees in files, messages and figures: 30 * degree is an angle, to_degrees(angle)
// the number that people read.
#pragma once

#include <numbers>

namespace voussoir {

inline constexpr double degree = std::numbers::pi / 180;  // rad

constexpr double to_degrees(double radians) {
  return radians * (180 / std::numbers::pi);
}

}  // namespace voussoir
