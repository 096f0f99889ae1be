// The lowest eigenvalues of a symmetric pencil of blocks, K φ = λ M φ, by shift and invert.
#pragma once

#include <vector>

#include "core/solvers/block_matrix.hpp"

namespace voussoir {

// K is symmetric; both blocks of each pair across the diagonal are stored. M is block diagonal, M = B Bᵀ; B may be
// singular: a row of zeros belongs to a degree of freedom without mass, which follows the others, or to a restrained
// one, whose row of K has the diagonal alone.
template <int Size>
struct Pencil {
  using Block = typename BlockMatrix<Size>::Block;
  BlockMatrix<Size> stiffness;
  std::vector<Block> mass_root;  // B, by row

  Eigen::VectorXd times_root(const Eigen::VectorXd& y) const;             // B y
  Eigen::VectorXd times_root_transposed(const Eigen::VectorXd& x) const;  // Bᵀ x
  Eigen::VectorXd times_mass(const Eigen::VectorXd& x) const { return times_root(times_root_transposed(x)); }

  // the number of eigenvalues: degrees of freedom with mass
  int count() const;

  // the largest K_ii / M_ii, rad²/s²: a measure of the stiffest eigenvalue; 0 if nothing has stiffness
  double stiffest() const;
};

struct Eigenpair {
  double value = 0;       // λ, rad²/s²
  Eigen::VectorXd shape;  // φ, φᵀ M φ = 1
};

struct Spectrum {
  std::vector<Eigenpair> pairs;  // ascending
  double shift = 0;              // below all of them
  double resolution = 0;         // an eigenvalue within this of 0 is not told from 0
  int missing = 0;               // that a count by Sylvester's law finds below the last one
  bool converged = true;
  int factorisations = 0;
  long long solutions = 0;  // back-substitutions
};

// The `number` lowest. K - σ M is factorised at a shift σ below all of them: a little below 0, and, until no pivot is
// negative, further down. Lanczos iteration finds the largest of Bᵀ (K - σ M)⁻¹ B, whose eigenvalues are 1/(λ - σ).
// Then the pivots of K - s M, s just above the last one, count those below s: copies of a multiple eigenvalue that the
// iteration missed are sought across the known ones.
template <int Size>
Spectrum lowest_eigenvalues(const Pencil<Size>& pencil, int number);

}  // namespace voussoir
