// Derivatives of limit analysis' first value, against closed forms.
#include "app/limit/limit_derivatives.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/testing/derivative_row.hpp"
#include "core/scene/scene.hpp"
#include "text/angle.hpp"

namespace voussoir::limit_derivatives_test {
namespace {

namespace fs = std::filesystem;
using Overrides = std::vector<std::string>;

// of the first keys alone
template <int Dim>
DerivativeTable derivatives_of(const LoadedScene& scene, const LimitRequest& request, std::size_t most = 1000) {
  return limit_derivatives(scene, request, analyse_limit<Dim>(scene, request),
                           [most](std::size_t done, std::size_t) { return done <= most; });
}

DerivativeTable derivatives_of(const char* file, const Overrides& overrides, const LimitRequest& request = {}) {
  const LoadedScene scene = load_scene(fs::path(VOUSSOIR_SOURCE_DIR) / file, overrides);
  return scene.dimension == 2 ? derivatives_of<2>(scene, request) : derivatives_of<3>(scene, request);
}

DerivativeTable derivatives_of_text(const std::string& text, const LimitRequest& request = {}) {
  LoadedScene scene = load_changed(parse_scene(text, "text.toml"), {});
  return derivatives_of<2>(scene, request);
}

struct Expected {
  std::string key;
  double value;  // by the key's unit
};

// to a part of the value, and within the printed bar
void expect_all(const DerivativeTable& table, const std::vector<Expected>& expected, double relative) {
  for (const auto& [key, value] : expected) {
    const Derivative& found = row_of(table, key).derivative;
    ASSERT_TRUE(found.value) << key;
    EXPECT_LE(std::abs(*found.value - value), relative * std::abs(value)) << key;
    EXPECT_LE(std::abs(*found.value - value), found.bar) << key;
  }
}

const std::string level = "water.crack and joint.table, point 2 up";

Overrides half_full() {
  const double back = 20 / std::tan(60 * degree) + 4, foot = back * std::tan(35 * degree);
  return {fmt::format("joints.crack.point=[{}, 0]", back),
          fmt::format("water.crack and joint.table=[[0, 0], [{}, {}]]", back, foot + 0.5 * (20 - foot)),
          fmt::format("density={}", 26e3 / 9.81)};
}

// one plane: joints that dilate need the same friction
TEST(LimitDerivatives, PlaneFailureIsThatOfTheClosedForm) {
  const std::vector<Expected> expected{{"joints.joint.dip", 0.47398342166397},
                                       {"domain.planes.face.dip", -0.36577791565673},
                                       {level, 2.407794811769},
                                       {"density", -0.33505859469066 * 9.81e-3},
                                       {"water.crack and joint.unit_weight", 0.88802481773264e-3}};
  expect_all(derivatives_of("cases/water/scene.toml", half_full(), {.with_dilation = true}), expected, 1e-6);
}

TEST(LimitDerivatives, BoltedBlockIsThatOfTheClosedForm) {
  const double x = 0.7 * std::cos(10 * degree), y = 0.7 * std::sin(10 * degree);
  const Overrides bolted{fmt::format("bolts.bolt.from=[{}, {}]", x, -y), fmt::format("bolts.bolt.to=[{}, {}]", -x, y),
                         fmt::format("density={}", 1e5 / (2 * 9.81))};
  const std::vector<Expected> expected{{"density", 0.11627606384202e-3 * 2 * 9.81},
                                       {"joints.plane.dip", 0.99456966172619 + 0.0054303382738063},
                                       {"bolts.bolt.yield", -0.58138031921011e-3}};
  expect_all(derivatives_of("cases/support/slope.toml", bolted, {.with_dilation = true}), expected, 1e-6);
  expect_all(derivatives_of("cases/support/slope.toml", bolted), expected, 1e-3);
}

// without dilation: 31.07 degrees by joints that dilate
TEST(LimitDerivatives, WedgeIsThatOfTheClosedForm) {
  // dips and directions of the joints follow the friction
  const LoadedScene scene = load_scene(fs::path(VOUSSOIR_SOURCE_DIR) / "cases/wedge/scene.toml");
  expect_all(derivatives_of<3>(scene, {}, 5),
             {{"joints.A.dip", 0.60753378651706},
              {"joints.A.dip_direction", 0.29961971769537},
              {"joints.B.dip", 0.22224978710471},
              {"joints.B.dip_direction", -0.29961971769537}},
             1e-3);
}

std::string block_on_ground(double friction) {
  return fmt::format(R"(dimension = 2
gravity = [0, -9.81]
density = 2000
blocks = [{{ name = "ground", box = {{ min = [-4, -1], max = [5, 0] }}, fixed = true }},
          {{ name = "block", box = {{ min = [0, 0], max = [1, 2] }} }}]
joint_properties = [{{ name = "base", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = {} }}]
)",
                     friction);
}

LimitRequest pushed() {
  return {.load = limit_load("right")};
}

// k* = min(tan φ, b/h) of a block of breadth b = 1 m and height h = 2 m
TEST(LimitDerivatives, BlockSlidesOrOverturns) {
  const DerivativeTable slides = derivatives_of_text(block_on_ground(20), pushed());
  expect_all(slides, {{"joint_properties.base.friction_deg", degree / std::pow(std::cos(20 * degree), 2)}}, 1e-5);
  EXPECT_EQ(std::ranges::count(slides.rows, false, &DerivativeRow::refused), 1);
  const DerivativeTable overturns = derivatives_of_text(block_on_ground(40), pushed());
  expect_all(overturns, {{"blocks.block.box.max, x", 0.5}, {"blocks.block.box.max, y", -0.25}}, 1e-5);
}

TEST(LimitDerivatives, KinkBetweenSlidingAndOverturningHasBothSides) {
  const DerivativeTable table = derivatives_of_text(block_on_ground(std::atan(0.5) / degree), pushed());
  EXPECT_NEAR(*table.base.value, 0.5, 2e-6);
  struct Sides {
    const char* key;
    double below, above;
  };
  for (const auto& [key, below, above] : {Sides{"joint_properties.base.friction_deg", 1.25 * degree, 0},
                                          {"blocks.block.box.max, x", 0.5, 0},
                                          {"blocks.block.box.max, y", 0, -0.25}}) {
    const Derivative& found = row_of(table, key).derivative;
    EXPECT_TRUE(found.kink) << key;
    ASSERT_TRUE(found.below.value && found.above.value) << key;
    EXPECT_NEAR(*found.below.value, below, std::min(found.below.bar, 1e-3)) << key;
    EXPECT_NEAR(*found.above.value, above, std::min(found.above.bar, 1e-3)) << key;
  }
}

// The answer is good to 2.4e-7 degrees, of which a step moves it by 0.2 to 0.4; the extrapolation adds three such
// errors.
constexpr double of_slide = 5e-6;

// A block of 600 kN/m on a base of 55 degrees pushes one of 400 kN/m on 15 degrees, their joint leans back by 10
// degrees; without rotation joints that dilate need the same friction. The blocks end at y = 1 m and x = X, so that a
// dip moves their weights too.
TEST(LimitDerivatives, SlideOfTwoBlocksIsThatOfTheClosedForm) {
  const double steep = 55 * degree, flat = 15 * degree, tilt = 10 * degree;
  const double area_1 = (1 / std::tan(steep) - std::tan(tilt)) / 2, area_2 = area_1 * 400 / 600;
  // area 2: tan(tilt)/2 + X + X² tan(flat)/2
  const double c = std::tan(tilt) / 2 - area_2;
  const double x = (-1 + std::sqrt(1 - 2 * std::tan(flat) * c)) / std::tan(flat);
  const double unit_weight = 600 / area_1;  // kN/m³
  const std::string scene = fmt::format(R"(dimension = 2
gravity = [0, -9.81]
density = {}
domain = {{ box = {{ min = [-2, -1], max = [{}, 1] }} }}
joints = [{{ name = "steep", dip = 55, dip_direction = 90, point = [0, 0] }},
          {{ name = "flat", dip = 15, dip_direction = 90, point = [0, 0] }},
          {{ name = "between", dip = 80, dip_direction = 90, point = [0, 0] }}]
joint_properties = [{{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 40 }}]
fix = [{{ below = ["steep"] }}, {{ below = ["flat"] }}]
restrain = [{{ above = ["steep", "flat"], rotation = true }}]
)",
                                        1e3 * unit_weight / 9.81, x);
  const double by_1 = 0.012977291962076 * unit_weight, by_2 = -0.019465937943115 * unit_weight;  // deg/m²
  const double steep_area = -0.5 / std::pow(std::sin(steep), 2) * degree,
               flat_area = 0.5 * x * x / std::pow(std::cos(flat), 2) * degree,
               tilt_area = 0.5 / std::pow(std::cos(tilt), 2) * degree;
  const DerivativeTable table = derivatives_of_text(scene, {.with_dilation = true});
  EXPECT_NEAR(*table.base.value, 35.4895686848129, 4e-7);
  expect_all(table,
             {{"joints.steep.dip", 0.36930843999227 + by_1 * steep_area},
              {"joints.flat.dip", 0.50430110382192 + by_2 * flat_area},
              {"joints.between.dip", -(0.1263904561858 + (by_2 - by_1) * tilt_area)},
              {"domain.box.max, x", by_2 * (1 + x * std::tan(flat))}},
             of_slide);
}

// the same blocks by their corners, each with a density of its own
TEST(LimitDerivatives, SlideOfTwoBlocksByTheirWeights) {
  const double steep = 1 / std::tan(55 * degree), flat = std::tan(15 * degree), tilt = std::tan(10 * degree);
  const double area_1 = (steep - tilt) / 2, area_2 = tilt / 2 + 1 + flat / 2;
  const std::string scene = fmt::format(R"(dimension = 2
gravity = [0, -9.81]
blocks = [
  {{ name = "steep", vertices = [[0, 0], [-{0}, 1], [-2, 1], [-2, -1], [0, -1]], fixed = true, density = 2000 }},
  {{ name = "flat", vertices = [[0, 0], [0, -1], [1, -1], [1, -{1}]], fixed = true, density = 2000 }},
  {{ name = "one", vertices = [[0, 0], [-{0}, 1], [-{2}, 1]], density = {3} }},
  {{ name = "two", vertices = [[0, 0], [1, -{1}], [1, 1], [-{2}, 1]], density = {4} }},
]
joint_properties = [{{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 40 }}]
restrain = [{{ bodies = ["one", "two"], rotation = true }}]
)",
                                        steep, flat, tilt, 600e3 / (9.81 * area_1), 400e3 / (9.81 * area_2));
  const DerivativeTable table = derivatives_of_text(scene, {.with_dilation = true});
  EXPECT_NEAR(*table.base.value, 35.4895686848129, 4e-7);
  expect_all(table,
             {{"blocks.one.density", 0.012977291962076e-3 * 9.81 * area_1},
              {"blocks.two.density", -0.019465937943115e-3 * 9.81 * area_2}},
             of_slide);
}

TEST(LimitDerivatives, NoMechanismHasNoDerivative) {
  const DerivativeTable table = derivatives_of_text(block_on_ground(30));
  EXPECT_FALSE(table.base.value);
  EXPECT_TRUE(table.rows.empty());
  EXPECT_NE(table.base.reason.find("no derivative"), std::string::npos) << table.base.reason;
}

TEST(LimitDerivatives, TheHookEndsTheTable) {
  const LoadedScene scene = load_scene(fs::path(VOUSSOIR_SOURCE_DIR) / "cases/wedge/scene.toml");
  const DerivativeTable table = derivatives_of<3>(scene, {.with_dilation = true}, 1);
  EXPECT_TRUE(table.unfinished);
  EXPECT_LE(table.rows.size() + table.still.size(), 1u);
}

}  // namespace
}  // namespace voussoir::limit_derivatives_test
