// Factors of joints that slip without opening, against closed forms and moments by hand.
#include "core/limit/without_dilation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "core/scene/scene.hpp"
#include "core/testing/corner_scenes.hpp"

namespace voussoir::without_dilation_test {
namespace {

using namespace corner_scenes;

void expect_interval(const CornerScene& scene, double least, double largest, double error = 1e-7) {
  const FactorWithoutDilation<3> found = find_factor_without_dilation(scene.assembly, scene.dead, scene.live);
  ASSERT_EQ(found.status, LimitStatus::found);
  EXPECT_TRUE(found.settled);
  EXPECT_FALSE(found.unbounded);
  EXPECT_NEAR(found.least.factor, least, error);
  EXPECT_NEAR(found.largest.factor, largest, 1e-6);
  EXPECT_LE(std::abs(found.least.factor - least), found.least.error);
  EXPECT_LE(std::abs(found.largest.factor - largest), found.largest.error);
  EXPECT_GE(found.largest.factor, found.least.factor);
  EXPECT_LE(found.largest.factor, scene.factor().status == LimitStatus::found ? scene.factor().factor + 1e-8 : 1e9);
  EXPECT_FALSE(found.state.forces.empty());
}

// Rigid wedges pushed along their line: the closed form of limit equilibrium. With dilation the first carries 0.2907,
// the second any push.
TEST(WithoutDilation, WedgesHaveTheirClosedForm) {
  const auto steep = symmetric(38, 45), shallow = symmetric(25, 30);
  expect_interval(wedge(steep[0], steep[1], Plane{70, 0}.normal(), 35, true), 0.117811228, 0.117811228);
  expect_interval(wedge(shallow[0], shallow[1], Plane{60, 0}.normal(), 35, true), 0.565089958, 0.565089958);
}

// A column of 0.5 x 0.5 x 2 m between two blocks that touch its sides: it topples at b/h, unless normal forces on its
// sides, which slip, add friction.
TEST(WithoutDilation, AColumnTopplesBetweenItsNeighbours) {
  CornerScene scene;
  const auto box = [&](double x, double y, double lx, double ly, double lz) {
    const Point centroid(x + lx / 2, y + ly / 2, lz / 2);
    const double weight = lx * ly * lz;
    const int body = scene.add(centroid, weight, 0.5 * Point(lx, ly, lz).norm());
    scene.touch(0, body, {{x, y, 0}, {x + lx, y, 0}, {x + lx, y + ly, 0}, {x, y + ly, 0}}, {0, 0, 1}, 35);
    scene.push(body, {weight, 0, 0}, centroid);
    return body;
  };
  const int left = box(0, 0, 2, 1, 2), column = box(0.75, 1, 0.5, 0.5, 2), right = box(0, 1.5, 2, 1, 2);
  for (const auto& [a, b, y] : {std::tuple{left, column, 1.0}, {column, right, 1.5}})
    scene.touch(a, b, {{0.75, y, 0}, {1.25, y, 0}, {1.25, y, 2}, {0.75, y, 2}}, {0, 1, 0}, 35);
  expect_interval(scene, 0.25, 0.699264);
}

// A wedge on joints left and right that others cut into blocks: it slides as one at 40.6598 degrees (Hoek & Bray), on
// joints that dilate at 38.07. Pushed out of the slope it was once said to carry any load.
TEST(WithoutDilation, AWedgeOfSeveralBlocksIsNotCarriedByItsPush) {
  const auto pushed = [](double friction_deg) {
    const std::string joints =
        "joints = [{ name = \"left\", dip = 49.313, dip_direction = 130.1568, point = [2, 0, -4] },\n"
        "{ name = \"right\", dip = 51.7477, dip_direction = 56.3068, point = [2, 0, -4] },\n"
        "{ name = \"s0\", dip = 76.7739, dip_direction = 278.7893, point = [-2.9059, 0, -2] },\n"
        "{ name = \"s1\", dip = 71.9782, dip_direction = 99.2893, point = [-0.1066, 0, -2] },\n"
        "{ name = \"c0\", dip = 87.6795, dip_direction = 186.1569, point = [0, -0.7075, -2] },\n"
        "{ name = \"c1\", dip = 72.8349, dip_direction = 1.1353, point = [0, 0.4476, -2] }]\n";
    const Model<3> model =
        prepare<3>(
            parse_scene(
                "dimension = 3\ngravity = [0, 0, -9.81]\ndensity = 2600\n" + joints +
                    "fix = [{ below = [\"left\"] }, { below = [\"right\"] }]\n"
                    "slicing.smallest_inscribed_radius = 0.05\n"
                    "domain = { box = { min = [-5, -2, -6], max = [4, 2, 0] }, planes = [{ name = \"face\", dip = "
                    "78.4842, dip_direction = 90, point = [2, 0, -4], keep = \"below\" }] }\n"
                    "joint_properties = [{ name = \"rock\", normal_stiffness = 1e9, shear_stiffness = 1e9, "
                    "friction_deg = " +
                    std::to_string(friction_deg) + " }]\nstage = [{ name = \"s\", kind = \"settle\" }]\n",
                "scene.toml"))
            .model;
    const CornerAssembly<3> assembly = corner_assembly(model, model.gravity.norm());
    return find_factor_without_dilation(assembly, loads_of_acceleration(model, model.gravity),
                                        loads_of_acceleration(model, Vector<3>(9.78, -0.78, 0)));
  };
  const FactorWithoutDilation<3> weak = pushed(40.4), strong = pushed(40.9);
  ASSERT_EQ(weak.status, LimitStatus::found);
  ASSERT_EQ(strong.status, LimitStatus::found);
  EXPECT_LT(weak.largest.factor, 0);
  EXPECT_GT(strong.least.factor, 0);
}

// The largest is that of joints that dilate; the least that of moments about the corner bricks' toes.
TEST(WithoutDilation, Walls) {
  expect_interval(wall(4, 3, 1, 0.5, 0.4, 35, {1, 0, 0}), 7.0 / 11, 0.663710961);
  expect_interval(wall(6, 4, 0.5, 0.25, 0.3, 35, {1, 0, 0}), 11.0 / 19, 0.615635676);
}

TEST(WithoutDilation, ASquareBlock) {
  CornerScene scene;
  const int block = scene.add({0, 0, 0.5}, 1, 0.87);
  scene.touch(0, block, rectangle(1, 1), {0, 0, 1}, 30);
  // pushed across its diagonal it turns about one of four corners, of which one diagonal may carry all
  scene.push(block, Point(1, -1, 0).normalized(), {0.5, 0.5, 0});
  expect_interval(scene, std::tan(30 * degree) / 2, std::tan(30 * degree) / std::numbers::sqrt2);
  scene.push(block, {1, 0, 0}, {0, 0, 0});
  expect_interval(scene, std::tan(30 * degree), std::tan(30 * degree));
  scene.push(block, {0, 0, -1}, {0, 0, 0});
  EXPECT_EQ(find_factor_without_dilation(scene.assembly, scene.dead, scene.live).status, LimitStatus::carries_any);
}

// nothing presses the walls of a drawer: it falls, or is held by any force between them
TEST(WithoutDilation, ADrawerFalls) {
  const CornerScene scene = drawer();
  const FactorWithoutDilation<3> found = find_factor_without_dilation(scene.assembly, scene.dead, scene.live);
  EXPECT_TRUE(found.settled);
  EXPECT_TRUE(found.unbounded);
  EXPECT_NEAR(found.least.factor, -1, 1e-6);
}

// Hoek & Bray's closed form, whether the wedge may turn or not; joints that dilate need 25.807 and 12.199 degrees.
TEST(WithoutDilation, FrictionOfWedges) {
  struct Shape {
    double plunge, half, face, friction;
  };
  for (const Shape& shape : {Shape{38, 45, 70, 28.918559285}, {25, 30, 60, 13.124268123}})
    for (const bool turns : {false, true}) {
      const auto planes = symmetric(shape.plunge, shape.half);
      const CornerScene scene = wedge(planes[0], planes[1], Plane{shape.face, 0}.normal(), 30, turns);
      const std::vector<bool> all(scene.assembly.faces.size(), true);
      const StrengthWithoutDilation<3> found =
          find_critical_friction_without_dilation(scene.assembly, scene.dead, all, scene.friction());
      ASSERT_TRUE(found.weakest && found.strongest);
      EXPECT_TRUE(found.settled);
      for (const EndOfFactor& end : {*found.weakest, *found.strongest}) {
        EXPECT_NEAR(to_degrees(end.factor), shape.friction, 1e-5);
        EXPECT_LE(std::abs(to_degrees(end.factor) - shape.friction), to_degrees(end.error));
      }
      const CriticalStrength<3> dilating = find_factor_of_safety(scene.assembly, scene.dead, all);
      const StrengthWithoutDilation<3> factor =
          find_factor_of_safety_without_dilation(scene.assembly, scene.dead, all, dilating);
      ASSERT_TRUE(factor.weakest && factor.strongest);
      const double exact = std::tan(30 * degree) / std::tan(shape.friction * degree);
      EXPECT_NEAR(factor.strongest->factor, exact, 1e-6);
      EXPECT_LE(std::abs(factor.strongest->factor - exact), factor.strongest->error);
    }
  // no friction supports a drawer without forces that it does not ask for; with them any does
  const CornerScene walls = drawer();
  EXPECT_FALSE(
      find_critical_friction_without_dilation(walls.assembly, walls.dead, {true, true}, walls.friction()).strongest);
}

TEST(WithoutDilation, HasNothingToFind) {
  CornerScene scene;
  EXPECT_EQ(find_factor_without_dilation(scene.assembly, scene.dead, scene.live).status, LimitStatus::nothing_free);
  scene.add({0, 0, 0.5}, 1, 0.87);
  EXPECT_EQ(find_factor_without_dilation(scene.assembly, scene.dead, scene.live).status, LimitStatus::no_load);
}

}  // namespace
}  // namespace voussoir::without_dilation_test
