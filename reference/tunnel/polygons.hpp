// Points and polygons of a network.
#pragma once

#include <array>
#include <vector>

namespace voussoir::reference::network {

using Point = std::array<double, 2>;  // m, or N for a force
using Polygon = std::vector<Point>;   // convex, counter-clockwise, m

inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1];
}
inline double cross(const Point& a, const Point& b) {
  return a[0] * b[1] - a[1] * b[0];
}
inline Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1]};
}

inline Polygon box(double left, double bottom, double right, double top) {
  return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}

}  // namespace voussoir::reference::network
