// Linear systems of blocks: BiCGStab (van der Vorst 1992), preconditioned by the matrix's factors (block_factors.hpp).
#pragma once

#include "core/solvers/block_matrix.hpp"

namespace voussoir {

struct LinearAnswer {
  Eigen::VectorXd x;
  int iterations = 0;
  double residual = 0;  // |b - A x| / |b|; infinite when a pivot block is singular
};

// Solves A x = b until |b - A x| <= tolerance |b|, or returns the best x found within the limit.
template <int Size>
LinearAnswer solve_blocks(const BlockMatrix<Size>& matrix, const Eigen::VectorXd& b, double tolerance,
                          int iteration_limit, int threads);

}  // namespace voussoir
