// Dip and dip direction of an upward normal, as tables and reports state them.
#pragma once

#include <cmath>

#include "core/geometry/types.hpp"
#include "text/angle.hpp"

namespace voussoir {

struct DipAndDirection {
  double dip, direction;  // deg
};

inline DipAndDirection angles_of(const Vector<3>& n) {
  const double direction = std::atan2(n[0], n[1]) / degree;
  const double around = direction < 0 ? direction + 360 : direction;
  return {std::atan2(std::hypot(n[0], n[1]), n[2]) / degree, around < 360 ? around : 0};  // a rounded sum may be 360
}

inline DipAndDirection angles_of(const Vector<2>& n) {
  return {std::atan2(std::abs(n[0]), n[1]) / degree, n[0] < 0 ? 270.0 : 90.0};
}

}  // namespace voussoir
