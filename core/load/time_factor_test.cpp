#include "core/load/time_factor.hpp"

#include <gtest/gtest.h>

#include <random>

namespace voussoir {
namespace {

// Simpson's rule on pieces that are short beside the period and end where the table bends
double by_quadrature(const TimeFactor& factor, double from, double to) {
  std::vector<double> bounds{from};
  for (const double t : factor.times)
    if (t > from && t < to) bounds.push_back(t);
  bounds.push_back(to);
  double sum = 0;
  for (std::size_t k = 1; k < bounds.size(); ++k) {
    constexpr int pieces = 400;
    const double a = bounds[k - 1], h = (bounds[k] - a) / pieces;
    for (int i = 0; i < pieces; ++i)
      sum +=
          h / 6 *
          (value_at(factor, a + i * h) + 4 * value_at(factor, a + (i + 0.5) * h) + value_at(factor, a + (i + 1) * h));
  }
  return sum / (to - from);
}

TEST(TimeFactor, HasAnExactMean) {
  std::mt19937 random(63);
  std::uniform_real_distribution<double> number(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    TimeFactor factor;
    if (trial % 3 > 0) factor.frequency = 4 * number(random);
    factor.phase = 6 * number(random);
    for (int k = 0; k < trial % 5; ++k) {
      factor.times.push_back((factor.times.empty() ? 0 : factor.times.back()) + 0.01 + number(random));
      factor.factors.push_back(2 * number(random) - 1);
    }
    const double from = 2 * number(random), to = from + 1e-3 + 2 * number(random);
    EXPECT_NEAR(mean_of(factor, from, to), by_quadrature(factor, from, to), 1e-9) << "trial " << trial;
  }
}

TEST(TimeFactor, HasTheMeanOfAShortStep) {
  const TimeFactor factor{.frequency = 2, .phase = 0.3, .times = {0, 1, 3}, .factors = {0, 1, 0.5}};
  for (const double h : {1e-3, 1e-5, 1e-7, 1e-9})
    EXPECT_NEAR(mean_of(factor, 0.7, 0.7 + h), value_at(factor, 0.7 + 0.5 * h), 30 * h * h + 1e-14);
}

}  // namespace
}  // namespace voussoir
