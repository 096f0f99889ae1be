#include "reference/small/block_on_joint.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>

#include "reference/small/small.hpp"
#include "reference/small/toppling.hpp"
#include "text/angle.hpp"

namespace voussoir::reference::block_on_joint_test {
namespace {

BlockOnJoint block_at(double slope_deg, double friction_deg, double stiffness = 100e9) {
  BlockOnJoint block;
  block.slope = slope_deg * degree;
  block.friction_angle = friction_deg * degree;
  block.normal_stiffness = block.shear_stiffness = stiffness;
  return block;
}

// loaded as in the case
BlockOnJoint loaded(double slope_deg, double friction_deg, double stiffness = 100e9) {
  BlockOnJoint block = block_at(slope_deg, friction_deg, stiffness);
  block.dashpot_ratio = 0.1;
  block.ramp = 0.1;
  return block;
}

double leading_order(const BlockOnJoint& block, double slope) {
  return overturning_angle(block.breadth, block.height,
                           block.density * block.breadth * block.height * block.gravity * std::cos(slope),
                           block.normal_stiffness);
}

// k/2 of the squared overlap along the line that halves the angle, point by point: across that line the overlap ends at
// the plane on one side and at the block's face on the other, within the block's sides
double energy_by_points(const BlockOnJoint& block, double above, double turn) {
  const double b = block.breadth, h = block.height, c = std::cos(turn), s = std::sin(turn);
  // the face's middle, its direction down the slope, its normal into the block
  const double mx = -0.5 * h * s, my = above - 0.5 * h * c;
  const double half = 0.5 * turn, along_x = std::cos(half), along_y = -std::sin(half);
  // intersection of face and plane
  const double tip = mx + my / s * c;
  constexpr int points = 200'000;
  const double reach = 2 * b, step = reach / points;
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    const double at = (i + 0.5) * step, x = tip + at * along_x, y = at * along_y;
    const double side = (x - mx) * c - (y - my) * s;  // along the face, from its middle
    if (std::abs(side) > 0.5 * b) continue;
    const double u = 2 * at * std::tan(half);
    sum += u * u * step;
  }
  return 0.5 * block.normal_stiffness * sum;
}

TEST(BlockOnJoint, IsPressedByTheOverlap) {
  const BlockOnJoint block;
  for (const double turn : {1e-3, 0.02, 0.3, 0.8}) {
    for (const double pressed : {0.1, 0.7, 1.5}) {  // of the face; beyond 1 both corners are beneath the plane
      const double low = 0.5 * (std::sin(turn) + 2 * std::cos(turn)), above = low - pressed * std::sin(turn);
      const JointPress p = press_on_joint(block, above, turn);
      EXPECT_NEAR(p.energy / energy_by_points(block, above, turn), 1, 1e-3) << turn << ' ' << pressed;
      const double d = 1e-4 * pressed * std::sin(turn);  // its error is 1e-8 of the force, and its rounding as much
      const auto energy = [&](double up, double over) { return press_on_joint(block, above + up, turn + over).energy; };
      EXPECT_NEAR((energy(-d, 0) - energy(d, 0)) / (2 * d) / p.force, 1, 1e-7);
      EXPECT_NEAR((energy(0, -d) - energy(0, d)) / (2 * d), p.moment, 1e-7 * p.force);
      const JointPress mirrored = press_on_joint(block, above, -turn);
      EXPECT_EQ(mirrored.force, p.force);
      EXPECT_EQ(mirrored.moment, -p.moment);
    }
  }
  const JointPress level = press_on_joint(block, 0.999, 0);
  EXPECT_NEAR(level.force, 100e9 * 1e-3, 1);
  EXPECT_NEAR(level.moment, 0, 1e-3);
  EXPECT_EQ(press_on_joint(block, 1.001, 0).force, 0);
}

TEST(BlockOnJoint, IsStableUpToASlopeBelowThatOfARigidBlock) {
  const double rigid = std::atan(0.5);
  double off = 0;
  for (const double stiffness : {1e10, 1e13}) {
    const double slope = greatest_resting_slope(block_at(0, 0, stiffness));
    const double lost = rigid - slope, first = rigid - leading_order(block_at(0, 0, stiffness), slope);
    EXPECT_NEAR(lost / first, 1, 2e-3);
    // the error of the first order falls with the contact length, the cube root of the compliance
    if (off != 0) {
      EXPECT_NEAR((lost / first - 1) / off, 0.1, 0.02);
    }
    off = lost / first - 1;
  }
  EXPECT_NEAR(greatest_resting_slope(block_at(0, 0, 1e20)), rigid, 1e-5);
  EXPECT_THROW(greatest_resting_slope(block_at(0, 0, 1e5)), std::invalid_argument);
  EXPECT_THROW(greatest_resting_slope(block_at(0, 0, 0)), std::invalid_argument);
}

// Loaded slowly the block topples at slopes that no turn balances; loaded suddenly, at less.
TEST(BlockOnJoint, TopplesEarlierTheFasterItIsLoaded) {
  const double rests = greatest_resting_slope(BlockOnJoint{}) / degree;
  const auto topples = [](double slope_deg, double ramp) {
    BlockOnJoint block = loaded(slope_deg, 40);
    block.ramp = ramp;
    return start_on_joint(block, 0.1, ramp + 6).turn >= 0.1;
  };
  EXPECT_TRUE(topples(rests + 0.01, 2));
  EXPECT_FALSE(topples(rests - 0.02, 2));
  EXPECT_TRUE(topples(rests - 0.02, 0.1));
  EXPECT_FALSE(topples(rests - 0.1, 0.1));
  EXPECT_TRUE(topples(rests - 0.1, 0));
}

TEST(BlockOnJoint, SlidesAndFallsAsARigidBlock) {
  // upright down the slope, as fast as gravity grows
  const double g = 9.81, ramp = 0.1, slope = 20 * degree, time = 0.5, after = time - ramp;
  const double pull = g * (std::sin(slope) - std::tan(15 * degree) * std::cos(slope));
  const double way = pull * (ramp * ramp / 6 + ramp * after / 2 + after * after / 2);
  EXPECT_NEAR(start_on_joint(loaded(20, 15), 1, time).slip / way, 1, 2e-3);
  // held by the joint's elastic shear, all in contact
  const double sheared = 2500 * 2 * g * std::sin(5 * degree) / 100e9;
  EXPECT_NEAR(start_on_joint(loaded(5, 30), 1, time).slip / sheared, 1, 0.1);
  // about its corner: the contact length shortens the arm, by less the stiffer the joint
  const double tilt = 40 * degree - std::atan(0.5), turn = 0.5;
  const double rigid = fall_over_time({1, 5.0 / 3, 0.5 * std::sqrt(5.0), tilt, g}, tilt + turn);
  const double soft = 1 - start_on_joint(block_at(40, 60), turn, 5).time / rigid;
  const double stiff = 1 - start_on_joint(block_at(40, 60, 1e13), turn, 5).time / rigid;
  EXPECT_NEAR(stiff, 0, 2e-3);
  EXPECT_LT(std::abs(stiff), 0.3 * std::abs(soft));
}

// The foot of a toppling block sticks at Sagaseta's friction on a rigid joint, at less on an elastic one.
TEST(BlockOnJoint, NeedsLessFrictionThanARigidBlockToHoldItsFoot) {
  const double steep = 35, rigid = to_degrees(least_toppling_friction({1, 2, steep * degree, 0}));
  const auto slips = [&](double below_deg, double stiffness) {
    return start_on_joint(loaded(steep, rigid - below_deg, stiffness), 0.1, 1.2).slip;
  };
  // the displacement of a foot that sticks is proportional to the contact length, the square root of the compliance
  const double held = slips(0, 1e11), held_stiffly = slips(0, 1e12);
  EXPECT_NEAR(held_stiffly / held, std::sqrt(0.1), 0.003);
  EXPECT_LT(slips(0.3, 1e11), 1.05 * held);
  EXPECT_GT(slips(0.45, 1e11), 5 * held);
  EXPECT_LT(slips(0.1, 1e12), 1.05 * held_stiffly);
  EXPECT_GT(slips(0.2, 1e12), 5 * held_stiffly);
}

}  // namespace
}  // namespace voussoir::reference::block_on_joint_test
