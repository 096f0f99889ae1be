// Correlation of values and of their normals, matrices that contradict themselves, and Latin hypercubes.
#include "core/probability/correlation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/probability/latin_hypercube.hpp"
#include "core/probability/normal.hpp"

namespace voussoir::correlation_test {
namespace {

const Distribution normal{Law::normal, 10, 2}, lognormal{Law::lognormal, 10, 4}, wide{Law::lognormal, 1, 1};
const Distribution uniform{Law::uniform, 0, 0, 0, -1, 3}, triangular{Law::triangular, 0, 0, 1, 0, 4};
const Distribution exponential{Law::exponential, 0.5, 0, 0, 0, 1};
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Correlation, ClosedForms) {
  EXPECT_EQ(correlation_of_normals(normal, normal, -0.5), -0.5);
  EXPECT_NEAR(correlation_of_normals(normal, lognormal, 0.6), 0.6 * 0.4 / std::sqrt(std::log(1.16)), 1e-14);
  EXPECT_NEAR(correlation_of_normals(lognormal, wide, -0.3),
              std::log(1 - 0.3 * 0.4) / std::sqrt(std::log(1.16) * std::log(2)), 1e-14);
}

TEST(Correlation, QuadratureAgreesWithClosedForms) {
  // cuts that take nothing away, so that the closed forms hold but are not used
  const Distribution cut_normal{Law::normal, 10, 2, 0, -90, 110},
      cut_lognormal{Law::lognormal, 10, 4, 0, 1e-9, infinity};
  for (const double rho : {-0.7, -0.1, 0.4, 0.95})
    EXPECT_NEAR(correlation_of_normals(cut_normal, cut_lognormal, rho), correlation_of_normals(normal, lognormal, rho),
                1e-10);
  EXPECT_NEAR(correlation_of_normals(cut_lognormal, cut_lognormal, -0.4),
              correlation_of_normals(lognormal, lognormal, -0.4), 1e-10);
  // two uniform laws: 2 sin(π ρ/6); a uniform and a normal one: ρ √(π/3)
  for (const double rho : {-0.9, -0.3, 0.5, 0.99}) {
    EXPECT_NEAR(correlation_of_normals(uniform, uniform, rho), 2 * std::sin(M_PI * rho / 6), 1e-10);
    if (rho < 0.95) EXPECT_NEAR(correlation_of_normals(uniform, normal, rho), rho * std::sqrt(M_PI / 3), 1e-10);
  }
  // found by scipy's double quadrature with a root: crack depth and water of a slope
  const Distribution crack{Law::normal, 14, 3};
  EXPECT_NEAR(correlation_of_normals(crack, exponential, -0.5), -0.519475566, 1e-9);
  EXPECT_NEAR(correlation_of_normals(exponential, crack, -0.5), -0.519475566, 1e-9);
  EXPECT_EQ(correlation_of_normals(uniform, triangular, 0), 0);
}

TEST(Correlation, Reach) {
  const auto expect = [](const Distribution& a, const Distribution& b, double least, double most) {
    const CorrelationRange range = reachable_correlation(a, b);
    EXPECT_NEAR(range.least, least, 1e-10);
    EXPECT_NEAR(range.most, most, 1e-10);
  };
  expect(normal, normal, -1, 1);
  expect(normal, wide, -std::sqrt(std::log(2)), std::sqrt(std::log(2)));
  expect(wide, wide, -0.5, 1);  // (1/2 - 1)/1
  expect(uniform, uniform, -1, 1);
  expect(uniform, normal, -std::sqrt(3 / M_PI), std::sqrt(3 / M_PI));
  // just within it there is a correlation of the normals, beyond triangular corners too
  const CorrelationRange range = reachable_correlation(triangular, exponential);
  EXPECT_LT(range.most, 1);
  EXPECT_GT(correlation_of_normals(triangular, exponential, range.most - 1e-4), 0.99);
  EXPECT_LT(correlation_of_normals(triangular, exponential, range.least + 1e-4), -0.99);
}

TEST(Correlation, Factor) {
  const auto factor = cholesky_factor(3, {{0, 2, 0, 0.6}, {1, 2, 0, -0.5}});
  ASSERT_TRUE(factor);
  const auto product = [&](std::size_t i, std::size_t j) {
    return std::inner_product((*factor)[i].begin(), (*factor)[i].end(), (*factor)[j].begin(), 0.0);
  };
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(product(k, k), 1, 1e-15);
  EXPECT_NEAR(product(0, 2), 0.6, 1e-15);
  EXPECT_NEAR(product(1, 2), -0.5, 1e-15);
  EXPECT_EQ(product(0, 1), 0);
  EXPECT_EQ((*factor)[0][1], 0);
}

TEST(Correlation, ContradictionsAreNamed) {
  using Keys = std::vector<std::size_t>;
  EXPECT_EQ(inconsistent_keys(4, {{0, 1, 0, 0.5}}), Keys{});
  EXPECT_EQ(inconsistent_keys(2, {}), Keys{});
  EXPECT_EQ(inconsistent_keys(4, {{0, 1, 0, 0.2}, {1, 3, 0, 1}}), (Keys{1, 3}));
  // a goes with b, b with c, but a against c
  const std::vector<CorrelatedPair> circle{{0, 1, 0, 0.1}, {1, 2, 0, 0.9}, {2, 4, 0, 0.9}, {1, 4, 0, -0.9}};
  EXPECT_FALSE(cholesky_factor(5, circle));
  EXPECT_EQ(inconsistent_keys(5, circle), (Keys{1, 2, 4}));
  // a star: each pair is well, and so are three keys, but not all four
  const std::vector<CorrelatedPair> star{{0, 1, 0, 0.6}, {0, 2, 0, 0.6}, {0, 3, 0, 0.6}, {4, 5, 0, 0.9}};
  EXPECT_EQ(inconsistent_keys(6, star), (Keys{0, 1, 2, 3}));
}

TEST(LatinHypercube, OneValueInEachClass) {
  constexpr int rows = 200;
  const std::vector<double> column = latin_column(rows, 7, "friction");
  std::vector<int> classes(rows, 0);
  for (const double z : column)
    ++classes.at(static_cast<std::size_t>(normal_probability(z) * rows));
  EXPECT_EQ(std::ranges::count(classes, 1), rows);
  EXPECT_NEAR(std::accumulate(column.begin(), column.end(), 0.0) / rows, 0, 0.01);
  EXPECT_FALSE(std::ranges::is_sorted(column));
  EXPECT_EQ(column, latin_column(rows, 7, "friction"));
  EXPECT_NE(column, latin_column(rows, 8, "friction"));
  EXPECT_NE(column, latin_column(rows, 7, "cohesion"));
  EXPECT_EQ(latin_column(1, 7, "friction").size(), 1);
}

TEST(LatinHypercube, ColumnsAreIndependent) {
  constexpr int rows = 2000;
  const std::vector<double> a = latin_column(rows, 1, "a"), b = latin_column(rows, 1, "b");
  EXPECT_LT(std::abs(std::inner_product(a.begin(), a.end(), b.begin(), 0.0)) / rows, 3.3 / std::sqrt(rows));
}

}  // namespace
}  // namespace voussoir::correlation_test
