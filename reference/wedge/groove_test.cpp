#include "reference/wedge/groove.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "reference/limit_space/limit_space.hpp"
#include "reference/wedge/wedge.hpp"

namespace voussoir::reference::groove_test {
namespace {

constexpr double deg = 0.017453292519943295;

// the same groove as two planes with dips: turned about y until gravity is vertical
Vector3 normal(const Groove& g, double side) {
  const double x = 0, y = -side * std::cos(g.half_angle), z = std::sin(g.half_angle);
  return {x * std::cos(g.plunge) + z * std::sin(g.plunge), y, z * std::cos(g.plunge) - x * std::sin(g.plunge)};
}

WedgePlane plane(const Vector3& n) {
  return {std::acos(n[2]), std::atan2(n[0], n[1])};
}

TEST(Groove, HasTheAnglesOfAWorkedExample) {
  const Groove g{45 * deg, 38 * deg};
  EXPECT_NEAR(sliding_friction(g) / deg, 28.918559, 5e-7);
  EXPECT_NEAR(least_groove_friction(g) / deg, 25.806829, 5e-7);
}

TEST(Groove, OfOnePlaneIsAnIncline) {
  const Groove g{90 * deg, 31 * deg};
  EXPECT_NEAR(sliding_friction(g), 31 * deg, 1e-12);
  EXPECT_NEAR(least_groove_friction(g), 31 * deg, 1e-12);
}

TEST(Groove, IsTheWedgeOfHoekAndBrayAndOfLimitAnalysis) {
  for (const double half : {20.0, 45.0, 70.0})
    for (const double plunge : {10.0, 38.0, 60.0}) {
      const Groove g{half * deg, plunge * deg};
      const Vector3 left = normal(g, -1), right = normal(g, 1);
      Wedge wedge;
      wedge.a = plane(left);
      wedge.b = plane(right);
      EXPECT_NEAR(sliding_friction(g), *critical_friction(wedge), 1e-10) << half << " " << plunge;
      EXPECT_NEAR(least_groove_friction(g), dilating_friction(left, right, {0, 0, -1}), 1e-9) << half << " " << plunge;
      EXPECT_LT(least_groove_friction(g), sliding_friction(g));
    }
}

}  // namespace
}  // namespace voussoir::reference::groove_test
