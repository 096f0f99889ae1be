#include "core/geometry/eigen_pairs.hpp"

#include <Eigen/Eigenvalues>

namespace voussoir {

template <int Dim>
EigenPairs<Dim> eigen_pairs(const Matrix<Dim>& symmetric) {
  // of Eigen's own alignment: the solver of 2 x 2 takes no other
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template EigenPairs<2> eigen_pairs(const Matrix<2>&);
template EigenPairs<3> eigen_pairs(const Matrix<3>&);

}  // namespace voussoir
