#include "reference/small/rocking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "reference/small/small.hpp"

namespace voussoir::reference::rocking_test {
namespace {

TEST(Rocking, IsHousnersForSlenderBlocks) {
  const RockingBlock slender{0.1, 10};
  const double lean = 0.4 * slenderness(slender), linear = housner_quarter_period(slender, lean);
  EXPECT_NEAR(rigid_quarter_period(slender, lean) / linear, 1, 1e-4);  // the square of alpha
  EXPECT_NEAR(linear, std::acosh(1 / 0.6) / rocking_frequency(slender), 1e-12);
  EXPECT_THROW(housner_quarter_period(slender, 0.2), std::invalid_argument);
}

// A pendulum from above: falling outwards from a lean beyond alpha is the same motion (Legendre's integrals).
TEST(Rocking, IsAPendulum) {
  const RockingBlock block{1, 4};
  const double alpha = slenderness(block), lean = 0.5 * alpha, radius = 0.5 * std::hypot(1.0, 4.0);
  const double mass = 1, inertia = 4.0 / 3 * radius * radius;
  EXPECT_NEAR(rigid_quarter_period(block, lean),
              fall_over_time({mass, inertia, radius, alpha - lean, block.gravity}, alpha), 1e-8);
}

TEST(Rocking, TakesLongerOnAnElasticBase) {
  const RockingBlock block;
  const double lean = 0.5 * slenderness(block), rigid = rigid_quarter_period(block, lean);
  const double delay = elastic_quarter_period(block, lean, 1e11, 1e11) - rigid;
  EXPECT_GT(delay, 0);
  // the contact length is proportional to the root of the compliance, and so is the delay
  EXPECT_NEAR((elastic_quarter_period(block, lean, 1e13, 1e13) - rigid) / delay, 0.1, 0.01);
  // it comes upright then, with the acceleration p² α of an upright block
  const double quarter = elastic_quarter_period(block, lean, 1e11, 1e11), before = 5e-3;
  const double late = elastic_turn(block, lean, 1e11, 1e11, quarter - before),
               earlier = elastic_turn(block, lean, 1e11, 1e11, quarter - 2 * before);
  const double gained = std::pow(rocking_frequency(block) * before, 2) * slenderness(block);
  EXPECT_NEAR(late + (late - earlier) + gained, lean, 0.1 * gained);
  // energy: the weight's arm is shorter by a third of the contact length, a sixth of which is due to the turned axis
  double slow = 0;
  const double weight = 2500 * 4 * 9.81, radius = 0.5 * std::hypot(1.0, 4.0), mass = 1e4;
  const auto potential = [&](double q) {
    return weight * (radius * std::cos(slenderness(block) - q) - 2.0 / 3 * std::sqrt(2 * weight * q / 1e11));
  };
  for (int i = 0; i < 20'000; ++i) {
    const double u = (i + 0.5) / 20'000, q = lean * (1 - u * u), a = std::sqrt(2 * weight / (1e11 * q));
    const double x = radius * std::sin(slenderness(block) - q) - 0.5 * a, y = radius * std::cos(slenderness(block) - q);
    const double inertia = mass * radius * radius / 3 + mass * (x * x + y * y);
    slow += 2 * lean * u / 20'000 / std::sqrt(2 / inertia * (potential(lean) - potential(q)));
  }
  EXPECT_NEAR(delay / (slow - rigid), 1, 0.1);  // its corner neither rolls nor yields sideways
}

TEST(Rocking, LiftsOffItsBase) {
  const RockingBlock block;
  const double weight = 2500 * 4 * 9.81, k = 1e9, lift = 2 * weight / k;
  EXPECT_NEAR(base_moment(block, lift, k), weight / 6, 1e-6);  // the middle third
  EXPECT_NEAR(base_moment(block, (1 + 1e-9) * lift, k), weight / 6, 1e-3);
  EXPECT_NEAR(base_moment(block, 1e8 * lift, k), weight / 2, 1e-4 * weight);
  EXPECT_NEAR(housner_restitution(block), 1 - 1.5 / 17, 1e-15);
}

}  // namespace
}  // namespace voussoir::reference::rocking_test
