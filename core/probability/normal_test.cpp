// Φ, log Φ, Φ^-1 and Φ₂ against Boost's error function of 50 digits, identities and closed forms.
#include "core/probability/normal.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>

namespace voussoir::normal_test {
namespace {

using Digits = boost::multiprecision::cpp_bin_float_50;

Digits exact_probability(double z) {
  return boost::math::erfc(Digits(-z) / sqrt(Digits(2))) / 2;
}

double relative_error(double found, const Digits& exact) {
  return std::abs(static_cast<double>(Digits(found) / exact - 1));
}

TEST(Normal, ProbabilityKeepsItsDigitsInTheTail) {
  double worst = 0;
  for (double z = -37.4; z < 9; z += 0.0937)
    worst = std::max(worst, relative_error(normal_probability(z), exact_probability(z)));
  EXPECT_LT(worst, 3e-15);
  EXPECT_EQ(normal_probability(0), 0.5);
  EXPECT_EQ(normal_probability(-40), 0);
  EXPECT_EQ(normal_probability(40), 1);
}

TEST(Normal, LogarithmGoesOnBelowTheLeastDouble) {
  for (const double z : {-37.0, -20.0, -5.66, -5.64, -3.0, -0.7, -0.6, 0.0, 0.6, 1.0, 3.0, 8.0}) {
    const Digits exact = log(exact_probability(z));
    EXPECT_LT(relative_error(log_normal_probability(z), exact), 1e-13) << z;
  }
  EXPECT_DOUBLE_EQ(log_normal_probability(20), -normal_probability(-20));
  // Φ(-z) = φ(z)/z (1 - 1/z² + 3/z⁴ …)
  const double z = 1000;
  EXPECT_NEAR(log_normal_probability(-z), -z * z / 2 - 0.5 * std::log(2 * std::numbers::pi) - std::log(z) - 1e-6, 1e-9);
}

TEST(Normal, QuantileIsTheInverse) {
  double worst = 0;
  for (double z = -37; z <= 0; z += 0.00731)
    worst = std::max(worst, std::abs(normal_quantile(normal_probability(z)) - z));
  EXPECT_LT(worst, 1e-14);
  EXPECT_EQ(normal_quantile(0.5), 0);
  EXPECT_EQ(normal_quantile(0.75), -normal_quantile(0.25));
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
}

TEST(Normal, DensityIsTheSlopeOfTheProbability) {
  EXPECT_NEAR(normal_density(0), 1 / std::sqrt(2 * std::numbers::pi), 1e-16);
  for (const double z : {-36.0, -7.0, -1.0, 2.0})
    EXPECT_LT(
        relative_error(normal_density(z), exp(-Digits(z) * z / 2) / sqrt(2 * boost::math::constants::pi<Digits>())),
        2e-15);
  EXPECT_EQ(normal_density(50), 0);
}

TEST(Normal, TwoAtOnce) {
  // Sheppard (1899): a quadrant
  for (const double correlation : {-0.99, -0.5, 0.0, 0.3, 0.9, 0.9999})
    EXPECT_NEAR(bivariate_normal_probability(0, 0, correlation), 0.25 + std::asin(correlation) / (2 * std::numbers::pi),
                1e-14);
  // without correlation a product, of full correlation the smaller, opposite ones exclude each other
  EXPECT_NEAR(bivariate_normal_probability(-6, -5, 0) / (normal_probability(-6) * normal_probability(-5)), 1, 1e-13);
  EXPECT_EQ(bivariate_normal_probability(-3, 1, 1), normal_probability(-3));
  EXPECT_EQ(bivariate_normal_probability(-3, 1, -1), 0);
  EXPECT_NEAR(bivariate_normal_probability(1, 2, -1), normal_probability(2) - normal_probability(-1), 1e-15);
  // what is left out: P(X <= a) = P(X <= a, Y <= b) + P(X <= a, -Y <= -b)
  for (const double correlation : {-0.95, -0.4, 0.2, 0.71, 0.999})
    for (const double a : {-5.0, -1.0, 2.0})
      for (const double b : {-4.0, 0.5, 3.0}) {
        const double one = bivariate_normal_probability(a, b, correlation);
        EXPECT_NEAR(one, bivariate_normal_probability(b, a, correlation), 1e-11 * one);
        EXPECT_NEAR((one + bivariate_normal_probability(a, -b, -correlation)) / normal_probability(a), 1, 1e-11);
      }
  // scipy's multivariate_normal
  EXPECT_NEAR(bivariate_normal_probability(-3.608481, -3.535536, 0.711238) / 2.088092e-05, 1, 1e-6);
}

}  // namespace
}  // namespace voussoir::normal_test
