// The moving bodies of a mechanism: rotation and translation.
#pragma once

#include <optional>
#include <vector>

#include "core/limit/limit.hpp"

namespace voussoir {

struct BlockMotion {
  int body = 0;
  double speed = 0;                 // of its centroid, relative to the mechanism's fastest block (BodyVelocity)
  double turning = 0;               // of its farthest corner about the centroid, same unit
  double rotation_fraction = 0;     // of the block's kinetic energy: I w² / (m v² + I w²)
  std::optional<Vector<2>> centre;  // about which it rotates, m, world coordinates; none: it only translates
};

struct Mechanism {
  std::vector<BlockMotion> moving;  // bodies faster than 1e-6 of the fastest, by id
  double rotation_fraction = 0;     // of the kinetic energy of all of them
  int turning = 0;                  // bodies whose turning exceeds 1e-6 of their motion
};

Mechanism describe_mechanism(const Model<2>& model, const std::vector<BodyVelocity>& velocities);

}  // namespace voussoir
