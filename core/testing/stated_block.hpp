// A block for block theory from stated faces, without a model.
#pragma once

#include <cmath>
#include <vector>

#include "core/key_blocks/assembly.hpp"
#include "text/angle.hpp"

namespace voussoir {

// the upward normal, degrees
inline Vector<3> above(double dip, double dip_direction) {
  return upward_normal_3d(dip * degree, dip_direction * degree);
}

struct StatedFace {
  Vector<3> normal;      // into the block
  double area = 1;       // m²
  double friction = 30;  // deg
  double cohesion = 0;   // Pa
};

// under its weight (N); most of its surface is free
inline Block<3> block_of(const std::vector<StatedFace>& faces, double weight) {
  Block<3> block;
  for (const StatedFace& stated : faces) {
    RockFace<3> face;
    face.normal = stated.normal;
    face.joint = static_cast<int>(block.faces.size());
    face.area = stated.area;
    face.tan_friction = std::tan(stated.friction * degree);
    face.cohesion = stated.area * stated.cohesion;
    block.faces.push_back(face);
    block.normals.push_back(face.normal);
    block.contact_area += face.area;
  }
  block.surface = 2 * block.contact_area + 1;
  block.volume = 1;
  block.weight = weight;
  block.stated.force = {0, 0, -weight};
  return block;
}

}  // namespace voussoir
