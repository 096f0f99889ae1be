// Linear systems of blocks: flexible GMRES without restart (Saad 1993), preconditioned by the matrix's factors,
// complete where they fill in little (block_factors.hpp), else incomplete (incomplete_factors.hpp).
#pragma once

#include "core/solvers/linear_work.hpp"

namespace voussoir {

struct LinearAnswer {
  Eigen::VectorXd x;
  int iterations = 0;   // products with the matrix
  double residual = 0;  // |b - A x| / |b|; infinite when a pivot block is singular
};

// Solves A x = b until |b - A x| <= tolerance |b|, or returns the best x found within the limit. `order`: the rows in
// the order in which incomplete factors eliminate them; the fewer iterations, the better it follows how the blocks rest
// on one another.
template <int Size>
LinearAnswer solve_blocks(LinearWork<Size>& work, const std::vector<int>& order, const Eigen::VectorXd& b,
                          double tolerance, int iteration_limit, int threads);

}  // namespace voussoir
