// The cone program by itself: a block on a floor in the plane, forces of a given size, programs without an optimum.
#include "core/solvers/cone_program.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace voussoir::cone_program_test {
namespace {

using Plane = ConeProgram<3, 2>;

// A block of weight 1, as wide as 1, on a floor with this friction; pushed by its weight at this height. Freedoms: x,
// y, moment about the middle of its base.
Plane block(double friction, double height) {
  Plane program;
  program.right_side = Eigen::Vector3d(0, 1, 0);
  program.live = Eigen::Vector3d(1, 0, -height);
  for (const double place : {-0.5, 0.5}) {
    ForceCone<3, 2> corner;
    corner.body_b = 0;
    corner.on_b << 0, std::sin(friction), std::cos(friction), 0, place * std::cos(friction), 0;
    program.cones.push_back(corner);
  }
  return program;
}

TEST(ConeProgram, FindsWhereABlockSlidesOrTopples) {
  for (const double friction : {1e-3, 0.1, 0.5, 1.5}) {
    const ConeProgramAnswer low = solve(block(friction, 0));
    ASSERT_EQ(low.status, ConeStatus::optimal);
    EXPECT_NEAR(low.factor, std::tan(friction), 1e-9 * (1 + std::tan(friction)));
    EXPECT_NEAR(low.value, -low.factor, 1e-12 * (1 + low.factor));
    EXPECT_NEAR(low.bound, low.value, 1e-9 * (1 + low.factor));
    const ConeProgramAnswer high = solve(block(friction, 2));
    ASSERT_EQ(high.status, ConeStatus::optimal);
    EXPECT_NEAR(high.factor, std::min(std::tan(friction), 0.25), 1e-9);
    // the multipliers are a mechanism in which the live load has the power 1
    EXPECT_NEAR(block(friction, 2).live.dot(high.y), -1, 1e-9);
  }
}

// Cohesion alone: shear of a given size, whatever presses.
TEST(ConeProgram, KeepsGivenHeads) {
  Plane program = block(0, 0);
  for (const double strength : {0.3, 0.7}) {
    ForceCone<3, 2> shear;
    shear.body_b = 0;
    shear.on_b << 0, 1, 0, 0, 0, 0;
    shear.head = strength;
    program.cones.push_back(shear);
  }
  const ConeProgramAnswer answer = solve(program);
  ASSERT_EQ(answer.status, ConeStatus::optimal);
  EXPECT_NEAR(answer.factor, 1, 1e-9);
  EXPECT_NEAR(answer.x[4], 0.3, 1e-9);
  EXPECT_NEAR(answer.x[6], 0.7, 1e-9);
  EXPECT_NEAR(answer.heads[2], -1, 1e-8) << "more of it carries as much more";
}

TEST(ConeProgram, KnowsThatThereIsNoOptimum) {
  Plane pressed = block(0.5, 0);
  pressed.live = Eigen::Vector3d(0, -1, 0);  // onto the floor
  EXPECT_EQ(solve(pressed).status, ConeStatus::unbounded);
  Plane lifted = block(0.5, 0);
  lifted.right_side = Eigen::Vector3d(0, -1, 0);  // off the floor, and pushing does not help
  const ConeProgramAnswer falls = solve(lifted);
  ASSERT_EQ(falls.status, ConeStatus::infeasible);
  EXPECT_GT(lifted.right_side.dot(falls.y), 0) << "the load drives a mechanism";
}

TEST(ConeProgram, GivesTheSameBitsAgain) {
  const ConeProgramAnswer once = solve(block(0.4, 1)), again = solve(block(0.4, 1));
  EXPECT_EQ(once.factor, again.factor);
  EXPECT_EQ(once.x, again.x);
}

}  // namespace
}  // namespace voussoir::cone_program_test
