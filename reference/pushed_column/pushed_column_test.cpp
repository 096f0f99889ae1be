#include "reference/pushed_column/pushed_column.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace voussoir::reference {
namespace {

// worked by hand: W = 73,575 N/m, W b/(2 y) = 12,262.5 N/m; joint of 10 GPa/m, first order at a tilt of 5 mrad:
// a = 0.054249 m, so with y = 3 m, F = 73,575 (0.5 - 0.018083 - 0.0075)/(3 + 0.0025) = 11,625.4 N/m
TEST(PushedColumn, WorkedByHand) {
  const PushedColumn column;
  EXPECT_NEAR(rigid_push(column, {0, 3}), 12'262.5, 1e-9);
  constexpr double left_out = 5e-3 * 0.052;  // neglected by the first order: that fraction of the joint's effect
  EXPECT_NEAR(push_at(column, {0, 3}, 5e-3) / 11'625.4, 1, left_out);
  EXPECT_NEAR(push_at(column, {0, 3, true}, 5e-3) / 11'635.1, 1, left_out);
  // of a force that turns only the line of action matters
  EXPECT_NEAR(push_at(column, {0, 3, true}, 5e-3), push_at(column, {-0.5, 3, true}, 5e-3), 1e-7);
  EXPECT_LT(push_at(column, {-0.5, 3}, 5e-3), push_at(column, {0, 3}, 5e-3)) << "its point rises";
}

// Strips of the base in contact, each pressed along the normal half way, and the residual forces and moments about the
// middle of the upright base: the balance that the closed form takes about another point.
TEST(PushedColumn, BalancesTheSumOfItsPressures) {
  for (const bool turns : {false, true})
    for (const double tilt : {2e-3, 2e-2}) {
      const PushedColumn c{1.2, 2.5, 6e4, 3e9};
      const Push push{-0.4, 2.1, turns};
      const double force = push_at(c, push, tilt), half = 0.5 * tilt, nx = std::sin(half), ny = std::cos(half);
      const double fx = turns ? force * std::cos(tilt) : force, fy = turns ? -force * std::sin(tilt) : 0;
      // required force of the joint, its part along the normal, and the length that gives it
      const double jx = -fx, jy = c.weight - fy, normal = jx * nx + jy * ny, shear = jx * ny - jy * nx;
      constexpr int strips = 4000;
      double length = 0.1, sum = 0, moment = 0;
      for (int round = 0; round < 40; ++round) {
        sum = moment = 0;
        for (int i = 0; i < strips; ++i) {
          const double s = (i + 0.5) * length / strips,
                       pressed = c.stiffness * 2 * s * std::tan(half) * length / strips;
          sum += pressed;
          // at (s cos, -s sin) along that plane, its origin the end that is lifted
          moment += pressed * (s * std::cos(half) * ny + s * std::sin(half) * nx);
        }
        length *= std::sqrt(normal / sum);
      }
      moment *= normal / sum;
      const double centre = 2.0 / 3 * length;
      moment += shear * (centre * std::cos(half) * -nx + centre * std::sin(half) * ny);
      // the column from that end: along the base, and up from it
      const auto at = [&](double x, double y) {
        const double along = length * std::cos(half) - 0.5 * c.breadth + x;
        return std::pair(along * std::cos(tilt) + y * std::sin(tilt), -along * std::sin(tilt) + y * std::cos(tilt));
      };
      moment -= at(0, 0.5 * c.height).first * c.weight;
      const auto [px, py] = at(push.x, push.y);
      moment += px * fy - py * fx;
      EXPECT_NEAR(moment / (c.weight * c.breadth), 0, 1e-6) << turns << ", " << tilt;
    }
}

TEST(PushedColumn, ApproachesTheRigidForceByTheCubeRootOfTheCompliance) {
  PushedColumn column;
  const Push push{0, 3, true};
  double last = 0;
  for (const double stiffness : {1e10, 1e12, 1e14}) {
    column.stiffness = stiffness;
    const Tipping limit = tipping(column, push);
    // the first order: tilt³ = 2W/(9 k h²), 3/2 h tilt lost of b/2
    const double tilt = std::cbrt(2 * column.weight / (9 * stiffness * 9));
    EXPECT_NEAR(limit.tilt / tilt, 1, 4 * tilt);
    const double lost = 1 - limit.force / rigid_push(column, push);
    EXPECT_NEAR(lost / (1.5 * 3 * tilt / 0.5), 1, 4 * tilt);
    if (last > 0) {
      EXPECT_NEAR(last / lost, std::cbrt(100.0), 0.1);
    }
    last = lost;
  }
}

TEST(PushedColumn, IsIndependentOfUnits) {
  const PushedColumn one{1, 3, 7e4, 1e10}, other{0.2, 0.6, 7e4 * 25, 1e10 * 25 / 0.04};
  const Tipping a = tipping(one, {-0.3, 2}), b = tipping(other, {-0.06, 0.4});
  EXPECT_NEAR(a.force / one.weight, b.force / other.weight, 1e-9);
  EXPECT_NEAR(a.tilt, b.tilt, 1e-6);  // a flat maximum
}

TEST(PushedColumn, HasItsStableEquilibriumBelowTheLargestForceOnly) {
  const PushedColumn column;
  const Push push{-0.5, 3};
  const Tipping limit = tipping(column, push);
  const double tilt = tilt_under(column, push, 0.99 * limit.force);
  EXPECT_LT(tilt, limit.tilt);
  EXPECT_NEAR(push_at(column, push, tilt), 0.99 * limit.force, 1e-9 * limit.force);
  EXPECT_THROW(tilt_under(column, push, 1.001 * limit.force), std::invalid_argument);
  EXPECT_THROW(tilt_under(column, push, 0.1 * limit.force), std::invalid_argument) << "on its whole base";
  EXPECT_THROW(push_at(column, push, 1e-6), std::invalid_argument);
  EXPECT_THROW(push_at(column, push, 0), std::invalid_argument);
}

TEST(FreeBlock, MovesByTheIntegralsOfItsForce) {
  // from rest at the crest of the force: F/(m ω²) (1 - cos ωt); from its zero the block drifts with F/(m ω)
  const double w = 7, pi = std::acos(-1.0);
  EXPECT_NEAR(shaken_ride(3, w, pi / 2, 0.4).way, 3 / (w * w) * (1 - std::cos(w * 0.4)), 1e-14);
  EXPECT_NEAR(shaken_ride(3, w, 0, 2 * pi / w).way, 3 / w * 2 * pi / w, 1e-14);
  EXPECT_NEAR(shaken_ride(3, w, 0, 2 * pi / w).velocity, 0, 1e-14);
  EXPECT_NEAR(shaken_ride(3, 1e-5, pi / 2, 0.5).way, 0.5 * 3 * 0.25, 1e-5) << "a constant force";
}

TEST(FreeBlock, SpinsUpAlongFresnelsIntegrals) {
  // for small turns the sideways displacement is a α t⁴/24
  const Spiral small = spun_up(2, 1e-3, 1);
  EXPECT_NEAR(small.along, 1, 1e-7);
  EXPECT_NEAR(small.aside, 2e-3 / 24, 1e-10);
  EXPECT_NEAR(small.turn, 5e-4, 1e-15);
  // its velocity tends to a (π/(4 α))^1/2 along and sideways: C and S tend to a half
  const double late = 400, step = 1;
  const Spiral one = spun_up(1, 0.05, late), other = spun_up(1, 0.05, late + step);
  const double speed = std::sqrt(std::acos(-1.0) / (4 * 0.05));
  EXPECT_NEAR((other.along - one.along) / step / speed, 1, 0.05);
  EXPECT_NEAR((other.aside - one.aside) / step / speed, 1, 0.05);
}

}  // namespace
}  // namespace voussoir::reference
