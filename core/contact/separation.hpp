// The gap between two parts at a plane.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contact/pair.hpp"

namespace voussoir {

// rounding of a vertex's projection on an axis, as a fraction of the coordinates: two rotations and a sum
inline constexpr double projection_rounding = 8 * std::numeric_limits<double>::epsilon();

// no point of the part is beyond this along the axis
template <int Dim>
double support(const Polytope<Dim>& part, const Vector<Dim>& axis) {
  double most = -std::numeric_limits<double>::max();
  for (const Vector<Dim>& v : part.vertices)
    most = std::max(most, v.dot(axis));
  return most + part.vertex_error + projection_rounding * part.radius;
}

// The gap of the second part behind a plane of the first's frame, m, rounding included: a lower bound of the distance
// between parts if no point of the first is beyond `support_a` along `axis`.
template <int Dim>
double gap_behind(const Pair<Dim>& pair, const Vector<Dim>& axis, double support_a) {
  const Polytope<Dim>& b = *pair.b;
  const Vector<Dim> seen = pair.rotation.transpose() * axis;
  double least = std::numeric_limits<double>::max();
  for (const Vector<Dim>& v : b.vertices)
    least = std::min(least, v.dot(seen));
  const double distance = pair.offset.dot(axis);
  return (least + distance - support_a) - b.vertex_error -
         projection_rounding * (b.radius + std::abs(distance) + pair.offset.norm() + std::abs(support_a));
}

}  // namespace voussoir
