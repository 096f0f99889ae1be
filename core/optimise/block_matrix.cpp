#include "core/optimise/block_matrix.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/on_threads.hpp"

namespace voussoir {
namespace {

// unit lower blocks, upper blocks and inverted diagonal blocks, in the places of the matrix's own
template <int Size>
struct IncompleteFactors {
  using Block = typename BlockMatrix<Size>::Block;
  using Segment = Eigen::Matrix<double, Size, 1>;
  const BlockMatrix<Size>& pattern;
  std::vector<Block> blocks;
  bool regular = true;

  explicit IncompleteFactors(const BlockMatrix<Size>& matrix) : pattern(matrix), blocks(matrix.blocks) {
    std::vector<int> place(matrix.rows(), -1);  // of a column in the row at hand
    for (int i = 0; i < matrix.rows(); ++i) {
      for (int p = matrix.first[i]; p < matrix.first[i + 1]; ++p)
        place[matrix.column[p]] = p;
      for (int p = matrix.first[i]; p < matrix.diagonal[i]; ++p) {
        const int k = matrix.column[p];
        const Block lower = blocks[p] * blocks[matrix.diagonal[k]];
        blocks[p] = lower;
        for (int u = matrix.diagonal[k] + 1; u < matrix.first[k + 1]; ++u)
          if (const int to = place[matrix.column[u]]; to >= 0) blocks[to].noalias() -= lower * blocks[u];
      }
      const Eigen::PartialPivLU<Block> pivot(blocks[matrix.diagonal[i]]);
      const auto sizes = pivot.matrixLU().diagonal().cwiseAbs();
      regular = sizes.allFinite() && sizes.minCoeff() > 0;
      if (!regular) return;
      blocks[matrix.diagonal[i]] = pivot.inverse();
      for (int p = matrix.first[i]; p < matrix.first[i + 1]; ++p)
        place[matrix.column[p]] = -1;
    }
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const {
    Eigen::VectorXd x = b;
    for (int i = 0; i < pattern.rows(); ++i) {
      Segment sum = x.segment<Size>(Size * i);
      for (int p = pattern.first[i]; p < pattern.diagonal[i]; ++p)
        sum.noalias() -= blocks[p] * x.segment<Size>(Size * pattern.column[p]);
      x.segment<Size>(Size * i) = sum;
    }
    for (int i = pattern.rows(); i-- > 0;) {
      Segment sum = x.segment<Size>(Size * i);
      for (int p = pattern.diagonal[i] + 1; p < pattern.first[i + 1]; ++p)
        sum.noalias() -= blocks[p] * x.segment<Size>(Size * pattern.column[p]);
      x.segment<Size>(Size * i).noalias() = blocks[pattern.diagonal[i]] * sum;
    }
    return x;
  }
};

}  // namespace

template <int Size>
void BlockMatrix<Size>::assign(int threads, const std::vector<std::vector<Entry>>& rows) {
  const int count = static_cast<int>(rows.size());
  std::vector<std::vector<Entry>> sorted(rows.size());
  each_on_threads(threads, rows.size(), [&](int i) {
    std::vector<Entry> row = rows[i];
    std::stable_sort(row.begin(), row.end(), [](const Entry& x, const Entry& y) { return x.column < y.column; });
    for (const Entry& e : row)
      if (sorted[i].empty() || sorted[i].back().column != e.column)
        sorted[i].push_back(e);
      else
        sorted[i].back().block += e.block;
  });
  first.assign(1, 0);
  column.clear();
  blocks.clear();
  diagonal.assign(count, -1);
  for (int i = 0; i < count; ++i) {
    for (const Entry& e : sorted[i]) {
      if (e.column == i) diagonal[i] = static_cast<int>(column.size());
      column.push_back(e.column);
      blocks.push_back(e.block);
    }
    first.push_back(static_cast<int>(column.size()));
  }
}

template <int Size>
void BlockMatrix<Size>::add_diagonal(const Eigen::VectorXd& more) {
  for (int i = 0; i < rows(); ++i)
    blocks[diagonal[i]].diagonal() += more.segment<Size>(Size * i);
}

template <int Size>
Eigen::VectorXd BlockMatrix<Size>::times(int threads, const Eigen::VectorXd& x) const {
  Eigen::VectorXd y(x.size());
  each_on_threads(threads, diagonal.size(), [&](int i) {
    Eigen::Matrix<double, Size, 1> sum = Eigen::Matrix<double, Size, 1>::Zero();
    for (int p = first[i]; p < first[i + 1]; ++p)
      sum.noalias() += blocks[p] * x.segment<Size>(Size * column[p]);
    y.segment<Size>(Size * i) = sum;
  });
  return y;
}

template <int Size>
LinearAnswer solve_blocks(const BlockMatrix<Size>& matrix, const Eigen::VectorXd& b, double tolerance,
                          int iteration_limit, int threads) {
  const double whole = b.norm();
  LinearAnswer best{Eigen::VectorXd::Zero(b.size()), 0, 1};
  if (!(whole > 0)) return best.residual = 0, best;
  const IncompleteFactors<Size> factors(matrix);
  if (!factors.regular) return best.residual = std::numeric_limits<double>::infinity(), best;
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

#define VOUSSOIR_INSTANTIATE(Size)                                                                             \
  template struct BlockMatrix<Size>;                                                                           \
  template LinearAnswer solve_blocks<Size>(const BlockMatrix<Size>&, const Eigen::VectorXd&, double tolerance, \
                                           int iteration_limit, int threads);
VOUSSOIR_INSTANTIATE(3)
VOUSSOIR_INSTANTIATE(6)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
