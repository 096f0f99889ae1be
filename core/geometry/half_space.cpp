#include "core/geometry/half_space.hpp"

#include <cmath>

namespace voussoir {

double squared_length(const std::vector<double>& normal) {
  double square = 0;
  for (const double x : normal)
    square += x * x;
  return square;
}

bool is_unit(double squared_length) {
  constexpr double within = 1e-6;  // of the length
  return std::abs(squared_length - 1) <= 2 * within;
}

// minus the normal of Eqs 3.3-3.5, which points down, in axes x east, y north, z up instead of x north, y east, z down
Vector<3> upward_normal_3d(double dip, double dip_direction) {
  return {std::sin(dip) * std::sin(dip_direction), std::sin(dip) * std::cos(dip_direction), std::cos(dip)};
}

Vector<2> upward_normal_2d(double dip, double dip_direction) {
  return {std::sin(dip_direction) < 0 ? -std::sin(dip) : std::sin(dip), std::cos(dip)};
}

}  // namespace voussoir
