#include "reference/key_blocks/shared_cohesion.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "reference/key_blocks/slope_wedge.hpp"
#include "text/angle.hpp"

using voussoir::degree;

namespace voussoir::reference::shared_cohesion_test {
namespace {

// Hoek & Bray's wedge in feet and pounds
ElasticWedge hoek_and_bray(double cohesion_a = 500, double cohesion_b = 1000) {
  ElasticWedge block;
  block.area_a = 5565.007845;
  block.area_b = 6428.125399;
  block.wedge.weight = 28272195.4;
  block.wedge.a = {45 * degree, 105 * degree, 20 * degree, cohesion_a * block.area_a, 0};
  block.wedge.b = {70 * degree, 235 * degree, 30 * degree, cohesion_b * block.area_b, 0};
  return block;
}
constexpr double plastic = 1.735576747, friction = 1.106620;

TEST(SharedCohesion, WorkedValues) {
  const ElasticWedge block = hoek_and_bray();
  EXPECT_NEAR(first_slip_factor(block, 1), 0.661565, 1e-6);
  EXPECT_NEAR(brittle_factor(block, 1), friction, 1e-6);
  EXPECT_NEAR(brittle_factor(block, 0.1), 1.433807, 1e-6);
  EXPECT_NEAR(brittle_factor(block, 0.01), 1.599971, 1e-6);
  EXPECT_NEAR(brittle_factor(block, 0.001), 1.615952, 1e-6);
  EXPECT_NEAR(brittle_factor(block, 0), 1.617707, 1e-6);
}

// in SI: 1e8 Pa/m and 1 mm
TEST(SharedCohesion, WorkedValuesOfSoftening) {
  ElasticWedge block = hoek_and_bray();
  constexpr double square_foot = 0.3048 * 0.3048, pound = 4.4482216152605;
  for (double* area : {&block.area_a, &block.area_b})
    *area *= square_foot;
  for (double* force : {&block.wedge.weight, &block.wedge.a.cohesion_force, &block.wedge.b.cohesion_force})
    *force *= pound;
  EXPECT_NEAR(softening_factor(block, 0, 1e-2, 1e8), 1.73415, 1e-5);
  EXPECT_NEAR(softening_factor(block, 0, 1e-3, 1e8), 1.71987, 1e-5);
  EXPECT_NEAR(softening_factor(block, 0, 3e-4, 1e8), 1.67034, 1e-5);
  EXPECT_NEAR(softening_factor(block, 0.5, 1e-3, 1e8), 1.72830, 1e-5);
  // limits: what slip leaves completely, and slip without end
  EXPECT_NEAR(softening_factor(block, 1, 1e-3, 1e8), plastic, 1e-7);
  EXPECT_NEAR(softening_factor(block, 0, 100, 1e8), plastic, 1e-5);
  EXPECT_THROW(softening_factor(block, 0, 1e-5, 1e8), std::invalid_argument);
}

TEST(SharedCohesion, LimitsOfStiffness) {
  const ElasticWedge block = hoek_and_bray();
  EXPECT_NEAR(first_slip_factor(block, 1e-9), first_slip_factor(block, 0), 1e-6);
  // without cohesion no joint has anything to lose
  EXPECT_NEAR(brittle_factor(hoek_and_bray(0, 0), 1), friction, 1e-6);
  // scaling: weight and cohesion together
  ElasticWedge heavy = block;
  heavy.wedge.weight *= 7;
  heavy.wedge.a.cohesion_force *= 7;
  heavy.wedge.b.cohesion_force *= 7;
  EXPECT_NEAR(first_slip_factor(heavy, 0.3), first_slip_factor(block, 0.3), 1e-12);
}

}  // namespace
}  // namespace voussoir::reference::shared_cohesion_test
