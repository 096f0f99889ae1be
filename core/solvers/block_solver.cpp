#include "core/solvers/block_solver.hpp"

#include <cmath>
#include <limits>

#include "core/solvers/block_factors.hpp"

namespace voussoir {

template <int Size>
LinearAnswer solve_blocks(const BlockMatrix<Size>& matrix, const Eigen::VectorXd& b, double tolerance,
                          int iteration_limit, int threads) {
  const double whole = b.norm();
  LinearAnswer best{Eigen::VectorXd::Zero(b.size()), 0, 1};
  if (!(whole > 0)) return best.residual = 0, best;
  const BlockFactors<Size> factors(matrix);
  if (!factors.regular()) return best.residual = std::numeric_limits<double>::infinity(), best;
  // preconditioned from the right: the residual is the true one
  Eigen::VectorXd x = best.x, r = b, p = b, v;
  const Eigen::VectorXd shadow = b;
  double rho = shadow.dot(r), alpha = 1, omega = 1;
  while (best.iterations < iteration_limit && best.residual > tolerance) {
    const Eigen::VectorXd to_p = factors.solve(p);
    v = matrix.times(threads, to_p);
    const double along = shadow.dot(v);
    if (along == 0 || !std::isfinite(along)) return best;
    alpha = rho / along;
    const Eigen::VectorXd s = r - alpha * v, to_s = factors.solve(s), t = matrix.times(threads, to_s);
    const double square = t.squaredNorm();
    omega = square > 0 ? t.dot(s) / square : 0;
    x += alpha * to_p + omega * to_s;
    r = s - omega * t;
    ++best.iterations;
    const double left = r.norm() / whole;
    if (!std::isfinite(left)) return best;
    if (left < best.residual) {
      best.residual = left;
      best.x = x;
    }
    const double next = shadow.dot(r);
    if (omega == 0 || next == 0) return best;
    p = r + next / rho * (alpha / omega) * (p - omega * v);
    rho = next;
  }
  return best;
}

template LinearAnswer solve_blocks<3>(const BlockMatrix<3>&, const Eigen::VectorXd&, double, int, int);
template LinearAnswer solve_blocks<6>(const BlockMatrix<6>&, const Eigen::VectorXd&, double, int, int);

}  // namespace voussoir
