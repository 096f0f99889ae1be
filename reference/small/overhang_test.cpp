#include "reference/small/overhang.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace voussoir::reference::overhang_test {
namespace {

OverhangStack stack_of(int blocks) {
  return {blocks, 1, 0.25, 6131.25, 1e11, 1e11};
}

TEST(Overhang, IsHalfTheHarmonicSum) {
  EXPECT_DOUBLE_EQ(harmonic_overhang(stack_of(1)), 0.5);
  EXPECT_DOUBLE_EQ(harmonic_overhang(stack_of(4)), 25.0 / 24);  // the first that passes a whole length
}

// the claim of the header: weights are (1 - s) L/2 inside, by summing centroids
TEST(Overhang, LeavesAllWeightsEquallyFarInside) {
  for (const double fraction : {1.0, 0.9}) {
    const std::vector<double> overhangs = harmonic_overhangs(stack_of(6), fraction);
    double edge = 0, sum = 0;  // right end of the block, from that of the top; of the centroids above
    for (int j = 0; j < 6; ++j) {
      sum += edge - 0.5;
      edge -= overhangs[j];
      EXPECT_NEAR(edge - sum / (j + 1), 0.5 * (1 - fraction), 1e-15) << "joint " << j + 1;
    }
  }
}

TEST(Overhang, LosesTheCubeRootOfTheComplianceOfOneJoint) {
  const OverhangStack one = stack_of(1);
  const double root = std::cbrt(2 * one.weight * one.height / (9 * one.normal_stiffness));
  const OverhangState limit = elastic_overhang_limit(one);
  EXPECT_NEAR((1 - limit.fraction) / (3 / one.length * root), 1, limit.turn);  // the first order
  EXPECT_NEAR(limit.distance[0] / root, 1, 0.01);  // a double root: known to the square root of the bracket
}

// The header's formula, solved for the smallest (1 - s) L/2 by stepping it down from above.
double first_order_loss(const OverhangStack& stack) {
  double low = 0, high = 0.2 * stack.length;
  while (high - low > 1e-9) {
    const double inside = 0.5 * (low + high);
    std::vector<double> x(stack.blocks, inside);
    bool stands = true;
    for (int round = 0; round < 20'000 && stands; ++round) {
      std::vector<double> next(x);
      for (int j = 1; j <= stack.blocks; ++j) {
        double sum = 0;
        for (int i = 1; i <= stack.blocks; ++i)
          sum +=
              std::pow(std::min(i, j), 2) * 2 * i * stack.weight / (9 * stack.normal_stiffness * x[i - 1] * x[i - 1]);
        next[j - 1] = inside - stack.height / (2 * j) * sum;
        stands &= next[j - 1] > 0;
      }
      x = next;
    }
    (stands ? high : low) = inside;
  }
  return 2 * high / stack.length;
}

TEST(Overhang, IsThatOfTheFirstOrderForMoreBlocks) {
  for (const int blocks : {2, 5}) {
    OverhangStack stack = stack_of(blocks);
    const OverhangState limit = elastic_overhang_limit(stack);
    EXPECT_NEAR((1 - limit.fraction) / first_order_loss(stack), 1, limit.turn) << blocks;
    stack.normal_stiffness /= 8;
    stack.shear_stiffness /= 8;
    const OverhangState softer = elastic_overhang_limit(stack);
    EXPECT_NEAR((1 - softer.fraction) / (1 - limit.fraction), 2, 2 * softer.turn) << blocks;
  }
}

TEST(Overhang, TurnsLessBelowTheLimit) {
  const OverhangStack stack = stack_of(3);
  const OverhangState limit = elastic_overhang_limit(stack), below = elastic_overhang(stack, limit.fraction - 0.001);
  EXPECT_LT(below.turn, limit.turn);
  EXPECT_THROW(elastic_overhang(stack, limit.fraction + 0.001), std::invalid_argument);
}

TEST(Overhang, RefusesJointsThatAreTooSoft) {
  OverhangStack soft = stack_of(3);
  soft.normal_stiffness = 1e5;
  EXPECT_THROW(elastic_overhang_limit(soft), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::overhang_test
