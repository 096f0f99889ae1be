// The lowest eigenvalues of pencils against Eigen's dense solver, and cases that a Krylov space alone gets wrong.
#include "core/modes/spectrum.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/modes/lanczos.hpp"

namespace voussoir::spectrum_test {
namespace {

using Block = BlockMatrix<3>::Block;

// blocks in a row, joined by springs of these stiffnesses along their three freedoms; the first one to the ground
Pencil<3> chain(int count, const Vector<3>& stiffness, double ground) {
  Pencil<3> pencil;
  std::vector<std::vector<int>> columns(count);
  for (int i = 0; i + 1 < count; ++i) {
    columns[i].push_back(i + 1);
    columns[i + 1].push_back(i);
  }
  pencil.stiffness.lay_out(columns);
  const Block k = stiffness.asDiagonal();
  pencil.stiffness.at(0, 0) += ground * k;
  for (int i = 0; i + 1 < count; ++i) {
    pencil.stiffness.at(i, i) += k;
    pencil.stiffness.at(i + 1, i + 1) += k;
    pencil.stiffness.at(i, i + 1) -= k;
    pencil.stiffness.at(i + 1, i) -= k;
  }
  Block root = Block::Identity();
  root(1, 0) = 0.3;
  root(2, 1) = -0.2;
  for (int i = 0; i < count; ++i)
    pencil.mass_root.push_back((1 + 0.1 * i) * root);
  return pencil;
}

struct Dense {
  Eigen::MatrixXd k, m;
};

Dense dense(const Pencil<3>& pencil) {
  const int n = 3 * pencil.stiffness.rows();
  Dense d{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  for (int i = 0; i < pencil.stiffness.rows(); ++i) {
    for (int p = pencil.stiffness.first[i]; p < pencil.stiffness.first[i + 1]; ++p)
      d.k.block<3, 3>(3 * i, 3 * pencil.stiffness.column[p]) = pencil.stiffness.blocks[p];
    d.m.block<3, 3>(3 * i, 3 * i) = pencil.mass_root[i] * pencil.mass_root[i].transpose();
  }
  return d;
}

void expect_as_dense(const Pencil<3>& pencil, int number) {
  const Spectrum found = lowest_eigenvalues(pencil, number);
  const Dense d = dense(pencil);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(d.k, d.m);
  ASSERT_TRUE(found.converged);
  EXPECT_EQ(found.missing, 0);
  ASSERT_EQ(found.pairs.size(), static_cast<std::size_t>(std::min<Eigen::Index>(number, d.k.rows())));
  const double most = solver.eigenvalues().cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < found.pairs.size(); ++i) {
    EXPECT_NEAR(found.pairs[i].value, solver.eigenvalues()[static_cast<Eigen::Index>(i)], 1e-11 * most) << i;
    const Eigen::VectorXd& shape = found.pairs[i].shape;
    EXPECT_LT((d.k * shape - found.pairs[i].value * d.m * shape).norm(), 1e-9 * most) << i;
    for (std::size_t j = 0; j <= i; ++j)
      EXPECT_NEAR(shape.dot(d.m * found.pairs[j].shape), i == j ? 1 : 0, 1e-9) << i << ' ' << j;
  }
}

TEST(Spectrum, FindsTheLowest) {
  expect_as_dense(chain(40, {1, 2, 5}, 1), 7);
}

TEST(Spectrum, FindsAll) {
  expect_as_dense(chain(4, {1, 2, 5}, 1), 100);
}

// three equal directions: each eigenvalue three times, of which one start vector sees one
TEST(Spectrum, FindsEveryCopyOfAMultipleEigenvalue) {
  Pencil<3> pencil = chain(30, {1, 1, 1}, 1);
  for (Block& root : pencil.mass_root)
    root.setIdentity();
  expect_as_dense(pencil, 9);
}

TEST(Spectrum, ChainWithoutGroundHasThreeOfNought) {
  const Spectrum found = lowest_eigenvalues(chain(20, {1, 2, 5}, 0), 4);
  ASSERT_EQ(found.pairs.size(), 4U);
  for (int k = 0; k < 3; ++k)
    EXPECT_LT(std::abs(found.pairs[k].value), found.resolution);
  EXPECT_GT(found.pairs[3].value, 100 * found.resolution);
}

TEST(Spectrum, FindsNegativeOnesFirst) {
  expect_as_dense(chain(12, {1, -2, 5}, 1), 6);
}

// a row of zeros of the root: that degree of freedom has no mass and follows, one less to find
TEST(Spectrum, CountsDegreesOfFreedomWithMass) {
  Pencil<3> pencil = chain(5, {1, 2, 5}, 1);
  for (Block& root : pencil.mass_root) {
    root.setIdentity();
    root.row(2).setZero();
  }
  EXPECT_EQ(pencil.count(), 10);
  EXPECT_EQ(lowest_eigenvalues(pencil, 100).pairs.size(), 10U);
}

TEST(Spectrum, HasTheSameBitsEachTime) {
  const Pencil<3> pencil = chain(60, {1, 1, 1}, 1);
  const Spectrum one = lowest_eigenvalues(pencil, 8), two = lowest_eigenvalues(pencil, 8);
  ASSERT_EQ(one.pairs.size(), two.pairs.size());
  for (std::size_t k = 0; k < one.pairs.size(); ++k) {
    EXPECT_EQ(one.pairs[k].value, two.pairs[k].value);
    EXPECT_EQ(one.pairs[k].shape, two.pairs[k].shape);
  }
}

// sizes far from one: Spectra's own thresholds are absolute
TEST(Lanczos, DoesNotDependOnTheSizeOfTheOperator) {
  for (const double size : {1e-20, 1.0, 1e20}) {
    const SymmetricOperator a{50, [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
                                Eigen::VectorXd y = x;
                                for (Eigen::Index i = 0; i < y.size(); ++i)
                                  y[i] *= size / static_cast<double>(i + 1);
                                return y;
                              }};
    const LargestEigenvalues found = largest_eigenvalues(a, 4, 1, 1e-12);
    ASSERT_EQ(found.values.size(), 4U);
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(found.values[k], size / (k + 1), 1e-12 * size);
  }
}

TEST(Lanczos, ANoughtHasNoValues) {
  const SymmetricOperator a{5, [](const Eigen::VectorXd& x) -> Eigen::VectorXd { return 0 * x; }};
  EXPECT_TRUE(largest_eigenvalues(a, 2, 1, 1e-12).values.empty());
}

}  // namespace
}  // namespace voussoir::spectrum_test
