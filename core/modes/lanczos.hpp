// The largest eigenvalues of a symmetric operator: implicitly restarted Lanczos iteration by Spectra, whose headers
// only this interface's source includes.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace voussoir {

// y = A x of a symmetric A, both of this length
struct SymmetricOperator {
  Eigen::Index size = 0;
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> apply;
};

struct LargestEigenvalues {
  std::vector<double> values;            // descending
  std::vector<Eigen::VectorXd> vectors;  // orthonormal
  bool converged = true;                 // else fewer than were asked for
  long long products = 0;                // with the operator
};

// The `count` largest, 1 <= count <= size, each to `tolerance` of itself. `start`, from 1, chooses one of fixed start
// vectors. The same bits for the same operator, in every program: no instantiation of Eigen is shared with other code.
// Of a multiple eigenvalue some vectors may be missing, as the iteration starts from one vector. An operator that is
// nought has no values.
LargestEigenvalues largest_eigenvalues(const SymmetricOperator& a, int count, int start, double tolerance);

}  // namespace voussoir
