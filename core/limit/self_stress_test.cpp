// Blocks jammed between walls: detection by limit analysis of loads supported by forces that no load requires.
#include "core/limit/self_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/limit/limit.hpp"
#include "core/testing/limit_models.hpp"
#include "core/testing/shapes.hpp"
#include "text/angle.hpp"

namespace voussoir::self_stress_test {
namespace {

using namespace limit_models;
using shapes::integer;
using shapes::Random;
using shapes::uniform;

constexpr double bracket = 1.01e-6 * degree;  // of find_critical_friction, as the header states it

// Stones of one width in a row between two fixed walls, each inclined away from the other by `lean` upwards: below 0
// the slot opens downwards. Everything is rotated about the origin.
std::vector<TestBlock> slot(int stones, double width, double height, double lean, double turn) {
  const double half = 0.5 * stones * width, off = height * std::tan(lean);
  std::vector<TestBlock> blocks{
      {"left", {{-half, 0}, {-half - off, height}, {-half - height - off, height}, {-half - height, 0}}, true},
      {"right", {{half, 0}, {half + off, height}, {half + height + off, height}, {half + height, 0}}, true}};
  for (int k = 0; k < stones; ++k) {
    const double from = -half + k * width, to = from + width;
    blocks.push_back(
        {"stone " + std::to_string(k),
         {{from, 0}, {to, 0}, {to + (k + 1 == stones ? off : 0), height}, {from - (k == 0 ? off : 0), height}}});
  }
  for (TestBlock& block : blocks)
    block.corners = turned(block.corners, turn);
  return blocks;
}

// Between parallel walls any friction above zero holds a row of stones, with sufficient normal force.
TEST(SelfStress, BetweenParallelWallsHoldsAtAnyFrictionAboveZero) {
  Random random(11);
  for (int i = 0; i < 40; ++i) {
    const int stones = i % 4 == 0 ? 1 : integer(random, 1, 12);
    const Model<2> model =
        model_of(slot(stones, uniform(random, 0.2, 2), uniform(random, 0.5, 2), 0, uniform(random, -60, 60) * degree));
    EXPECT_EQ(critical_friction(model).status, LimitStatus::not_attained) << i << ": " << stones;
    EXPECT_EQ(factor_of_safety(model).status, LimitStatus::not_attained) << i << ": " << stones;
  }
}

// A stone between a wall and a block that only friction holds between a floor and a roof: self-stress of second order.
TEST(SelfStress, MayDependOnAnotherSelfStress) {
  const Model<2> model = model_of({{"floor", box(0, -1, 2, 0), true},
                                   {"roof", box(0, 1, 2, 2), true},
                                   {"between", box(0, 0, 1, 1)},
                                   {"wall", box(-3, 0, -1, 1), true},
                                   {"stone", box(-1, 0, 0, 1)}});
  EXPECT_EQ(critical_friction(model).status, LimitStatus::not_attained);
  // without the roof the block can move: the stone then needs all of its own friction to push the block
  Model<2> open = model;
  for (Body<2>& body : open.bodies)
    body.present = body.name != "roof";
  const CriticalStrength<2> found = critical_friction(open);
  EXPECT_EQ(found.status, LimitStatus::found);
}

// Walls inclined inwards by `lean` hold a stone from a friction angle of `lean` on: two cones then face each other.
// Walls inclined outwards hold it without friction.
TEST(SelfStress, InASlotThatOpensDownwardsIsReported) {
  Random random(12);
  for (int i = 0; i < 40; ++i) {
    const double lean = uniform(random, 0.5, 25) * degree, height = 1, width = uniform(random, 1.2, 2);
    const Model<2> opens_below = model_of(slot(1, width, height, -lean, 0));
    const CriticalStrength<2> found = critical_friction(opens_below);
    ASSERT_EQ(found.status, LimitStatus::found) << lean / degree;
    // forces grow without bound towards it, so that the bracket may stay wider
    EXPECT_LE(found.collapses, lean + bracket);
    EXPECT_GE(found.stands, lean - bracket);
    EXPECT_LE(found.stands, 1.01 * found.collapses);
    EXPECT_FALSE(found.self_stress.empty());
    const CriticalStrength<2> factor = factor_of_safety(opens_below);
    ASSERT_EQ(factor.status, LimitStatus::found) << lean / degree;
    const double exact = std::tan(30 * degree) / std::tan(lean);
    EXPECT_LE(factor.stands, exact * (1 + 1e-6));
    EXPECT_GE(factor.collapses, exact * (1 - 1e-6));
    EXPECT_LE(factor.collapses, 1.02 * factor.stands);
    EXPECT_FALSE(factor.self_stress.empty());

    const Model<2> opens_above = model_of(slot(1, width, height, lean, 0));
    const CriticalStrength<2> wedged = critical_friction(opens_above);
    EXPECT_EQ(wedged.status, LimitStatus::carries_any);
    EXPECT_TRUE(wedged.self_stress.empty());
  }
}

// Friction due to the load's own normal force, and a jam that is not part of the mechanism, are not reported.
TEST(SelfStress, IsNotReportedForLoadsThatCompressTheirJoints) {
  Random random(13);
  for (int i = 0; i < 20; ++i) {
    const double dip = uniform(random, 2, 25) * degree;
    const Model<2> model = block_on_plate(2, 0.1, dip);
    const CriticalStrength<2> found = critical_friction(model);
    ASSERT_EQ(found.status, LimitStatus::found);
    EXPECT_NEAR(found.stands, dip, bracket);
    EXPECT_TRUE(found.self_stress.empty());
  }
  // a stone on a floor between walls, next to a sliding block
  std::vector<TestBlock> blocks = slot(1, 1, 1, 0, 0);
  blocks.push_back({"floor", box(-0.5, -1, 0.5, 0), true});
  EXPECT_TRUE(critical_friction(model_of(blocks)).self_stress.empty());
  for (TestBlock block : {TestBlock{"plate", turned(box(-3, -1, 3, 0), 0.2), true},
                          TestBlock{"block", turned(box(-1, 0, 1, 0.1), 0.2)}}) {
    for (Vector<2>& p : block.corners)
      p[0] += 20;
    blocks.push_back(block);
  }
  const Model<2> model = model_of(blocks);
  const CriticalStrength<2> found = critical_friction(model);
  ASSERT_EQ(found.status, LimitStatus::found);
  EXPECT_NEAR(found.stands, 0.2, bracket);
  EXPECT_TRUE(found.self_stress.empty());
}

}  // namespace
}  // namespace voussoir::self_stress_test
