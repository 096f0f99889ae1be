#include "reference/limit_space/limit_space.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace voussoir::reference::limit_space_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

Wedge wedge(double dip_a, double direction_a, double dip_b, double direction_b) {
  Wedge w;
  w.a = {dip_a * degree, direction_a * degree};
  w.b = {dip_b * degree, direction_b * degree};
  return w;
}

// line plunging ψ to the north, planes at half angle a to its vertical plane
Wedge symmetric(double plunge, double half) {
  const double s = std::sin(half * degree), c = std::cos(half * degree), dip = std::acos(s * std::cos(plunge * degree)),
               direction = std::atan2(c, s * std::sin(plunge * degree));
  return wedge(dip / degree, direction / degree, dip / degree, -direction / degree);
}

TEST(DilatingWedge, SymmetricOnesHaveTwoFormulas) {
  for (const auto& [plunge, half] : {std::pair{38.0, 45.0}, {25, 30}, {50, 60}, {30, 75}, {60, 20}}) {
    const Wedge w = symmetric(plunge, half);
    EXPECT_NEAR(std::sin(dilating_friction(upward_normal(w.a.dip, w.a.dip_direction),
                                           upward_normal(w.b.dip, w.b.dip_direction), {0, 0, -1})),
                std::sin(half * degree) * std::sin(plunge * degree), 1e-14);
    EXPECT_NEAR(std::tan(*critical_friction(w)), std::sin(half * degree) * std::tan(plunge * degree), 1e-12);
  }
}

TEST(DilatingWedge, OnOnePlaneIsItsDip) {
  const Vector3 plane = upward_normal(30 * degree, 0), steep = upward_normal(80 * degree, 0);
  EXPECT_NEAR(dilating_friction(plane, steep, {0, 0, -1}), 30 * degree, 1e-14);
}

// At a factor of zero the friction needed is the critical one; pushes grow with friction, and less with dilation.
TEST(Pushes, AgreeWithTheCriticalFriction) {
  const Wedge w = wedge(40, 130, 60, 220);
  const Vector3 north{0, 1, 0}, south{0, -1, 0};
  EXPECT_NEAR(*plain_push(w, south, *critical_friction(w)), 0, 1e-12);
  const double dilating = dilating_friction(upward_normal(w.a.dip, w.a.dip_direction),
                                            upward_normal(w.b.dip, w.b.dip_direction), {0, 0, -1});
  EXPECT_NEAR(*dilating_push(w, south, dilating), 0, 1e-12);
  const Wedge steep = symmetric(38, 45);
  EXPECT_LT(*plain_push(steep, north, 33 * degree), *plain_push(steep, north, 35 * degree));
  EXPECT_LT(*plain_push(steep, north, 35 * degree), *dilating_push(steep, north, 35 * degree));
  EXPECT_FALSE(dilating_push(symmetric(25, 30), north, 31 * degree)) << "held by both planes";
}

TEST(Pushes, OnAnInclineSlideOrTopple) {
  EXPECT_NEAR(push_on_incline({1, 1, 0.5, 20 * degree, 35 * degree}, 0), std::tan(15 * degree), 1e-12);
  EXPECT_NEAR(push_on_incline({1, 1, 0.5, 20 * degree, 35 * degree}, 180 * degree), std::tan(55 * degree), 1e-12);
  EXPECT_NEAR(push_on_incline({1, 1, 2, 0, 40 * degree}, 0), 0.5, 1e-12);
  EXPECT_NEAR(push_on_incline({1, 1, 2, 0, 40 * degree}, 45 * degree), 0.5 * std::numbers::sqrt2, 1e-12);
}

TEST(Pushes, OnWallsAreFractions) {
  EXPECT_NEAR(push_on_wall({4, 3, 1, 0.5}, 35 * degree), 7.0 / 11, 1e-14);
  EXPECT_NEAR(push_on_wall({6, 4, 0.5, 0.25}, 35 * degree), 11.0 / 19, 1e-14);
  EXPECT_NEAR(push_on_wall({6, 4, 0.5, 0.25}, 25 * degree), std::tan(25 * degree), 1e-14) << "it slides before";
  EXPECT_NEAR(push_on_wall({1, 1, 1, 2}, 60 * degree), 0.5, 1e-14) << "a column";
}

// published 38.15 degrees, with a table of forces in whole numbers
TEST(TopplingSlopes, HaveGoodmanAndBraysAngle) {
  EXPECT_NEAR(toppling_friction({}) / degree, 38.133922283, 1e-8);
  EXPECT_NEAR(toppling_friction({14, 9, 8, 1, 4.5, 4.8, 32 * degree}) / degree, 40.022594253, 1e-8);
  EXPECT_NEAR(toppling_friction({12, 8, 10, 1, 6, 5.5, 28 * degree}) / degree, 38.521510060, 1e-8);
}

}  // namespace
}  // namespace voussoir::reference::limit_space_test
