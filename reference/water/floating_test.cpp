#include "reference/water/floating.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "text/angle.hpp"

using voussoir::degree;

namespace voussoir::reference::floating_test {
namespace {

const FloatingBlock raft{2, 1, 0.6, 9.81}, tender{1.1, 1, 0.5, 9.81};

// The arm from the cut polygon itself: the block heeled by `heel` at the height at which it displaces its own weight.
double arm_by_cutting(const FloatingBlock& block, double heel) {
  const double weight = block.relative_density * block.width * block.height;
  double low = -block.width - block.height, high = -low;
  for (int halving = 0; halving < 200; ++halving) {
    const double above = 0.5 * (low + high);
    (submerged_rectangle(block.width, block.height, heel, above).volume > weight ? low : high) = above;
  }
  // heeled counter-clockwise: buoyancy to the left of the centre turns it back
  return -submerged_rectangle(block.width, block.height, heel, low).x;
}

TEST(FloatingBlock, WorkedValues) {
  EXPECT_NEAR(draught(raft), 0.6, 1e-15);
  EXPECT_NEAR(heave_period(raft), 1.553893, 5e-7);
  EXPECT_NEAR(roll_period(raft), 2.171631, 5e-7);
  EXPECT_NEAR(roll_period({3, 1, 0.6, 9.81}), 1.787146, 5e-7);  // pitch of the block 3 m long
  EXPECT_NEAR(angle_of_loll(tender) / degree, 34.696521, 5e-7);
  EXPECT_EQ(angle_of_loll(raft), 0);
}

TEST(FloatingBlock, ArmIsThatOfTheCutPolygon) {
  for (const FloatingBlock& block : {raft, tender, FloatingBlock{1, 1.4, 0.35, 1}})
    for (const double heel : {0.01, 0.1, 0.3})
      EXPECT_NEAR(std::abs(righting_arm(block, heel) - arm_by_cutting(block, heel)), 0, 1e-12 * block.width) << heel;
  EXPECT_NEAR(arm_by_cutting(tender, angle_of_loll(tender)), 0, 1e-12);
  EXPECT_GT(arm_by_cutting(tender, 1.05 * angle_of_loll(tender)), 0);
  EXPECT_LT(arm_by_cutting(tender, 0.95 * angle_of_loll(tender)), 0);
}

TEST(FloatingBlock, LimitsOfStability) {
  for (const double density : {0.05, 0.3, 0.5, 0.6, 0.9}) {
    const double ratio = least_stable_ratio(density);
    EXPECT_NEAR(metacentric_height({ratio, 1, density, 9.81}), 0, 1e-14);
    EXPECT_GT(metacentric_height({1.001 * ratio, 1, density, 9.81}), 0);
    EXPECT_LT(metacentric_height({0.999 * ratio, 1, density, 9.81}), 0);
    EXPECT_NEAR(least_stable_ratio(1 - density), ratio, 1e-14);  // the part above the water floats in the air
  }
  EXPECT_NEAR(least_stable_ratio(0.6), 1.2, 1e-14);
  EXPECT_LT(angle_of_loll({0.999999 * least_stable_ratio(0.5), 1, 0.5, 9.81}), 0.01);
  // a wide raft rolls as fast as its waterplane heaves: omega^2 = 12 g b^2/(12 d b^2) = g/d
  EXPECT_NEAR(roll_period({1e4, 1, 0.6, 9.81}) / heave_period({1e4, 1, 0.6, 9.81}), 1, 1e-6);
}

TEST(FloatingBlock, Scales) {
  const FloatingBlock large{200, 100, 0.6, 9.81}, heavy{2, 1, 0.6, 4 * 9.81};
  EXPECT_NEAR(roll_period(large), 10 * roll_period(raft), 1e-12);
  EXPECT_NEAR(heave_period(large), 10 * heave_period(raft), 1e-12);
  EXPECT_NEAR(roll_period(heavy), 0.5 * roll_period(raft), 1e-12);
  EXPECT_NEAR(angle_of_loll({110, 100, 0.5, 1}), angle_of_loll(tender), 1e-14);
}

TEST(FloatingBlock, RefusesInvalidInput) {
  EXPECT_THROW(draught({1, 1, 1.2, 9.81}), std::invalid_argument);
  EXPECT_THROW(draught({0, 1, 0.5, 9.81}), std::invalid_argument);
  EXPECT_THROW(roll_period(tender), std::invalid_argument);
  EXPECT_THROW(righting_arm(raft, 60 * degree), std::invalid_argument);
  EXPECT_THROW(angle_of_loll({0.5, 1, 0.5, 9.81}), std::invalid_argument);
}

TEST(Submerged, WorkedValues) {
  const Submerged turned = submerged_rectangle(2, 1, 20 * degree, 0.1);
  EXPECT_NEAR(turned.volume, 0.787164, 5e-7);
  EXPECT_NEAR(turned.x, -0.205147, 5e-7);
  EXPECT_NEAR(turned.y, -0.237638, 5e-7);
  EXPECT_NEAR(submerged_cube_on_corner(0.2).volume, 0.006928, 5e-7);
  EXPECT_NEAR(submerged_cube_on_corner(0.5).volume, 0.108253, 5e-7);
  EXPECT_NEAR(submerged_cube_on_corner(0.5 * std::numbers::sqrt3).volume, 0.5, 1e-12);
  EXPECT_NEAR(submerged_cube_on_corner(0.2).y, 0.15, 1e-12);
  EXPECT_NEAR(submerged_cube_on_corner(0.5).y, 0.375, 1e-12);
  EXPECT_NEAR(submerged_cube_on_corner(0.5 * std::numbers::sqrt3).y, 0.631477, 5e-7);
}

TEST(Submerged, Limits) {
  EXPECT_EQ(submerged_rectangle(2, 1, 0.3, 2).volume, 0);
  EXPECT_NEAR(submerged_rectangle(2, 1, 0.3, -2).volume, 2, 1e-14);
  EXPECT_NEAR(submerged_rectangle(2, 1, 0.3, -2).y, -2, 1e-14);
  EXPECT_NEAR(submerged_rectangle(2, 1, 0.7, 0).volume, 1, 1e-14);  // half, at any turn
  EXPECT_NEAR(submerged_cube_on_corner(std::numbers::sqrt3).volume, 1, 1e-14);
  EXPECT_NEAR(submerged_cube_on_corner(std::numbers::sqrt3).y, 0.5 * std::numbers::sqrt3, 1e-14);
  EXPECT_EQ(submerged_cube_on_corner(0).volume, 0);
  EXPECT_THROW(submerged_cube_on_corner(2), std::invalid_argument);
}

// Second derivation: sections of the cube at equal heights, each found by counting points of a fine grid.
TEST(Submerged, CubeByCountingPoints) {
  constexpr int n = 120;
  for (const double level : {0.5, 0.9, 1.3}) {
    double inside = 0, moment = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k) {
          const double height = (i + j + k + 1.5) / n / std::numbers::sqrt3;
          if (height > level) continue;
          inside += 1.0 / (n * n) / n;
          moment += height / (n * n) / n;
        }
    const Submerged found = submerged_cube_on_corner(level);
    EXPECT_NEAR(found.volume, inside, 0.02);
    EXPECT_NEAR(found.y, moment / inside, 0.01);
  }
}

}  // namespace
}  // namespace voussoir::reference::floating_test
