// Plane waves through rigid blocks on elastic joints: a chain of equal masses and springs.
#pragma once

#include <vector>

namespace voussoir::reference {

// Spacing a, density ρ, stiffness per area k; n blocks a wavelength and θ = π/n:
//   ω = 2 √(k/m) sin θ, m = ρ a;  c0 = √(k a/ρ);  Z = ρ c0;  c/c0 = sin θ/θ;  group speed c0 cos θ
struct BlockChain {
  double spacing, density, stiffness;

  double speed() const;                           // m/s: c0, of long waves
  double impedance() const;                       // Pa s/m
  double angular_frequency(double blocks) const;  // rad/s, of a wave of so many blocks
  double group_speed(double blocks) const;        // m/s
};

// What ends of a chain send back of a wave of n blocks, in amplitude. A dashpot γ Z on a full block |γ - e^(-iθ)| /
// |γ + e^(iθ)|, on half a block |γ - cos θ|/(γ + cos θ), on a full block through half a joint |1 - γ cos θ|/(1 + γ cos
// θ); γ = 1: tan(π/2n), tan²(π/2n), tan²(π/2n).
double returned_by_full_block(double blocks, double dashpot);
double returned_by_half_block(double blocks, double dashpot);
double returned_through_half_joint(double blocks, double dashpot);

// amplitude of the last block of a free end over that of the wave: 2 cos θ
double free_surface(double blocks);

// amplitude of the block before the half joint over that of the entering wave v_in: 2/(1 + cos θ)
double base_under_wave(double blocks);

// amplitude behind one joint of a stiffness kj = ratio k over that before it: 1/√(1 + ((k/kj - 1) tan θ)²)
double passed_by_joint(double blocks, double ratio);

// Velocity at the surface of a column of square blocks in a grid that repeats sideways, free to turn, under a wave
// that enters upgoing through a quiet base behind half a joint: leapfrog of horizontal motion and turn of each block,
// steps of `step`; after each step. Side a, normal and shear stiffness kn and ks per area, density ρ.
//   joint between blocks j and j + 1: slip u_(j+1) - u_j + (a/2)(θ_(j+1) + θ_j) on ks a, turn θ_(j+1) - θ_j on kn a³/12
//   joints at the sides: slip a θ of one block against its neighbour, on ks a each
struct SquareGrid {
  double side, density, normal_stiffness, shear_stiffness;
  int blocks;

  double shear_speed() const;  // √(ks a/(2ρ))
};
std::vector<double> surface_of_column(const SquareGrid& grid, const std::vector<double>& upgoing, double step);

}  // namespace voussoir::reference
