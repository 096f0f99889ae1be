#include "reference/small/bolts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace voussoir::reference::bolts_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

TEST(Bolts, OverAJointByPythagoras) {
  EXPECT_DOUBLE_EQ(bolt_over_joint(10, 3, 5, 0, 4), 25);
  EXPECT_DOUBLE_EQ(bolt_over_joint(10, 3, 5, -1, 0), -5);
}

TEST(Bolts, ShareAPretensionWithTheJointLikeTwoSpringsInARow) {
  const double left = pretension_left(100, 2, 4, 3);
  EXPECT_NEAR((100 - left) / 2, left / 12, 1e-12) << "the bolt shortens by the closure of the joint";
}

TEST(Bolts, HoldABlockByForceAndByPressure) {
  EXPECT_NEAR(bolted_block_friction(100, 40 * degree, 0, 0), 40 * degree, 1e-12);
  const double phi = bolted_block_friction(100, 40 * degree, 20, 30 * degree);
  EXPECT_NEAR(phi / degree, 28.4672, 5e-5);
  const double along = 100 * std::sin(40 * degree) - 20 * std::cos(30 * degree),
               across = 100 * std::cos(40 * degree) + 20 * std::sin(30 * degree);
  EXPECT_NEAR(along, across * std::tan(phi), 1e-9);
}

}  // namespace
}  // namespace voussoir::reference::bolts_test
