#include "core/geometry/eigen_pairs.hpp"

#include <Eigen/Eigenvalues>

namespace voussoir {

template <int Dim>
EigenPairs<Dim> eigen_pairs(const Matrix<Dim>& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Matrix<Dim>> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template EigenPairs<2> eigen_pairs(const Matrix<2>&);
template EigenPairs<3> eigen_pairs(const Matrix<3>&);

}  // namespace voussoir
