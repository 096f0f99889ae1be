// Natural frequencies of blocks on elastic joints, at small motions, from matrices written out by hand.
#pragma once

#include <vector>

namespace voussoir::reference {

// Blocks on a fixed base, one upon the other, each joint a spring k along the axis: n equal masses m,
//   ω_j = 2 √(k/m) sin((2j - 1) π / (2 (2n + 1))),   j = 1 … n.
// Over √(k/m).
double axial_mode(int blocks, int j);

// A block of a density, width b and height H, 1 m thick, on a joint of normal and shear stiffness kn and ks, Pa/m, with
// a fixed base under gravity g. Sway x of the centroid and rocking θ:
//   K = [ ks A,    ks A a               ]    M = diag(m, J), J = m (b² + H²)/12, I = b³/12,
//       [ ks A a,  ks A a² + kn I - W H/2 ]
// a: the height of the centroid over the joint, H/2; less half of the joint's closure W/(kn A) if the shear acts in the
// middle of an overlap that only the block's weight makes.
struct SwayingBlock {
  double width, height, density, normal_stiffness, shear_stiffness, gravity;
};
struct SwayModes {
  double vertical;      // ω², rad²/s²
  double lower, upper;  // ω² of sway and rocking; the lower one is negative if the block rocks over
};
SwayModes sway_modes(const SwayingBlock& block, bool middle_of_overlap);

// Pa/m: the normal stiffness below which the block rocks over, W H/(2 I)
double least_normal_stiffness(const SwayingBlock& block);

// ω of a stack of equal blocks on a fixed base, without the effect of gravity, ascending, rad/s: sway v_j and rotation
// θ_j of each; joint j has the slip v_j - v_(j-1) + (H/2)(θ_j + θ_(j-1)) against ks A and the turn θ_j - θ_(j-1)
// against kn I. The lowest `count` of 2n.
std::vector<double> bending_modes(const SwayingBlock& block, int blocks, int count);

}  // namespace voussoir::reference
