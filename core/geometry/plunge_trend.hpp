// Plunge and trend of a direction, as geologists state lines.
#pragma once

#include <cmath>
#include <utility>

#include "core/geometry/types.hpp"
#include "text/angle.hpp"

namespace voussoir {

// deg: plunge below the horizontal, trend clockwise from north; in the plane the trend is 90 to the right and 270 to
// the left
template <int Dim>
std::pair<double, double> plunge_and_trend(const Vector<Dim>& v) {
  const double east = v[0], north = Dim == 3 ? v[1] : 0, up = v[Dim - 1];
  const double trend = to_degrees(std::atan2(east, north));
  return {to_degrees(std::atan2(-up, std::hypot(east, north))), trend < 0 ? trend + 360 : trend};
}

}  // namespace voussoir
