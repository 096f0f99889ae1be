// Linear systems of blocks: against dense factors, by complete and by incomplete ones, and when factors are complete.
#include "core/solvers/block_solver.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "core/solvers/block_factors.hpp"
#include "core/testing/dense.hpp"

namespace voussoir::block_solver_test {
namespace {

std::vector<int> in_order(int count) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

// blocks in a ring with a few chords, diagonally dominant: against a dense factorisation
template <int Size>
void expect_solved() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  constexpr int count = 40;
  LinearWork<Size> work;
  BlockMatrix<Size>& matrix = work.matrix;
  std::vector<std::vector<int>> columns(count);
  for (int i = 0; i < count; ++i)
    columns[i] = {(i + 7) % count, (i + 1) % count, (i + 1) % count};
  matrix.lay_out(columns);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(Size * count, Size * count);
  const auto put = [&](int row, int column, double weight) {
    typename BlockMatrix<Size>::Block block;
    for (int i = 0; i < Size * Size; ++i)
      block.data()[i] = weight * uniform(random);
    if (row == column) block.diagonal().array() += 3 * Size;
    matrix.at(row, column) += block;
    dense.block<Size, Size>(Size * row, Size * column) += block;
  };
  for (int i = 0; i < count; ++i) {
    put(i, (i + 1) % count, 1);
    put(i, i, 1);
    put(i, (i + 7) % count, 0.5);
    put(i, (i + 1) % count, 0.5);  // twice in the same place
  }
  Eigen::VectorXd more(Size * count), b(Size * count);
  for (int i = 0; i < more.size(); ++i) {
    more[i] = 1 + uniform(random);
    b[i] = uniform(random);
  }
  matrix.add_diagonal(more);
  dense.diagonal() += more;
  Eigen::VectorXd product;
  matrix.times(1, b, product);
  EXPECT_LT((product - dense * b).norm(), 1e-13 * b.norm() * dense.norm());
  EXPECT_EQ(solve_blocks(work, in_order(count), Eigen::VectorXd(0 * b), 1e-12, 100, 1).x.norm(), 0);
  const LinearAnswer answer = solve_blocks(work, in_order(count), b, 1e-12, 100, 1);
  EXPECT_LE(answer.residual, 1e-12);
  EXPECT_LT((answer.x - oracle::solution(dense, b)).norm(), 1e-11 * answer.x.norm());
  EXPECT_LT((dense * answer.x - b).norm(), 1e-11 * b.norm());
  // of the storage of before
  EXPECT_EQ(solve_blocks(work, in_order(count), b, 1e-2, 100, 1).residual <= 1e-2, true);
  EXPECT_EQ(solve_blocks(work, in_order(count), b, 1e-12, 100, 1).x, answer.x);
}

TEST(BlockMatrix, SolvesSmallBlocks) {
  expect_solved<3>();
  expect_solved<6>();
}

// each block coupled to the next along every axis of a box of so many blocks; stiff enough on its diagonal to be
// definite
template <int Size>
BlockMatrix<Size> grid(int dimensions, int side) {
  int count = 1;
  for (int d = 0; d < dimensions; ++d)
    count *= side;
  std::vector<std::vector<int>> columns(count);
  for (int i = 0; i < count; ++i)
    for (int d = 0, step = 1; d < dimensions; ++d, step *= side)
      for (const int way : {-1, 1})
        if (const int at = i / step % side + way; at >= 0 && at < side) columns[i].push_back(i + way * step);
  BlockMatrix<Size> matrix;
  matrix.lay_out(columns);
  for (typename BlockMatrix<Size>::Block& block : matrix.blocks)
    block = -BlockMatrix<Size>::Block::Identity();
  for (const int at : matrix.diagonal)
    matrix.blocks[at] *= -2.01 * dimensions;
  return matrix;
}

// Complete factors solve chains and blocks in a plane directly, at any number; in a box they would fill in too much.
TEST(BlockFactors, AreCompleteIfTheyFillInLittle) {
  const auto iterations = [](const auto& matrix) {
    LinearWork<6> work{.matrix = matrix};
    const LinearAnswer answer = solve_blocks(work, in_order(matrix.rows()),
                                             Eigen::VectorXd(Eigen::VectorXd::Ones(matrix.rows() * 6)), 1e-10, 100, 1);
    EXPECT_LE(answer.residual, 1e-10);
    return answer.iterations;
  };
  for (const auto& matrix : {grid<6>(1, 2000), grid<6>(2, 20)}) {
    EXPECT_TRUE(BlockFactors<6>(matrix).complete());
    EXPECT_EQ(iterations(matrix), 1);
  }
  EXPECT_TRUE(BlockFactors<3>(grid<3>(2, 100)).complete());
  const BlockMatrix<6> in_a_box = grid<6>(3, 12);
  EXPECT_FALSE(BlockFactors<6>(in_a_box).complete());
  EXPECT_GT(iterations(in_a_box), 1);
}

TEST(BlockMatrix, ReportsThatItIsSingular) {
  LinearWork<3> work;
  work.matrix.lay_out({{0}});
  EXPECT_FALSE(std::isfinite(solve_blocks(work, {0}, Eigen::VectorXd(Eigen::VectorXd::Ones(3)), 1e-3, 10, 1).residual));
}

}  // namespace
}  // namespace voussoir::block_solver_test
