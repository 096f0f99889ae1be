#include "reference/small/toppling.hpp"
#include "text/angle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace voussoir::reference::toppling_test {
namespace {

InclinedBlock block_at(double slope_deg, double friction_deg) {
  return {1, 2, slope_deg * degree, friction_deg * degree};
}

TEST(Toppling, HasFourModes) {
  EXPECT_EQ(block_mode(block_at(20, 30)), BlockMode::stays);
  EXPECT_EQ(block_mode(block_at(20, 15)), BlockMode::slides);
  EXPECT_EQ(block_mode(block_at(40, 50)), BlockMode::topples);
  EXPECT_EQ(block_mode(block_at(40, 28)), BlockMode::slides_and_topples);
}

TEST(Toppling, IsThatOfStaticsInEquilibrium) {
  for (double slope = 1; slope < 60; slope += 1.7)
    for (double friction = 1; friction < 60; friction += 1.7) {
      const InclinedBlock block = block_at(slope, friction);
      EXPECT_EQ(block_mode(block) == BlockMode::stays, block_mode_of_statics(block) == BlockMode::stays);
    }
  // the two maps differ if inertia matters
  EXPECT_EQ(block_mode_of_statics(block_at(40, 20)), BlockMode::slides_and_topples);
  EXPECT_EQ(block_mode(block_at(40, 20)), BlockMode::slides);
  EXPECT_EQ(block_mode_of_statics(block_at(40, 35)), BlockMode::slides_and_topples);
  EXPECT_EQ(block_mode(block_at(40, 35)), BlockMode::topples);
}

TEST(Toppling, NeedsTheFrictionOfABlockThatTurns) {
  // all borders meet where the block is just about to topple
  EXPECT_NEAR(least_toppling_friction(block_at(std::atan(0.5) / degree + 1e-9, 30)), std::atan(0.5), 1e-9);
  EXPECT_THROW(least_toppling_friction(block_at(20, 30)), std::invalid_argument);

  // Newton's laws of a block that turns about its corner: acceleration of the centroid from moments about it
  const double b = 1, h = 2, slope = 35 * degree, g = 9.81;
  double low = 0, high = 100;  // of the angular acceleration
  for (int i = 0; i < 200; ++i) {
    const double a = 0.5 * (low + high);
    const double along = g * std::sin(slope) - 0.5 * a * h,
                 into = g * std::cos(slope) + 0.5 * a * b;   // of the plane, on the block
    const double moment = along * 0.5 * h - into * 0.5 * b;  // about the centroid, over the mass
    (moment > a * (b * b + h * h) / 12 ? low : high) = a;
  }
  const double needed = std::atan((g * std::sin(slope) - 0.5 * low * h) / (g * std::cos(slope) + 0.5 * low * b));
  EXPECT_NEAR(least_toppling_friction(block_at(35, 30)), needed, 1e-12);
  EXPECT_NEAR(needed / degree, 28.67, 0.02);
}

TEST(Toppling, ComesEarlierOnElasticJoints) {
  // largest slope at which some turn of the block balances it: moments about the end of the face, exact in the turn
  const double b = 1, h = 2, force = 44e3, stiffness = 1e10;
  const double angle = overturning_angle(b, h, force, stiffness);
  double best = 0;
  for (double turn = 1e-4; turn < 0.02; turn *= 1.0005) {
    const double pressed = std::sqrt(2 * force / (stiffness * turn));
    const double x = 0.5 * b - pressed / 3, y = 0.5 * h;  // of the centroid, from the force: inwards, upwards
    best = std::max(best, std::atan(x / y) - turn);
  }
  EXPECT_NEAR(angle, best, 2e-3 * (std::atan(0.5) - best) + 2e-4);
  EXPECT_LT(angle, std::atan(0.5));
  // an eighth of the stiffness doubles the loss
  const double lost = std::atan(0.5) - angle, more = std::atan(0.5) - overturning_angle(b, h, force, stiffness / 8);
  EXPECT_NEAR(more / lost, 2, 0.1);
  EXPECT_THROW(overturning_angle(b, h, force, 1e5), std::invalid_argument);
}

// Hoek & Bray (1981, chapter 9): the heights of their table, and limiting equilibrium near tan = 0.7855
TEST(SteppedColumns, HaveThePublishedHeightsAndFriction) {
  const SteppedColumns slope;
  EXPECT_DOUBLE_EQ(slope.height(1), 4);
  EXPECT_DOUBLE_EQ(slope.height(10), 40);
  EXPECT_NEAR(slope.height(16), 2.8, 1e-12);
  EXPECT_NEAR(std::tan(stepped_columns_friction(slope)), 0.7855, 0.0005);
}

}  // namespace
}  // namespace voussoir::reference::toppling_test
