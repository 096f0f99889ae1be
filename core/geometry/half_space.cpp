#include "core/geometry/half_space.hpp"

#include <cmath>

namespace voussoir {

template <int Dim>
bool lies_inside(const HalfSpaces<Dim>& region, const Vector<Dim>& point) {
  for (const HalfSpace<Dim>& face : region)
    if (!(face.normal.dot(point) - face.offset < 0)) return false;
  return true;
}

template <int Dim>
HalfSpace<Dim> moved_origin(const HalfSpace<Dim>& plane, const Vector<Dim>& shift) {
  return {plane.normal, plane.offset - plane.normal.dot(shift)};
}

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

template bool lies_inside<2>(const HalfSpaces<2>&, const Vector<2>&);
template bool lies_inside<3>(const HalfSpaces<3>&, const Vector<3>&);
template HalfSpace<2> moved_origin<2>(const HalfSpace<2>&, const Vector<2>&);
template HalfSpace<3> moved_origin<3>(const HalfSpace<3>&, const Vector<3>&);

}  // namespace voussoir
