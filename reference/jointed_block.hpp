#pragma once

#include <array>
#include <vector>

// One rigid block that translates on a few plane joints, elastic and perfectly plastic: sigma = kn <overlap>, tau +=
// -ks slip, |tau| <= sigma tan(friction), radial return, no dilation. Small displacements: the planes keep their
// places.
namespace voussoir::reference {

using Vector3 = std::array<double, 3>;

constexpr int most_block_joints = 3;

struct BlockJoint {
  Vector3 normal{};                                  // unit, into the block
  double normal_stiffness = 0, shear_stiffness = 0;  // N/m, areas included
  double initial_normal = 0;                         // N, compression, before the block has moved
};

struct BlockState {
  Vector3 displacement{};                          // m
  std::array<Vector3, most_block_joints> shear{};  // N on the block
  std::array<double, most_block_joints> normal{};  // N, compression
};

// The equilibrium next to `state` under a load on the block and the joints' friction, found by Newton with the
// consistent (unsymmetric) tangent; false, and `state` unchanged, if there is none near. `size` is the reference force
// for the out-of-balance force, `settlement` a displacement of the order of the elastic one. At most
// `most_block_joints` joints, with as many tangents of friction angles.
bool equilibrate(const std::vector<BlockJoint>& joints, const std::array<double, most_block_joints>& tan_friction,
                 const Vector3& load, double size, double settlement, BlockState& state);

}  // namespace voussoir::reference
