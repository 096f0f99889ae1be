// Laws: their values by normals, draws, moments and correlations, against closed forms and each other.
#include "core/probability/distribution.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/joint_sets/portable_math.hpp"
#include "core/probability/normal.hpp"

namespace voussoir::distribution_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Distribution make_law(Law law, double mean, double deviation, double least = -infinity, double most = infinity) {
  return {law, mean, deviation, 0, least, most};
}

const std::vector<std::pair<std::string, Distribution>> laws{
    {"normal", make_law(Law::normal, 40, 3)},
    {"cut normal", make_law(Law::normal, 40, 3, 37, 46)},
    {"normal cut below", make_law(Law::normal, 40, 3, 37)},
    {"upper tail of a normal", make_law(Law::normal, 0, 1, 6, 9)},
    {"lognormal", make_law(Law::lognormal, 8, 4)},
    {"cut lognormal", make_law(Law::lognormal, 8, 4, 2, 15)},
    {"uniform", make_law(Law::uniform, 0, 0, -2, 6)},
    {"triangular", {Law::triangular, 0, 0, 1, 0, 4}},
    {"triangular without a left side", {Law::triangular, 0, 0, 0, 0, 4}},
    {"triangular without a right side", {Law::triangular, 0, 0, 4, 0, 4}},
    {"exponential", make_law(Law::exponential, 0.5, 0)},
    {"cut exponential", make_law(Law::exponential, 0.5, 0, 0, 1)},
    {"exponential between", make_law(Law::exponential, 0.5, 0, 3, 4)},
};

TEST(Distribution, StandardAndValueAreInverse) {
  for (const auto& [name, law] : laws)
    for (double z = -5; z <= 5; z += 0.37) {
      const double x = value_at(law, z);
      EXPECT_GE(x, law.least);
      EXPECT_LE(x, law.most);
      // as well as the digits of x near an end allow
      EXPECT_NEAR(standard_at(law, x), z, 1e-8) << name << " at " << z;
      EXPECT_LT(x, value_at(law, z + 0.01)) << name;
    }
}

TEST(Distribution, FarTailsHaveDigits) {
  const Distribution uniform{Law::uniform, 0, 0, 0, 0, 1};
  EXPECT_DOUBLE_EQ(value_at(uniform, -20), normal_probability(-20));
  EXPECT_DOUBLE_EQ(value_at(make_law(Law::exponential, 1, 0), -20), normal_probability(-20));
  EXPECT_DOUBLE_EQ(value_at(make_law(Law::exponential, 1, 0), 30), -log_normal_probability(-30));
  // the quantile of a lognormal at z = 12 is no infinity
  EXPECT_NEAR(value_at(make_law(Law::lognormal, 20, 8), 12),
              20 / std::sqrt(1.16) * std::exp(12 * std::sqrt(std::log(1.16))), 1e-9);
  // a cut that takes hardly anything away changes hardly anything
  EXPECT_NEAR(value_at(make_law(Law::normal, 40, 3, 0), -8), 40 - 24, 1e-9);
  EXPECT_NEAR(value_at(make_law(Law::normal, 40, 3, -infinity, 80), 8), 40 + 24, 1e-9);
}

TEST(Distribution, CutLawIsPartOfTheWhole) {
  // F = (F₀ - F₀(least))/(F₀(most) - F₀(least))
  const Distribution whole = make_law(Law::normal, 40, 3), cut = make_law(Law::normal, 40, 3, 37, 46);
  const auto below = [&](double x) { return normal_probability(standard_at(whole, x)); };
  for (const double z : {-3.0, -1.0, 0.0, 0.5, 2.0})
    EXPECT_NEAR(normal_probability(z), (below(value_at(cut, z)) - below(37)) / (below(46) - below(37)), 1e-14);
  EXPECT_TRUE(cut.is_cut());
  EXPECT_FALSE(whole.is_cut());
  EXPECT_FALSE(make_law(Law::uniform, 0, 0, 1, 2).is_cut());
  EXPECT_FALSE(make_law(Law::exponential, 1, 0, -1).is_cut());
}

TEST(Distribution, DrawsHaveTheLawOfTheValues) {
  constexpr int rows = 4000;
  for (const auto& [name, law] : laws) {
    if (name == "upper tail of a normal") continue;  // hardly ever drawn
    RandomStream stream(5, name);
    std::vector<double> sample;
    for (int k = 0; k < rows; ++k)
      sample.push_back(draw(law, stream).value());
    std::ranges::sort(sample);
    // Kolmogorov's distance; 1.95 is passed once in a thousand
    double distance = 0;
    for (int k = 0; k < rows; ++k)
      distance = std::max(distance, std::abs(normal_probability(standard_at(law, sample[static_cast<std::size_t>(k)])) -
                                             (k + 0.5) / rows));
    EXPECT_LT(distance * std::sqrt(rows), 1.95) << name;
  }
  RandomStream stream(1, "never");
  EXPECT_FALSE(draw(make_law(Law::normal, 0, 1, 6, 9), stream));
}

// the numbers that samples of studies have always had
TEST(Distribution, DrawsKeepTheirBits) {
  const auto streams = [](const char* name) { return std::pair{RandomStream(3, name), RandomStream(3, name)}; };
  auto [one, other] = streams("lognormal");
  const double ratio = 4.0 / 8, variance = portable::log(1 + ratio * ratio);
  for (int k = 0; k < 100; ++k)
    EXPECT_EQ(draw(make_law(Law::lognormal, 8, 4), one).value(),
              portable::exp(portable::log(8) - variance / 2 + std::sqrt(variance) * other.normal()));
  for (int k = 0; k < 100; ++k) {
    EXPECT_EQ(draw(make_law(Law::normal, 40, 3), one).value(), 40 + 3 * other.normal());
    EXPECT_EQ(draw({Law::seed}, one).value(), std::floor(1e15 * other.uniform()));
  }
}

TEST(Distribution, SeedsAreWholeNumbers) {
  const Distribution seed{Law::seed};
  EXPECT_EQ(value_at(seed, 0), 5e14);
  EXPECT_EQ(value_at(seed, -30), 0);
  EXPECT_EQ(value_at(seed, 30), 1e15 - 1);
  EXPECT_NEAR(standard_at(seed, value_at(seed, 1.25)), 1.25, 1e-12);
}

TEST(Distribution, Moments) {
  const auto expect = [](const Distribution& law, double mean, double deviation, double within) {
    const TwoMoments found = moments_of_cut(law);
    EXPECT_NEAR(found.mean, mean, within);
    EXPECT_NEAR(found.deviation, deviation, within);
  };
  expect(make_law(Law::lognormal, 8, 4), 8, 4, 0);
  expect(make_law(Law::uniform, 0, 0, -2, 6), 2, 8 / std::sqrt(12), 1e-15);
  expect({Law::triangular, 0, 0, 1, 0, 4}, 5.0 / 3, std::sqrt(13.0 / 18), 1e-15);
  // a half-normal
  expect(make_law(Law::normal, 0, 1, 0), std::sqrt(2 / M_PI), std::sqrt(1 - 2 / M_PI), 1e-12);
  // a lognormal whose cut takes nothing away
  expect(make_law(Law::lognormal, 8, 4, 1e-6), 8, 4, 1e-9);
  // the exponential of mean 1 cut to 0..1: m = 1 - 1/(e - 1), s² = 1 - e/(e - 1)²
  const double e = std::exp(1);
  expect(make_law(Law::exponential, 1, 0, 0, 1), 1 - 1 / (e - 1), std::sqrt(1 - e / (e - 1) / (e - 1)), 1e-12);
  expect(make_law(Law::exponential, 1, 0, 2), 3, 1, 1e-9);
}

}  // namespace
}  // namespace voussoir::distribution_test
