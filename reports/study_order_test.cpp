// unit.study_report: orders that are known because the errors were made from them.
#include "reports/study_order.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace voussoir::reports::study_order_test {
namespace {

TEST(ObservedOrder, FindsThePowerThatMadeTheErrors) {
  std::vector<KnobError> settings;
  for (const double value : {0.01, 1.0, 0.1, 0.001})  // in no order
    settings.push_back({value, 3 * std::pow(value, 2.0 / 3)});
  const auto order = observed_order(settings);
  ASSERT_TRUE(order);
  EXPECT_NEAR(order->order, 2.0 / 3, 1e-12);
  EXPECT_LT(order->uncertainty, 1e-6);
  EXPECT_EQ(order->count, 4);
  EXPECT_EQ(order->coarsest, 1.0);
  EXPECT_EQ(order->finest, 0.001);
}

TEST(ObservedOrder, IsNegativeIfMoreIsFiner) {
  std::vector<KnobError> settings;
  for (const double value : {1.0, 2.0, 4.0, 8.0})
    settings.push_back({value, 1 / (value * value)});
  EXPECT_NEAR(observed_order(settings)->order, -2, 1e-12);
}

// on the plateau the knob has no effect; the first setting that reached it is still on the line
TEST(ObservedOrder, StopsWhenSomethingElseLimitsTheError) {
  std::vector<KnobError> settings;
  for (const double value : {1.0, 0.1, 0.01, 0.001, 1e-4, 1e-5})
    settings.push_back({value, std::max(value, 0.001)});
  const auto order = observed_order(settings);
  ASSERT_TRUE(order);
  EXPECT_EQ(order->count, 4);
  EXPECT_NEAR(order->order, 1, 1e-12);
}

// two standard errors of a line through four points with residuals ±r, by hand: x = -1.5, -0.5, 0.5, 1.5 steps
TEST(ObservedOrder, StatesItsUncertainty) {
  const double step = std::log(10.0), r = 0.1;
  std::vector<KnobError> settings;
  const double wave[] = {r, -r, -r, r};  // sums to zero, and is uncorrelated with x
  for (int k = 0; k < 4; ++k)
    settings.push_back({std::pow(10.0, -k), std::exp(-k * step + wave[k])});
  const auto order = observed_order(settings);
  ASSERT_TRUE(order);
  EXPECT_NEAR(order->order, 1, 1e-12);
  EXPECT_NEAR(order->uncertainty, 2 * std::sqrt(4 * r * r / 2 / (5 * step * step)), 1e-12);
}

TEST(ObservedOrder, IsNoneIfNothingFalls) {
  EXPECT_FALSE(observed_order({{1, 0.1}, {0.1, 0.1}, {0.01, 0.1}, {0.001, 0.1}}));
  EXPECT_FALSE(observed_order({{1, 0.1}, {0.1, 0.01}})) << "two points are always on a line";
  EXPECT_FALSE(observed_order({{1, 0.1}, {0.1, 0.011}, {0.01, 0.012}, {0.001, 0.01}})) << "one step, then flat";
  EXPECT_FALSE(observed_order({{1, 0.1}, {0.1, 0.9}, {0.01, 0.2}, {0.001, 0.04}})) << "scatter";
  EXPECT_FALSE(observed_order({}));
}

}  // namespace
}  // namespace voussoir::reports::study_order_test
