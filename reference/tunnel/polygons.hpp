// Points and polygons of a network, for its sources and its tests.
#pragma once

#include <vector>

#include "reference/tunnel/network.hpp"

namespace voussoir::reference::network {

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

// every piece a block
inline std::vector<Block> one_each(const std::vector<Polygon>& pieces) {
  std::vector<Block> blocks;
  for (const Polygon& piece : pieces)
    blocks.push_back({{piece}});
  return blocks;
}

}  // namespace voussoir::reference::network
