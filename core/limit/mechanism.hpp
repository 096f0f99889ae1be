// The moving bodies of a mechanism: rotation and translation.
#pragma once

#include <optional>
#include <vector>

#include "core/limit/corner_cones.hpp"

namespace voussoir {

template <int Dim>
struct BlockMotion {
  int body = 0;
  double speed = 0;                   // of its centroid, relative to the mechanism's fastest block (BodyVelocity)
  double turning = 0;                 // of its farthest corner about the centroid, same unit
  double rotation_fraction = 0;       // of the block's kinetic energy: w·I w / (m v² + w·I w)
  std::optional<Vector<Dim>> centre;  // in the plane, about which it rotates, m, world; none: it only translates
};

template <int Dim>
struct Mechanism {
  std::vector<BlockMotion<Dim>> moving;  // bodies faster than 1e-6 of the fastest, by id
  double rotation_fraction = 0;          // of the kinetic energy of all of them
  int turning = 0;                       // bodies whose turning exceeds 1e-6 of their motion
};

template <int Dim>
Mechanism<Dim> describe_mechanism(const Model<Dim>& model, const std::vector<BodyVelocity<Dim>>& velocities);

}  // namespace voussoir
