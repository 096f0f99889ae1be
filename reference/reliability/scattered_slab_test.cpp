#include "reference/reliability/scattered_slab.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "text/angle.hpp"

namespace voussoir::reference::scattered_slab_test {
namespace {

// 10.6126 m of joint at 32 degrees that 663.9 kN/m drive
ScatteredSlab slab(double cohesion, double cohesion_deviation, double friction, double friction_deviation) {
  const double driving = 10.612605630259 / 0.015985404508589 * 1000;
  return {10.612605630259,   driving / std::sin(32 * degree), 32 * degree, cohesion * 1000, cohesion_deviation * 1000,
          friction * degree, friction_deviation * degree};
}

// integrals of 30 digits by another program, two splittings of the range alike
TEST(ScatteredSlab, HasTheProbabilitiesOfAnotherIntegral) {
  EXPECT_NEAR(failure_probability(slab(22, 4.4, 38, 2.9)) / 1.0573480600583014e-06, 1, 1e-9);
  EXPECT_NEAR(failure_probability(slab(20, 8, 38, 3)) / 6.11016262487148e-05, 1, 1e-9);
  EXPECT_NEAR(failure_probability(slab(24, 6, 38, 2.5)) / 7.00414173604341e-08, 1, 1e-9);
  EXPECT_NEAR(reliability_index(slab(22, 4.4, 38, 2.9)), 4.709672883, 2e-8);
}

TEST(ScatteredSlab, DoesNotDependOnItsIntervals) {
  const ScatteredSlab s = slab(22, 4.4, 38, 2.9);
  EXPECT_NEAR(failure_probability(s, 500) / failure_probability(s, 4000), 1, 1e-10);
}

TEST(ScatteredSlab, IsTheShareOfDrawsThatSlide) {
  const ScatteredSlab s = slab(10, 4, 34, 3);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const double variance = std::log1p(0.16);
  constexpr int draws = 400'000;
  int failed = 0;
  for (int k = 0; k < draws; ++k) {
    const double cohesion = 10e3 * std::exp(std::sqrt(variance) * normal(random) - variance / 2),
                 friction = (34 + 3 * normal(random)) * degree;
    failed += cohesion * s.length + s.weight * std::cos(s.dip) * std::tan(friction) < s.weight * std::sin(s.dip);
  }
  const double p = failure_probability(s);
  EXPECT_NEAR(static_cast<double>(failed) / draws, p, 4 * std::sqrt(p * (1 - p) / draws));
}

// no cohesion: the share of friction below the dip
TEST(ScatteredSlab, WithoutCohesionSlidesBelowItsDip) {
  const ScatteredSlab s = slab(1e-9, 1e-10, 38, 3);
  EXPECT_NEAR(failure_probability(s), probability_of_index(2), 1e-9);
  EXPECT_NEAR(reliability_index(s), 2, 1e-6);
}

}  // namespace
}  // namespace voussoir::reference::scattered_slab_test
