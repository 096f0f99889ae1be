#include "reference/water/wet_slopes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "text/angle.hpp"

using voussoir::degree;

namespace voussoir::reference::wet_slopes_test {
namespace {

struct Point {
  double x = 0, y = 0;
};

// Second derivation of the water's forces on a block: its pressure summed along short pieces of its faces. Corners
// counter-clockwise; the head over a point, evaluated at the midpoints; moment about the origin.
struct WaterForce {
  double x = 0, y = 0, moment = 0;
};
template <typename Head>
WaterForce pressure_on(const std::vector<Point>& corners, const std::vector<int>& faces, const Head& head) {
  constexpr int pieces = 20000;
  WaterForce sum;
  for (const int face : faces) {
    const Point p = corners[face], q = corners[(face + 1) % corners.size()];
    const double dx = (q.x - p.x) / pieces, dy = (q.y - p.y) / pieces;
    for (int i = 0; i < pieces; ++i) {
      const double x = p.x + (i + 0.5) * dx, y = p.y + (i + 0.5) * dy;
      const double pressure = water_unit_weight * std::max(0.0, head(x) - y);
      const double fx = -pressure * dy, fy = pressure * dx;  // inwards
      sum.x += fx;
      sum.y += fy;
      sum.moment += x * fy - y * fx;
    }
  }
  return sum;
}

PlaneFailure slope(double fill, double cohesion = 0, double friction_deg = 0) {
  PlaneFailure s{20, 60 * degree, 35 * degree, 4, 26e3, 0, cohesion, friction_deg * degree};
  s.water_in_crack = fill * forces_of(s).crack_depth;
  return s;
}

TEST(SubmergedIncline, WorkedValueAndLimits) {
  EXPECT_NEAR(submerged_acceleration(30 * degree, 20 * degree, 2, 9.81), 0.906407, 5e-7);
  EXPECT_EQ(submerged_acceleration(30 * degree, 30.001 * degree, 2, 9.81), 0);
  EXPECT_GT(submerged_acceleration(30 * degree, 29.999 * degree, 1.01, 9.81), 0);  // critical at its own angle
  // heavier and heavier: as in air; fall without friction
  EXPECT_NEAR(submerged_acceleration(30 * degree, 0, 1e12, 9.81), 9.81 / 2, 1e-9);
  EXPECT_NEAR(submerged_acceleration(90 * degree, 0, 2, 9.81), 9.81 / 2, 1e-12);
  EXPECT_THROW(submerged_acceleration(0.5, 0.1, 0.9, 9.81), std::invalid_argument);
}

TEST(PlaneFailure, WorkedValues) {
  const PlaneFailureForces f = forces_of(slope(1));
  EXPECT_NEAR(f.crack_depth, 9.113870, 5e-7);
  EXPECT_NEAR(f.joint_length * std::cos(35 * degree), 15.547005, 5e-7);
  EXPECT_NEAR(critical_friction(slope(0)) / degree, 35, 1e-12);
  EXPECT_NEAR(critical_friction(slope(0.5)) / degree, 42.755504, 5e-7);
  EXPECT_NEAR(critical_friction(slope(1)) / degree, 57.235233, 5e-7);
  EXPECT_NEAR(factor_of_safety(slope(0, 30e3, 40)), 1.542800, 5e-7);
  EXPECT_NEAR(factor_of_safety(slope(0.5, 30e3, 40)), 1.235450, 5e-7);
  EXPECT_NEAR(factor_of_safety(slope(1, 30e3, 40)), 0.826616, 5e-7);
}

TEST(PlaneFailure, PrintedExample) {
  PlaneFailure printed{30, 60 * degree, 30 * degree, 9, 25.5e3, 0, 48e3, 30 * degree};
  EXPECT_NEAR(forces_of(printed).crack_depth, 14.804, 5e-4);
  EXPECT_NEAR(factor_of_safety(printed), 1.347, 5e-4);
  printed.water_in_crack = forces_of(printed).crack_depth;
  EXPECT_NEAR(factor_of_safety(printed), 0.794, 5e-4);
}

// the block's own corners, and the water's pressure summed along its joint and its crack
TEST(PlaneFailure, ByThePressureOnItsFaces) {
  const PlaneFailure full = slope(0.7, 12e3, 33);
  const PlaneFailureForces f = forces_of(full);
  const double crest = 20 / std::tan(60 * degree), back = crest + 4, rise = back * std::tan(35 * degree);
  const std::vector<Point> corners{{0, 0}, {back, rise}, {back, 20}, {crest, 20}};
  double weight = 0;
  for (int i = 0; i < 4; ++i)
    weight += 0.5 * 26e3 * (corners[i].x * corners[(i + 1) % 4].y - corners[(i + 1) % 4].x * corners[i].y);
  EXPECT_NEAR(f.weight / weight, 1, 1e-12);
  const double top = rise + full.water_in_crack;
  const WaterForce water = pressure_on(corners, {0, 1}, [&](double x) { return top * x / back; });
  const double c = std::cos(35 * degree), s = std::sin(35 * degree);
  // the crack pushes towards the face, -x; down the joint is (-c, -s), into the block (-s, c)
  const double driving = -c * water.x - s * (water.y - weight), effective = s * water.x - c * (water.y - weight);
  EXPECT_NEAR((12e3 * f.joint_length + effective * std::tan(33 * degree)) / driving, factor_of_safety(full), 1e-7);
}

TEST(PlaneFailure, LimitsAndScaling) {
  // the factor is one at the critical friction angle
  for (const double fill : {0.0, 0.3, 1.0})
    EXPECT_NEAR(factor_of_safety(slope(fill, 0, critical_friction(slope(fill)) / degree)), 1, 1e-12);
  PlaneFailure large{200, 60 * degree, 35 * degree, 40, 26e3, 10 * slope(0.9).water_in_crack, 300e3, 40 * degree};
  EXPECT_NEAR(factor_of_safety(large), factor_of_safety(slope(0.9, 30e3, 40)), 1e-12);
  PlaneFailure light = slope(1);
  light.unit_weight = 8e3;
  EXPECT_EQ(factor_of_safety(light), 0);
  EXPECT_THROW(critical_friction(light), std::invalid_argument);
  PlaneFailure overfull = slope(1);
  overfull.water_in_crack *= 1.01;
  EXPECT_THROW(forces_of(overfull), std::invalid_argument);
  PlaneFailure steep = slope(0);
  steep.joint = 61 * degree;
  EXPECT_THROW(forces_of(steep), std::invalid_argument);
}

TEST(GravityBlock, WorkedValues) {
  EXPECT_NEAR(critical_friction(GravityBlock{8, 10, 24e3, 9}) / degree, 14.228642, 5e-7);
  EXPECT_NEAR(tipping_water({4, 10, 24e3, 0}), 9.542561, 5e-7);
}

TEST(GravityBlock, ByThePressureOnItsFaces) {
  const double h = tipping_water({4, 10, 24e3, 0});
  // heel at the origin, the dry edge at (4, 0): bottom and left face
  const std::vector<Point> corners{{0, 0}, {4, 0}, {4, 10}, {0, 10}};
  const WaterForce water = pressure_on(corners, {0, 3}, [&](double x) { return h * (1 - x / 4); });
  const double weight = 24e3 * 40;
  EXPECT_NEAR((water.moment - 4 * water.y) / (2 * weight), -1, 1e-6);  // about the dry edge
  EXPECT_NEAR(std::tan(critical_friction(GravityBlock{4, 10, 24e3, h})), water.x / (weight - water.y), 1e-6);
}

TEST(GravityBlock, LimitsAndScaling) {
  EXPECT_EQ(critical_friction(GravityBlock{8, 10, 24e3, 0}), 0);
  EXPECT_NEAR(tipping_water({40, 100, 24e3, 0}), 10 * tipping_water({4, 10, 24e3, 0}), 1e-10);
  EXPECT_THROW(tipping_water({8, 10, 24e3, 0}), std::invalid_argument);  // it would be 14 m
  EXPECT_THROW(critical_friction(GravityBlock{8, 10, 24e3, 11}), std::invalid_argument);
}

TEST(DrawnDownBlock, WorkedValue) {
  DrawnDownBlock block{4, 2, 20 * degree, 2500 * 9.81, 0};
  block.level = highest_corner(block);
  EXPECT_NEAR(block.level, 3.247466, 5e-7);
  EXPECT_NEAR(critical_friction(block) / degree, 38.693675, 5e-7);
}

TEST(DrawnDownBlock, ByThePressureOnItsJoint) {
  const DrawnDownBlock block{4, 2, 20 * degree, 2500 * 9.81, 2.1};
  const double c = std::cos(block.incline), s = std::sin(block.incline), weight = block.unit_weight * 8;
  const std::vector<Point> corners{{0, 0}, {4 * c, 4 * s}, {4 * c - 2 * s, 4 * s + 2 * c}, {-2 * s, 2 * c}};
  const WaterForce water = pressure_on(corners, {0}, [](double) { return 2.1; });
  EXPECT_NEAR(std::tan(critical_friction(block)), weight * s / (weight * c - std::hypot(water.x, water.y)), 1e-6);
}

TEST(DrawnDownBlock, LimitsAndScaling) {
  // ever heavier: water does not matter; ten times as large: the same
  EXPECT_NEAR(critical_friction(DrawnDownBlock{4, 2, 20 * degree, 1e12, 3}), 20 * degree, 1e-6);
  EXPECT_NEAR(critical_friction(DrawnDownBlock{40, 20, 20 * degree, 24e3, 30}),
              critical_friction(DrawnDownBlock{4, 2, 20 * degree, 24e3, 3}), 1e-12);
  EXPECT_THROW(critical_friction(DrawnDownBlock{4, 2, 20 * degree, 24e3, 1}), std::invalid_argument);
  EXPECT_THROW(critical_friction(DrawnDownBlock{4, 2, 20 * degree, 24e3, 9}), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::wet_slopes_test
