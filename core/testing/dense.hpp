// Dense linear algebra for oracles, compiled once: its templates cost more compile time than the tests that use them.
#pragma once

#include <Eigen/Core>

namespace voussoir::oracle {

using Real = long double;

// x that minimises |rows·x - right|, by rank-revealing QR
Eigen::Matrix<Real, Eigen::Dynamic, 1> least_squares(const Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>& rows,
                                                     const Eigen::Matrix<Real, Eigen::Dynamic, 1>& right);

// x of matrix·x = right, by LU with partial pivoting
Eigen::VectorXd solution(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

// of a symmetric matrix
double largest_eigenvalue(const Eigen::MatrixXd& symmetric);

}  // namespace voussoir::oracle
