// Models in the plane whose equilibrium the implicit static solver finds at any number of blocks.
#pragma once

#include <algorithm>
#include <vector>

#include "core/testing/models.hpp"

namespace voussoir::shapes {

// squares one above the other that cannot rotate
inline Model<2> column_of_squares(int blocks) {
  std::vector<Body<2>> bodies{body_of<2>(box<2>({-0.5, -1}, {1.5, 0}), true)};
  for (int i = 0; i < blocks; ++i) {
    bodies.push_back(body_of<2>(box<2>({0, 1.0 * i}, {1, 1.0 * i + 1})));
    bodies.back().free_rotation.fill(false);
  }
  return model_of<2>(std::move(bodies));
}

// courses of bricks, each half a brick on the next
inline Model<2> brick_wall(int courses) {
  std::vector<Body<2>> bodies{body_of<2>(box<2>({-1, -1}, {courses + 1.0, 0}), true)};
  for (int row = 0; row < courses; ++row) {
    const double low = 0.5 * row, first = row % 2 ? 0.5 : 0;
    if (first > 0) bodies.push_back(body_of<2>(box<2>({0, low}, {first, low + 0.5})));
    for (double x = first; x < courses; ++x)
      bodies.push_back(body_of<2>(box<2>({x, low}, {std::min(x + 1, 1.0 * courses), low + 0.5})));
  }
  Model<2> model = model_of<2>(std::move(bodies));
  model.properties[0].normal_stiffness = 1e10;
  model.properties[0].shear_stiffness = 5e9;
  model.properties[0].sub_contacts = 2;
  return model;
}

}  // namespace voussoir::shapes
