#include "reference/key_blocks/slope_wedge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "text/angle.hpp"

using voussoir::degree;

namespace voussoir::reference::slope_wedge_test {
namespace {

constexpr double foot = 0.3048;

PlaneAngles plane(double dip, double direction) {
  return {dip * degree, direction * degree};
}

SlopeWedge hoek_and_bray() {
  return {plane(45, 105), plane(70, 235), plane(65, 185), plane(12, 195), 100, plane(70, 165), 40};
}

// Hoek & Bray (1981), comprehensive solution, in feet; computed by another program
TEST(SlopeWedge, WorkedValues) {
  const SlopeWedgeSolid solid = solid_of(hoek_and_bray());
  EXPECT_NEAR(solid.volume, 176701.221, 1e-3);
  EXPECT_NEAR(solid.area_a, 5565.007845, 1e-6);
  EXPECT_NEAR(solid.area_b, 6428.125399, 1e-6);
  EXPECT_NEAR(solid.area_crack, 1846.538547, 1e-6);
  EXPECT_NEAR(mean_water_pressure(solid, true, 62.5), 1084.266440, 1e-6);
}

TEST(SlopeWedge, ScalesWithItsSize) {
  SlopeWedge small = hoek_and_bray();
  small.crest_height *= foot;
  small.crack_distance *= foot;
  const SlopeWedgeSolid large = solid_of(hoek_and_bray()), solid = solid_of(small);
  EXPECT_NEAR(solid.volume / large.volume, std::pow(foot, 3), 1e-12);
  EXPECT_NEAR(solid.area_crack / large.area_crack, std::pow(foot, 2), 1e-12);
  EXPECT_NEAR(solid.line_height / large.line_height, foot, 1e-12);
}

// a crack so far back that it only touches takes nothing away
TEST(SlopeWedge, LimitOfADistantCrack) {
  SlopeWedge whole = hoek_and_bray(), far = hoek_and_bray();
  whole.crack.reset();
  far.crack_distance = 400;
  EXPECT_NEAR(solid_of(far).volume, solid_of(whole).volume, 1e-6);
  EXPECT_EQ(solid_of(far).area_crack, 0);
  EXPECT_NEAR(crest_height_of_line(whole, solid_of(whole).line_height), 100, 1e-9);
}

// Second derivation: Low's closed form against the solid of its planes and the forces of a wedge on them.
TEST(SlopeWedge, LowsClosedFormHasTheFactorOfItsPlanes) {
  constexpr double water = 9810;
  LowWedge low{62 * degree, 20 * degree, 50 * degree, 48 * degree, 70 * degree, 0,  30 * degree,
               30 * degree, 41.6e3,      41.6e3,      16,          26e3,        0.5};
  EXPECT_NEAR(factor_of_safety(low, water), 1.426837242035, 1e-11);
  for (const double upper : {0.0, 12.0})
    for (const double share : {0.0, 0.5}) {
      low.upper = upper * degree;
      low.water = share;
      const SlopeWedge planes = planes_of(low);
      const SlopeWedgeSolid solid = solid_of(planes);
      const double pressure = share * water * low.crest_height / 3;
      Wedge wedge;
      wedge.a = {planes.a.dip, planes.a.direction, low.friction_1, low.cohesion_1 * solid.area_a,
                 pressure * solid.area_a};
      wedge.b = {planes.b.dip, planes.b.direction, low.friction_2, low.cohesion_2 * solid.area_b,
                 pressure * solid.area_b};
      wedge.weight = low.unit_weight * solid.volume;
      EXPECT_NEAR(solve_wedge(wedge).factor_of_safety, factor_of_safety(low, water), 1e-10);
    }
}

TEST(SlopeWedge, RefusesBadInput) {
  SlopeWedge wedge = hoek_and_bray();
  wedge.crest_height = 0;
  EXPECT_THROW(solid_of(wedge), std::invalid_argument);
  wedge = hoek_and_bray();
  wedge.face = plane(20, 185);  // the line does not daylight
  wedge.crack.reset();
  EXPECT_THROW(solid_of(wedge), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::slope_wedge_test
