#include "core/testing/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace voussoir::oracle {

Eigen::Matrix<Real, Eigen::Dynamic, 1> least_squares(const Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>& rows,
                                                     const Eigen::Matrix<Real, Eigen::Dynamic, 1>& right) {
  return rows.colPivHouseholderQr().solve(right);
}

Eigen::VectorXd solution(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  return matrix.partialPivLu().solve(right);
}

double largest_eigenvalue(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

}  // namespace voussoir::oracle
