#include "core/solvers/block_factors.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/solvers/elimination.hpp"

namespace voussoir {
namespace {

// Factors are complete if they cost no more than so many iterations with incomplete ones, which grow as the root of
// the rows in the plane: walls of 1,000 bricks take 40 near equilibrium, of 10,000 more than 200.
constexpr double a_root_of_rows = 2.5;

// An iteration multiplies every block by a vector four times: twice those of the matrix, twice those of the factors.
constexpr double products_an_iteration = 4;

// The matrix in this order, with places for all blocks that the elimination fills in.
template <int Size>
BlockMatrix<Size> filled(const BlockMatrix<Size>& matrix, const std::vector<int>& order, const Neighbours& lower) {
  const int count = matrix.rows();
  Neighbours upper(count);
  for (int i = 0; i < count; ++i)
    for (const int k : lower[i])
      upper[k].push_back(i);
  BlockMatrix<Size> all;
  all.first.assign(1, 0);
  for (int i = 0; i < count; ++i) {
    all.column.insert(all.column.end(), lower[i].begin(), lower[i].end());
    all.diagonal.push_back(static_cast<int>(all.column.size()));
    all.column.push_back(i);
    all.column.insert(all.column.end(), upper[i].begin(), upper[i].end());
    all.first.push_back(static_cast<int>(all.column.size()));
  }
  all.blocks.assign(all.column.size(), BlockMatrix<Size>::Block::Zero());
  std::vector<int> place(count), at(count);
  for (int i = 0; i < count; ++i)
    place[order[i]] = i;
  for (int i = 0; i < count; ++i) {
    for (int p = all.first[i]; p < all.first[i + 1]; ++p)
      at[all.column[p]] = p;
    for (int p = matrix.first[order[i]]; p < matrix.first[order[i] + 1]; ++p)
      all.blocks[at[place[matrix.column[p]]]] = matrix.blocks[p];
  }
  return all;
}

}  // namespace

template <int Size>
BlockFactors<Size>::BlockFactors(const BlockMatrix<Size>& matrix) {
  const double iterations = a_root_of_rows * std::sqrt(matrix.rows());
  const Neighbours rows = neighbours_in(matrix);
  order = minimum_degree(rows);
  const Neighbours lower =
      lower_pattern(rows, order, iterations * products_an_iteration / Size * static_cast<double>(matrix.blocks.size()));
  if (lower.empty()) {
    order.clear();
    return;
  }
  factors = filled(matrix, order, lower);
  factorise();
}

template <int Size>
void BlockFactors<Size>::factorise() {
  using Block = typename BlockMatrix<Size>::Block;
  std::vector<Block>& blocks = factors.blocks;
  std::vector<int> place(factors.rows(), -1);  // of a column in the row at hand
  for (int i = 0; i < factors.rows(); ++i) {
    for (int p = factors.first[i]; p < factors.first[i + 1]; ++p)
      place[factors.column[p]] = p;
    for (int p = factors.first[i]; p < factors.diagonal[i]; ++p) {
      const int k = factors.column[p];
      const Block lower = blocks[p] * blocks[factors.diagonal[k]];
      blocks[p] = lower;
      for (int u = factors.diagonal[k] + 1; u < factors.first[k + 1]; ++u)
        if (const int to = place[factors.column[u]]; to >= 0) blocks[to].noalias() -= lower * blocks[u];
    }
    const Eigen::PartialPivLU<Block> pivot(blocks[factors.diagonal[i]]);
    const auto sizes = pivot.matrixLU().diagonal().cwiseAbs();
    is_regular = sizes.allFinite() && sizes.minCoeff() > 0;
    if (!is_regular) return;
    blocks[factors.diagonal[i]] = pivot.inverse();
    for (int p = factors.first[i]; p < factors.first[i + 1]; ++p)
      place[factors.column[p]] = -1;
  }
}

template <int Size>
void BlockFactors<Size>::solve(const Eigen::VectorXd& b, Eigen::VectorXd& answer) const {
  using Segment = FixedMatrix<Size, 1>;
  const std::vector<typename BlockMatrix<Size>::Block>& blocks = factors.blocks;
  Eigen::VectorXd x(b.size());
  for (int i = 0; i < factors.rows(); ++i) {
    Segment sum = b.template segment<Size>(Size * order[i]);
    for (int p = factors.first[i]; p < factors.diagonal[i]; ++p)
      sum.noalias() -= blocks[p] * x.segment<Size>(Size * factors.column[p]);
    x.segment<Size>(Size * i) = sum;
  }
  for (int i = factors.rows(); i-- > 0;) {
    Segment sum = x.segment<Size>(Size * i);
    for (int p = factors.diagonal[i] + 1; p < factors.first[i + 1]; ++p)
      sum.noalias() -= blocks[p] * x.segment<Size>(Size * factors.column[p]);
    x.segment<Size>(Size * i).noalias() = blocks[factors.diagonal[i]] * sum;
  }
  answer.resize(x.size());
  for (int i = 0; i < factors.rows(); ++i)
    answer.segment<Size>(Size * order[i]) = x.segment<Size>(Size * i);
}

template class BlockFactors<3>;
template class BlockFactors<6>;

}  // namespace voussoir
