#include "core/solvers/block_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/solvers/block_factors.hpp"

namespace voussoir {
namespace {

// four sums at once, in a fixed order
double product(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  double sum[4] = {0, 0, 0, 0};
  const Eigen::Index whole = x.size() / 4 * 4;
  for (Eigen::Index i = 0; i < whole; i += 4)
    for (int k = 0; k < 4; ++k)
      sum[k] += x[i + k] * y[i + k];
  for (Eigen::Index i = whole; i < x.size(); ++i)
    sum[0] += x[i] * y[i];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

// The least squares of GMRES: the columns of an upper Hessenberg matrix, made triangular by rotations as they come.
struct Rotated {
  std::vector<Eigen::VectorXd> columns;
  std::vector<double> cosine, sine;
  std::vector<double> right;  // the rotated right-hand side; its last number is what is left

  explicit Rotated(double whole) : right{whole} {}

  // false: the column depends on the others
  bool add(Eigen::VectorXd column) {
    const auto last = static_cast<Eigen::Index>(columns.size());
    for (Eigen::Index i = 0; i < last; ++i) {
      const double above = column[i], below = column[i + 1];
      column[i] = cosine[i] * above + sine[i] * below;
      column[i + 1] = cosine[i] * below - sine[i] * above;
    }
    const double length = std::hypot(column[last], column[last + 1]);
    if (!(length > 0) || !std::isfinite(length)) return false;
    cosine.push_back(column[last] / length);
    sine.push_back(column[last + 1] / length);
    column[last] = length;
    right.push_back(-sine.back() * right.back());
    right[last] *= cosine.back();
    columns.push_back(std::move(column));
    return true;
  }

  std::vector<double> solution() const {
    std::vector<double> y(right.begin(), right.end() - 1);
    for (std::size_t j = y.size(); j-- > 0;) {
      y[j] /= columns[j][static_cast<Eigen::Index>(j)];
      for (std::size_t i = 0; i < j; ++i)
        y[i] -= columns[j][static_cast<Eigen::Index>(i)] * y[j];
    }
    return y;
  }
};

// Preconditioned from the right: the residual is the true one. The preconditioned vectors are kept, because factors in
// single precision do not act alike on a sum and on its parts.
template <int Size, class Factors>
LinearAnswer gmres(LinearWork<Size>& work, const Factors& factors, const Eigen::VectorXd& b, double tolerance,
                   int iteration_limit, int threads) {
  const double whole = b.norm();
  LinearAnswer answer{Eigen::VectorXd::Zero(b.size()), 0, 1};
  if (!factors.regular()) return answer.residual = std::numeric_limits<double>::infinity(), answer;
  static thread_local std::vector<Eigen::VectorXd> basis, directions;  // of the Krylov space
  const auto at = [](std::vector<Eigen::VectorXd>& list, int i) -> Eigen::VectorXd& {
    if (i == static_cast<int>(list.size())) list.emplace_back();
    return list[i];
  };
  at(basis, 0) = b / whole;
  Rotated rotated(whole);
  while (answer.iterations < iteration_limit && answer.residual > tolerance) {
    const int known = answer.iterations + 1;
    factors.solve(basis[known - 1], at(directions, known - 1));
    Eigen::VectorXd& next = at(basis, known);
    work.matrix.times(threads, directions[known - 1], next);
    Eigen::VectorXd column(known + 1);
    for (int i = 0; i < known; ++i) {
      column[i] = product(basis[i], next);
      next -= column[i] * basis[i];
    }
    column[known] = next.norm();
    const double length = column[known];
    if (!rotated.add(std::move(column))) break;
    ++answer.iterations;
    answer.residual = std::abs(rotated.right.back()) / whole;
    if (!(length > 0)) break;  // the answer is exact
    next /= length;
  }
  const std::vector<double> y = rotated.solution();
  for (std::size_t i = 0; i < y.size(); ++i)
    answer.x += y[i] * directions[i];
  return answer;
}

}  // namespace

template <int Size>
LinearAnswer solve_blocks(LinearWork<Size>& work, const std::vector<int>& order, const Eigen::VectorXd& b,
                          double tolerance, int iteration_limit, int threads) {
  if (!(b.norm() > 0)) return {Eigen::VectorXd::Zero(b.size()), 0, 0};
  if (const BlockFactors<Size> factors(work.matrix); factors.complete())
    return gmres(work, factors, b, tolerance, iteration_limit, threads);
  work.factors.factorise(work.matrix, order);
  return gmres(work, work.factors, b, tolerance, iteration_limit, threads);
}

template LinearAnswer solve_blocks<3>(LinearWork<3>&, const std::vector<int>&, const Eigen::VectorXd&, double, int,
                                      int);
template LinearAnswer solve_blocks<6>(LinearWork<6>&, const std::vector<int>&, const Eigen::VectorXd&, double, int,
                                      int);

}  // namespace voussoir
