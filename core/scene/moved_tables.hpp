// Tables of a scene that state blocks, joints or bolts, displaced and rotated: the copies of [[repeat]].
#pragma once

#include <string>

#include "core/geometry/types.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// x -> about + turn (x - about) + shift, in the file's coordinates
template <int Dim>
struct RigidMove {
  bool turns = false;
  Matrix<Dim> turn = Matrix<Dim>::Identity();
  double degrees = 0;                                                    // 2-D: of the rotation, counter-clockwise
  Vector<Dim> about = Vector<Dim>::Zero(), shift = Vector<Dim>::Zero();  // m

  Vector<Dim> operator()(const Vector<Dim>& point) const;
};

// From the stated one to the copy after `times` steps. Rotations by multiples of 90 degrees are exact.
template <int Dim>
RigidMove<Dim> move_of(const CopiesSpec& spec, int times);

// Each moves the positions, directions and velocities of a checked table. Throws SceneError if the keys of the table
// cannot describe the result; `path` is the table's address.
template <int Dim>
void move_block(Node& block, const RigidMove<Dim>& move);
template <int Dim>
void move_joint(Node& joint, const std::string& path, const RigidMove<Dim>& move);
template <int Dim>
void move_bolt(Node& bolt, const RigidMove<Dim>& move);

}  // namespace voussoir
