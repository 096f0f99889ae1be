#include "core/geometry/half_space.hpp"

#include <cmath>

namespace voussoir {

Vector<3> upward_normal_3d(double dip, double dip_direction) {
  return {std::sin(dip) * std::sin(dip_direction), std::sin(dip) * std::cos(dip_direction), std::cos(dip)};
}

Vector<2> upward_normal_2d(double dip, double dip_direction) {
  return {std::sin(dip_direction) < 0 ? -std::sin(dip) : std::sin(dip), std::cos(dip)};
}

}  // namespace voussoir
