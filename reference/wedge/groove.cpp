#include "reference/wedge/groove.hpp"

#include <cmath>

namespace voussoir::reference {

double sliding_friction(const Groove& groove) {
  return std::atan(std::sin(groove.half_angle) * std::tan(groove.plunge));
}

double least_groove_friction(const Groove& groove) {
  const double slope = std::tan(groove.plunge);
  return std::atan(std::sin(groove.half_angle) * slope / std::hypot(1, slope * std::cos(groove.half_angle)));
}

}  // namespace voussoir::reference
