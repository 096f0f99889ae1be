// Complete factors over supernodes: against dense factors, their cost known before, zero pivots.
#include "core/solvers/complete_factors.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/testing/dense.hpp"

namespace voussoir::complete_factors_test {
namespace {

// the pattern of blocks in a box, coupled to their neighbours along every axis
BlockMatrix<6> box(int x, int y, int z) {
  std::vector<std::vector<int>> columns(x * y * z);
  const auto at = [&](int i, int j, int k) { return i + x * (j + y * k); };
  const auto couple = [&](int p, int q) {
    columns[p].push_back(q);
    columns[q].push_back(p);
  };
  for (int k = 0; k < z; ++k)
    for (int j = 0; j < y; ++j)
      for (int i = 0; i < x; ++i) {
        if (i + 1 < x) couple(at(i, j, k), at(i + 1, j, k));
        if (j + 1 < y) couple(at(i, j, k), at(i, j + 1, k));
        if (k + 1 < z) couple(at(i, j, k), at(i, j, k + 1));
      }
  BlockMatrix<6> matrix;
  matrix.lay_out(columns);
  return matrix;
}

template <int Size>
Eigen::MatrixXd dense(const BlockMatrix<Size>& matrix) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(Size * matrix.rows(), Size * matrix.rows());
  for (int i = 0; i < matrix.rows(); ++i)
    for (int p = matrix.first[i]; p < matrix.first[i + 1]; ++p)
      all.block<Size, Size>(Size * i, Size * matrix.column[p]) = matrix.blocks[p];
  return all;
}

// random numbers everywhere; so much more on the diagonal
void fill(BlockMatrix<6>& matrix, bool symmetric, double diagonal) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (Matrix<6>& block : matrix.blocks)
    for (int k = 0; k < 36; ++k)
      block.data()[k] = uniform(random);
  for (const int at : matrix.diagonal)
    matrix.blocks[at].diagonal().array() += diagonal;
  if (!symmetric) return;
  for (int i = 0; i < matrix.rows(); ++i)
    for (int p = matrix.first[i]; p < matrix.first[i + 1]; ++p) {
      const Matrix<6> block = matrix.blocks[p].transpose();
      if (const int j = matrix.column[p]; j < i)
        matrix.at(j, i) = block;
      else if (i == j)
        matrix.blocks[p] = (0.5 * (block + matrix.blocks[p])).eval();
    }
}

Eigen::VectorXd numbers(Eigen::Index count) {
  Eigen::VectorXd b(count);
  for (Eigen::Index i = 0; i < count; ++i)
    b[i] = 1 + static_cast<double>(i % 7) - 0.3 * static_cast<double>(i % 4);
  return b;
}

// the error that remains, over what rounding of the matrix's numbers would leave
double residual(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& x, const Eigen::VectorXd& b) {
  return (matrix * x - b).norm() / (matrix.norm() * x.norm() + b.norm());
}

TEST(CompleteFactors, AgreeWithDenseOnes) {
  for (const bool symmetric : {false, true})
    for (const double diagonal : {30.0, 7.0}) {
      BlockMatrix<6> matrix = box(4, 3, 5);
      fill(matrix, symmetric, diagonal);
      const EliminationPlan plan(neighbours_in(matrix));
      CompleteFactors<6> factors(plan, symmetric);
      ASSERT_TRUE(factors.factorise(matrix));
      const Eigen::MatrixXd all = dense(matrix);
      const Eigen::VectorXd b = numbers(all.rows());
      EXPECT_LT(residual(all, factors.solve(b), b), 1e-14) << symmetric << diagonal;
      EXPECT_LT(residual(all.transpose(), factors.solve_transposed(b), b), 1e-14) << symmetric << diagonal;
      const Eigen::VectorXd direct = oracle::solution(all, b);
      EXPECT_LT((factors.solve(b) - direct).norm(), 1e-10 * direct.norm()) << symmetric << diagonal;
    }
}

// Pivots within a supernode: diagonal blocks of zeros on the diagonal, as of constraints, are no obstacle.
TEST(CompleteFactors, ExchangeRows) {
  BlockMatrix<6> matrix = box(3, 3, 3);
  fill(matrix, false, 0);
  for (const int at : matrix.diagonal) {
    matrix.blocks[at].diagonal().setZero();
    for (int k = 0; k < 6; ++k)
      matrix.blocks[at](k, (k + 1) % 6) += 20;
  }
  const EliminationPlan plan(neighbours_in(matrix));
  CompleteFactors<6> factors(plan, false);
  ASSERT_TRUE(factors.factorise(matrix));
  const Eigen::MatrixXd all = dense(matrix);
  const Eigen::VectorXd b = numbers(all.rows());
  EXPECT_LT(residual(all, factors.solve(b), b), 1e-14);
  EXPECT_LT(residual(all.transpose(), factors.solve_transposed(b), b), 1e-14);
}

// of a symmetric matrix one half is enough; a second matrix of the pattern needs no new plan
TEST(CompleteFactors, ReadHalfOfASymmetricMatrix) {
  BlockMatrix<6> matrix = box(3, 4, 2);
  fill(matrix, true, 30);
  const EliminationPlan plan(neighbours_in(matrix));
  std::vector<std::vector<int>> columns(matrix.rows());
  for (int i = 0; i < matrix.rows(); ++i)
    for (int p = matrix.first[i]; p < matrix.diagonal[i]; ++p)
      columns[i].push_back(matrix.column[p]);
  BlockMatrix<6> half;
  half.lay_out(columns);
  for (int i = 0; i < matrix.rows(); ++i)
    for (int p = matrix.first[i]; p <= matrix.diagonal[i]; ++p)
      half.at(i, matrix.column[p]) = matrix.blocks[p];
  for (const int at : half.diagonal)
    half.blocks[at].triangularView<Eigen::StrictlyUpper>().setConstant(7);  // not read
  CompleteFactors<6> factors(plan, true), of_half(plan, true);
  const Eigen::VectorXd b = numbers(6 * matrix.rows());
  BlockMatrix<6> other = matrix;
  other.add_diagonal(Eigen::VectorXd::Ones(6 * matrix.rows()));
  ASSERT_TRUE(of_half.factorise(other));
  ASSERT_TRUE(factors.factorise(matrix));
  ASSERT_TRUE(of_half.factorise(half));
  EXPECT_EQ(factors.solve(b), of_half.solve(b));
}

TEST(CompleteFactors, FlagAZeroPivot) {
  for (const bool symmetric : {false, true}) {
    BlockMatrix<6> matrix = box(2, 2, 2);
    fill(matrix, symmetric, 30);
    const EliminationPlan plan(neighbours_in(matrix));
    CompleteFactors<6> factors(plan, symmetric);
    EXPECT_TRUE(factors.factorise(matrix));
    // a freedom that nothing resists
    for (int i = 0; i < matrix.rows(); ++i)
      for (int p = matrix.first[i]; p < matrix.first[i + 1]; ++p) {
        if (i == 3) matrix.blocks[p].row(4).setZero();
        if (matrix.column[p] == 3) matrix.blocks[p].col(4).setZero();
      }
    EXPECT_FALSE(factors.factorise(matrix)) << symmetric;
  }
}

// Nearly singular: the residual stays small, however large the answer.
TEST(CompleteFactors, KeepTheResidualSmallIfNearlySingular) {
  for (const bool symmetric : {false, true}) {
    BlockMatrix<6> matrix = box(3, 3, 3);
    fill(matrix, symmetric, 30);
    Matrix<6>& block = matrix.blocks[matrix.diagonal[13]];
    for (int i = 0; i < matrix.rows(); ++i)
      for (int p = matrix.first[i]; p < matrix.first[i + 1]; ++p) {
        if (i == 13) matrix.blocks[p].row(2) *= 1e-12;
        if (matrix.column[p] == 13) matrix.blocks[p].col(2) *= 1e-12;
      }
    block(2, 2) = 1e-20;
    const EliminationPlan plan(neighbours_in(matrix));
    CompleteFactors<6> factors(plan, symmetric);
    ASSERT_TRUE(factors.factorise(matrix));
    const Eigen::MatrixXd all = dense(matrix);
    const Eigen::VectorXd b = numbers(all.rows());
    EXPECT_LT(residual(all, factors.solve(b), b), 1e-13) << symmetric;
  }
}

TEST(EliminationPlan, KnowsTheCost) {
  // a chain fills in nothing: a block on the diagonal and one below it of each row but the last, if nothing is merged
  const EliminationPlan chain(neighbours_in(box(200, 1, 1)));
  EXPECT_GE(chain.cost(6, true).entries, 36 * 399);
  EXPECT_LE(chain.cost(6, true).entries, 36 * 399 * 1.6);  // with the zeros of merged ones, and squares for triangles

  // every row is eliminated once, children before parents, rows below later than the columns
  const EliminationPlan plan(neighbours_in(box(8, 7, 6)));
  std::vector<int> times(8 * 7 * 6, 0);
  for (const int row : plan.order)
    ++times[row];
  for (const int count : times)
    EXPECT_EQ(count, 1);
  int next = 0;
  for (std::size_t at = 0; at < plan.supernodes.size(); ++at) {
    const Supernode& node = plan.supernodes[at];
    EXPECT_EQ(node.first, next);
    next += node.columns;
    EXPECT_EQ(node.below.empty(), plan.parent[at] < 0);
    if (plan.parent[at] < 0) continue;
    EXPECT_GT(plan.parent[at], static_cast<int>(at));
    EXPECT_GE(node.below.front(), next);
  }
  EXPECT_EQ(next, 8 * 7 * 6);
  const EliminationPlan::Cost half = plan.cost(6, true), all = plan.cost(6, false);
  EXPECT_GT(all.entries, half.entries);
  EXPECT_NEAR(all.operations / half.operations, 2, 0.05);
  EXPECT_GT(half.bytes, 8 * half.entries);

  // One dense panel has all its numbers, and n³/3 operations.
  std::vector<std::vector<int>> every(20);
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j)
      every[i].push_back(j);
  BlockMatrix<6> full;
  full.lay_out(every);
  const EliminationPlan dense_plan(neighbours_in(full));
  EXPECT_EQ(dense_plan.supernodes.size(), 1u);
  EXPECT_EQ(dense_plan.cost(6, true).entries, 120 * 120);
  EXPECT_NEAR(dense_plan.cost(6, true).operations, 120.0 * 120 * 120 / 3, 0.03 * 120 * 120 * 120 / 3);
}

}  // namespace
}  // namespace voussoir::complete_factors_test
