// Limit analysis in space against closed forms and other programs: wedges, inclines, twist, walls, an arch,
// self-stress.
#include "core/limit/limit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/testing/corner_scenes.hpp"
#include "text/angle.hpp"

namespace voussoir::limit_in_space_test {
namespace {

using namespace corner_scenes;

void expect_factor(const CornerScene& scene, double expected) {
  const LoadFactor<3> found = scene.factor();
  ASSERT_EQ(found.status, LimitStatus::found);
  EXPECT_NEAR(found.factor, expected, 2e-9);
  EXPECT_LT(found.evidence.gap, 1e-8);
  EXPECT_LT(found.evidence.out_of_balance, 1e-8);
  EXPECT_LT(found.evidence.inadmissible, 1e-8);
}

// ---- wedges --------------------------------------------------------------------------------------------------------

void expect_friction(const CornerScene& scene, double expected) {
  const CriticalStrength<3> found = scene.friction();
  ASSERT_EQ(found.status, LimitStatus::found);
  EXPECT_NEAR(to_degrees(found.stands), expected, 3e-6);
  EXPECT_NEAR(to_degrees(found.collapses), expected, 3e-6);
  EXPECT_GT(found.missing, 0);
  EXPECT_LT(found.evidence.programs, 25);
}

// with dilation sin φ = sin a sin ψ, whether the wedge may turn or not
TEST(LimitInSpace, FindsTheFrictionOfSymmetricWedges) {
  struct Shape {
    double plunge, half, face;
  };
  for (const Shape& shape : {Shape{38, 45, 70}, {25, 30, 60}, {50, 60, 75}, {30, 75, 65}, {60, 20, 85}})
    for (const bool turns : {false, true}) {
      const auto planes = symmetric(shape.plunge, shape.half);
      SCOPED_TRACE(shape.plunge);
      expect_friction(wedge(planes[0], planes[1], Plane{shape.face, 0}.normal(), 30, turns),
                      to_degrees(std::asin(std::sin(shape.half * degree) * std::sin(shape.plunge * degree))));
    }
}

// the distance of the origin from the segment between the horizontal parts of the normals
TEST(LimitInSpace, FindsTheFrictionOfOtherWedges) {
  struct Shape {
    Plane a, b, face;
    double friction;
  };
  for (const Shape& shape : {Shape{{40, 130}, {60, 220}, {70, 182}, 31.074313616},
                             {{55, 110}, {45, 215}, {75, 170}, 27.472881554},
                             {{65, 95}, {50, 200}, {75, 150}, 30.292027225},
                             {{35, 150}, {70, 260}, {70, 185}, 23.756167607}})
    for (const bool turns : {false, true}) {
      SCOPED_TRACE(shape.friction);
      expect_friction(wedge(shape.a.normal(), shape.b.normal(), shape.face.normal(), 30, turns), shape.friction);
    }
}

TEST(LimitInSpace, FindsWhatPushesAWedgeOut) {
  const auto shallow = symmetric(25, 30), steep = symmetric(38, 45);
  expect_factor(wedge(steep[0], steep[1], Plane{70, 0}.normal(), 35, true), 0.290704400);
  expect_factor(wedge(shallow[0], shallow[1], Plane{60, 0}.normal(), 27, true), 0.845898008);
  expect_factor(wedge(Plane{40, 130}.normal(), Plane{60, 220}.normal(), Plane{70, 182}.normal(), 35, true),
                0.091071616);
  expect_factor(wedge(Plane{65, 95}.normal(), Plane{50, 200}.normal(), Plane{75, 150}.normal(), 35, true), 0.138395104);
  // from half the planes' angle on they clamp it
  EXPECT_EQ(wedge(shallow[0], shallow[1], Plane{60, 0}.normal(), 35, true).factor().status, LimitStatus::carries_any);
  // what gravity alone brings down
  EXPECT_EQ(wedge(steep[0], steep[1], Plane{70, 0}.normal(), 20, true).factor().status, LimitStatus::carries_nothing);
}

// ---- single blocks -------------------------------------------------------------------------------------------------

TEST(LimitInSpace, PushesABlockOnAnInclineInAnyDirection) {
  struct Push {
    double along, across, height, dip, friction, direction, factor;
  };
  for (const Push& p : {Push{1, 1, 0.5, 20, 35, 0, 0.267949192},
                        {1, 1, 0.5, 20, 35, 60, 0.376544317},
                        {1, 1, 0.5, 20, 35, 180, 1.428148007},
                        {1, 1, 2, 10, 40, 0, 0.297448887},
                        {1, 0.6, 2, 10, 40, 90, 0.295442326},
                        {1, 1, 2, 10, 40, 180, 0.741719567},
                        {1, 0.8, 1.2, 15, 45, 135, 1.100585212}}) {
    SCOPED_TRACE(p.factor);
    CornerScene scene;  // in axes of the plane: down the dip, along the strike, out of it
    const Point centroid(0, 0, p.height / 2);
    const int block = scene.add(centroid, 1, 0.5 * Point(p.along, p.across, p.height).norm());
    const double dip = p.dip * degree, direction = p.direction * degree;
    scene.dead[block].force = {std::sin(dip), 0, -std::cos(dip)};
    scene.push(block, {std::cos(dip) * std::cos(direction), std::sin(direction), std::sin(dip) * std::cos(direction)},
               centroid);
    scene.touch(0, block, rectangle(p.along, p.across), {0, 0, 1}, p.friction);
    expect_factor(scene, p.factor);
  }
}

TEST(LimitInSpace, TwistsASquareBlock) {
  CornerScene scene;
  const int block = scene.add({0, 0, 0.5}, 1, 0.87);
  scene.touch(0, block, rectangle(1, 1), {0, 0, 1}, 30);
  scene.live[block].moment = {0, 0, 1};
  expect_factor(scene, std::tan(30 * degree) / std::numbers::sqrt2);
  scene.push(block, {1, 0, 0}, {0.5, 0.5, 0});
  expect_factor(scene, 0.438342168);
  scene.push(block, Point(1, -1, 0).normalized(), {0.5, 0.5, 0});
  expect_factor(scene, std::tan(30 * degree) / std::numbers::sqrt2);
  scene.push(block, Point(1, 1, 0).normalized(), {0.5, 0.5, 0});
  expect_factor(scene, std::tan(30 * degree));
}

// Cohesion resists sliding by c A, a trapezoid too: its shares keep the resultant at the centroid.
TEST(LimitInSpace, CountsCohesion) {
  CornerScene scene;
  const std::vector<Point> trapezoid{{0, 0, 0}, {2, 0, 0}, {1.5, 1, 0}, {0, 1, 0}};
  const double area = 1.75;
  const Point middle((1.5 * 1 * 0.75 + 0.25 * (1.5 + 0.5 / 3)) / area, (1.5 * 0.5 + 0.25 / 3) / area, 0);
  const int block = scene.add(middle + Point(0, 0, 0.4), 1, 1.3);
  scene.touch(0, block, trapezoid, {0, 0, 1}, 0, 0.4);
  EXPECT_NEAR(scene.assembly.faces[0].area(), area, 1e-12);
  scene.push(block, {1, 0, 0}, middle);
  expect_factor(scene, 0.4 * area);
  scene.assembly.faces[0].friction = 20 * degree;
  expect_factor(scene, 0.4 * area + std::tan(20 * degree));
  // the factor of safety of both on a slope
  scene.dead[block].force = {1.2, 0, -1};
  scene.dead[block].moment = (middle - scene.assembly.bodies[block].centroid).cross(Point(1.2, 0, 0));
  const CriticalStrength<3> found = find_factor_of_safety(scene.assembly, scene.dead, {true});
  ASSERT_EQ(found.status, LimitStatus::found);
  EXPECT_NEAR(found.stands, (0.4 * area + std::tan(20 * degree)) / 1.2, 1e-6);
}

// ---- many blocks ---------------------------------------------------------------------------------------------------

// in its plane as the plane's linear program finds it; across it the wall turns about its toe
TEST(LimitInSpace, BringsWallsDown) {
  expect_factor(wall(4, 3, 1, 0.5, 0.4, 35, {1, 0, 0}), 0.663710961);
  expect_factor(wall(6, 4, 0.5, 0.25, 0.3, 35, {1, 0, 0}), 0.615635676);
  expect_factor(wall(6, 4, 0.5, 0.25, 0.3, 25, {1, 0, 0}), std::tan(25 * degree));
  expect_factor(wall(8, 3, 0.6, 0.3, 0.3, 30, {1, 0, 0}), 0.536216876);
  expect_factor(wall(4, 3, 1, 0.5, 0.4, 35, {0, 1, 0}), 0.2);
  const LoadFactor<3> found = wall(4, 3, 1, 0.5, 0.4, 35, {0, 1, 0}).factor();
  double fastest = 0;
  for (std::size_t b = 0; b < found.state.velocities.size(); ++b)
    fastest = std::max(fastest, found.state.velocities[b].velocity.norm());
  EXPECT_GT(fastest, 0.1);
  EXPECT_EQ(found.state.velocities[0].velocity, Point::Zero()) << "the floor is fixed";
}

// a semicircular arch of 15 voussoirs with straight faces, 0.15 of its radius thick, shaken: hinges alone
TEST(LimitInSpace, BringsAnArchDown) {
  constexpr int count = 15;
  constexpr double thick = 0.15, deep = 0.7;
  for (const double degrees : {40.0, 60.0}) {
    CornerScene scene;
    const auto at = [&](int joint, double radius, double y) {
      const double angle = std::numbers::pi * joint / count;
      return Point(-radius * std::cos(angle), y, radius * std::sin(angle));
    };
    int before = 0;
    for (int k = 0; k <= count; ++k) {
      const double inner = 1 - thick / 2, outer = 1 + thick / 2, angle = std::numbers::pi * k / count;
      int body = 0;
      if (k < count) {
        // of the trapezoid: the difference of two triangles from the centre
        const Point p = at(k, 1, deep / 2), q = at(k + 1, 1, deep / 2);
        const double half = 0.5 * std::sin(std::numbers::pi / count), of_outer = half * outer * outer,
                     of_inner = half * inner * inner, weight = (of_outer - of_inner) * deep;
        const Point flat = (p + q) / 3, centroid_xz = (of_outer * outer - of_inner * inner) / (of_outer - of_inner) *
                                                      Point(flat[0], 0, flat[2]);
        const Point centroid = centroid_xz + Point(0, deep / 2, 0);
        body = scene.add(centroid, weight, 0.4);
        scene.push(body, {weight, 0, 0}, centroid);
      }
      scene.touch(before, body, {at(k, inner, 0), at(k, outer, 0), at(k, outer, deep), at(k, inner, deep)},
                  {std::sin(angle), 0, std::cos(angle)}, degrees);
      before = body;
    }
    expect_factor(scene, 0.150465309);
  }
}

// ---- self-stress ---------------------------------------------------------------------------------------------------

// a block between two parallel walls: any friction above zero holds it, by forces that grow without bound
TEST(LimitInSpace, KnowsADrawer) {
  const CornerScene scene = drawer();
  EXPECT_EQ(scene.factor().status, LimitStatus::carries_any);
  EXPECT_EQ(scene.friction().status, LimitStatus::not_attained);
}

// A wedge that can fall straight out of a roof: from sin φ = 1/|V⁻¹ (1, 1, 1)'| on its joints clamp it.
TEST(LimitInSpace, HoldsARoofWedgeBySelfStress) {
  for (const double degrees : {29.9, 30.1}) {
    CornerScene scene;
    std::array<Point, 3> normals;  // into the wedge
    for (int k = 0; k < 3; ++k)
      normals[k] = -Plane{60, 30.0 + 120 * k}.normal();
    const Point apex(0, 0, 1);
    std::array<Point, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const Point &p = normals[k], &q = normals[(k + 1) % 3];
      corners[k] = meet(p, p.dot(apex), q, q.dot(apex), {0, 0, 1}, 0);
    }
    const int block = scene.add({0, 0, 0.25}, 1, 1.5);
    for (int k = 0; k < 3; ++k)
      scene.touch(0, block, {apex, corners[k], corners[(k + 2) % 3]}, normals[k], degrees);
    scene.push(block, {0, 0, -1}, {0, 0, 0.25});
    EXPECT_EQ(scene.factor().status, degrees < 30 ? LimitStatus::carries_nothing : LimitStatus::carries_any);
  }
}

TEST(LimitInSpace, HasNothingToFind) {
  CornerScene scene;
  EXPECT_EQ(scene.factor().status, LimitStatus::nothing_free);
  EXPECT_EQ(scene.friction().status, LimitStatus::nothing_free);
  const int block = scene.add({0, 0, 0.5}, 1, 0.87);
  EXPECT_EQ(scene.factor().status, LimitStatus::no_load);
  EXPECT_EQ(scene.friction().status, LimitStatus::carries_nothing) << "no face holds it";
  scene.touch(0, block, rectangle(1, 1), {0, 0, 1}, 30);
  EXPECT_EQ(scene.friction().status, LimitStatus::carries_any) << "on a level floor";
  scene.dead[block].force.setZero();
  EXPECT_EQ(scene.friction().status, LimitStatus::no_load);
}

}  // namespace
}  // namespace voussoir::limit_in_space_test
