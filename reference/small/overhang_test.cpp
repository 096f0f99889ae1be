#include "reference/small/overhang.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace voussoir::reference {
namespace {

OverhangStack stack_of(int blocks) {
  return {blocks, 1, 0.25, 6131.25, 1e11};
}

TEST(Overhang, IsHalfTheHarmonicSum) {
  EXPECT_DOUBLE_EQ(harmonic_overhang(stack_of(1)), 0.5);
  EXPECT_DOUBLE_EQ(harmonic_overhang(stack_of(4)), 25.0 / 24);  // the first that passes a whole length
}

// the claim of the header: weights lie (1 - s) L/2 inside, by summing centroids
TEST(Overhang, LeavesAllWeightsAlikeInside) {
  for (const double share : {1.0, 0.9}) {
    const std::vector<double> overhangs = harmonic_overhangs(stack_of(6), share);
    double edge = 0, sum = 0;  // right end of the block, from that of the top; of the centroids above
    for (int j = 0; j < 6; ++j) {
      sum += edge - 0.5;
      edge -= overhangs[j];
      EXPECT_NEAR(edge - sum / (j + 1), 0.5 * (1 - share), 1e-15) << "joint " << j + 1;
    }
  }
}

TEST(Overhang, LosesACubeRootToOneElasticJoint) {
  const OverhangStack one = stack_of(1);
  const double root = std::cbrt(2 * one.weight * one.height / (9 * one.normal_stiffness));
  const OverhangLimit limit = elastic_overhang(one);
  EXPECT_NEAR(1 - limit.share, 3 / one.length * root, 3e-8);  // twice the bracket
  EXPECT_NEAR(limit.distance[0] / root, 1, 1e-2);             // a double root: to the root of the bracket
}

TEST(Overhang, GoesByTheSameRootForMoreBlocks) {
  OverhangStack stack = stack_of(5);
  const double lost = 1 - elastic_overhang(stack).share;
  stack.normal_stiffness /= 8;
  EXPECT_NEAR((1 - elastic_overhang(stack).share) / lost, 2, 1e-5);
}

// Two blocks in the exact geometry of their turns: bodies placed on each other joint by joint, loads found from where
// the centroids come to lie. At the limit of the first order the same balance is off by second order only.
TEST(Overhang, IsRightToTheFirstOrder) {
  const OverhangStack two = stack_of(2);
  const OverhangLimit limit = elastic_overhang(two);
  const std::vector<double> overhangs = harmonic_overhangs(two, limit.share);
  const double lower = limit.tilt[1], upper = limit.tilt[0] + limit.tilt[1];  // turns of the blocks, clockwise
  const auto turned = [](double x, double y, double by) {
    return std::pair(x * std::cos(by) + y * std::sin(by), -x * std::sin(by) + y * std::cos(by));
  };
  // the lower turns about the edge of the ground, the upper about the lower's upper edge
  const auto [x1, y1] = turned(overhangs[1] - 0.5, 0.125, lower);
  const auto [ex, ey] = turned(overhangs[1], 0.25, lower);
  const auto [x2, y2] = turned(overhangs[0] - 0.5, 0.125, upper);
  const double of_upper = -x2, of_both = -0.5 * (x1 + ex + x2);
  EXPECT_NEAR(of_upper, limit.distance[0], 2 * upper * upper);
  EXPECT_NEAR(of_both, limit.distance[1], 2 * upper * upper);
}

TEST(Overhang, RefusesJointsThatAreTooSoft) {
  OverhangStack soft = stack_of(3);
  soft.normal_stiffness = 1e5;
  EXPECT_THROW(elastic_overhang(soft), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference
