// The level of water at which a block on a plane begins to slide, against closed forms.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>

#include "core/key_blocks/block_survey.hpp"
#include "core/scene/scene.hpp"
#include "text/angle.hpp"

namespace voussoir::critical_level_test {
namespace {

constexpr double half = 10, height = 20, dip = 30;        // m, m, deg
constexpr double weight = 2500 * 10 * 2 * half * height;  // N/m
constexpr double unit_weight = 9810;
const char* const on_base = ", faces = [\"base\"]";

// a box whose lower part is fixed below a plane through its middle, at an elevation; `cut`: its upper part is two
// blocks
template <int Dim>
Survey<Dim> judged(double friction, const std::string& faces, double elevation = 0, bool cut = false,
                   double density = 2500) {
  const std::string point = Dim == 3 ? fmt::format("[0, 0, {}]", elevation) : fmt::format("[0, {}]", elevation);
  const auto corner = [&](double side) {
    return Dim == 3 ? fmt::format("[{}, {}, {}]", side * half, side, elevation + side * height)
                    : fmt::format("[{}, {}]", side * half, elevation + side * height);
  };
  const auto joint = [&](const char* name, double dips) {
    return fmt::format("{{ name = \"{}\", dip = {}, dip_direction = 90, point = {} }}", name, dips, point);
  };
  const std::string text = fmt::format(
      "dimension = {}\ngravity = {}\ndensity = {}\ndomain = {{ box = {{ min = {}, max = {} }} }}\n"
      "joints = [{}{}]\nfix = [{{ below = [\"base\"] }}]\n"
      "joint_properties = [{{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = {} }}]\n"
      "water = [{{ name = \"lake\", level = {}, unit_weight = {}{} }}]\n"
      "stage = [{{ name = \"s\", kind = \"settle\" }}]\n",
      Dim, Dim == 3 ? "[0, 0, -10]" : "[0, -10]", density, corner(-1), corner(1), joint("base", dip),
      cut ? ", " + joint("cut", 90) : "", friction, elevation - 100, unit_weight, faces);
  return survey_blocks(prepare<Dim>(parse_scene(text, "level.toml")), {});
}

// uplift at which the factor is 1, N/m
double critical_uplift(double friction) {
  return weight * (std::cos(dip * degree) - std::sin(dip * degree) / std::tan(friction * degree));
}

template <int Dim>
void expect_closed_forms(double elevation) {
  const double top = half * std::tan(dip * degree), length = 2 * half / std::cos(dip * degree);
  const auto level_of = [&](double friction) {
    const Survey<Dim> survey = judged<Dim>(friction, on_base, elevation);
    EXPECT_NEAR(*survey.rows.at(0).bolted.factor, std::tan(friction * degree) / std::tan(dip * degree), 1e-12);
    EXPECT_FALSE(survey.rows.at(0).critical_water) << "it is dry as stated";
    return *survey.rows.at(0).critical_level - elevation;
  };
  // within the joint: a triangle of pressure
  const double within = std::sqrt(2 * std::sin(dip * degree) * critical_uplift(32) / unit_weight) - top;
  ASSERT_LT(within, top);
  EXPECT_NEAR(level_of(32), within, 1e-9);
  // above the joint, and far above the block
  EXPECT_NEAR(level_of(45), critical_uplift(45) / (unit_weight * length), 1e-9);
  const double above = critical_uplift(80) / (unit_weight * length);
  ASSERT_GT(above, height);
  EXPECT_NEAR(level_of(80), above, 1e-9);
}

TEST(CriticalLevel, UpliftOnAPlane) {
  expect_closed_forms<2>(0);
  expect_closed_forms<3>(0);
  expect_closed_forms<3>(2000);
}

// a lake wets all faces: the buoyant weight has the factor of the dry one, until the block is lighter than water
TEST(CriticalLevel, ALakeAroundABlock) {
  EXPECT_FALSE(judged<2>(32, "").rows.at(0).critical_level);
  EXPECT_FALSE(judged<3>(32, "").rows.at(0).critical_level);
  // it floats when the water that it displaces has its weight
  EXPECT_NEAR(*judged<3>(32, "", 0, false, 500).rows.at(0).critical_level, weight / 5 / unit_weight / (2 * half), 1e-9);
}

TEST(CriticalLevel, NoneForABlockThatFailsDryOrWithoutALevel) {
  EXPECT_FALSE(judged<3>(29, on_base).rows.at(0).critical_level);
  Survey<3> survey = judged<3>(32, on_base);
  survey.assembly.water_values[0][1] = 0.1;  // it slopes
  Block<3> block;
  gather<3>(survey.assembly, survey.rows.at(0).bodies, {}, block);
  EXPECT_FALSE(critical_level<3>(survey.assembly, block, block.stated.force));
}

// two blocks as one have the level of the whole
TEST(CriticalLevel, OfACluster) {
  const double whole = *judged<3>(32, on_base).rows.at(0).critical_level;
  const Survey<3> survey = judged<3>(32, on_base, 0, true);
  ASSERT_EQ(survey.rows.size(), 2u);
  Block<3> both;
  gather<3>(survey.assembly, std::array{survey.rows[0].bodies[0], survey.rows[1].bodies[0]}, {}, both);
  EXPECT_NEAR(*critical_level<3>(survey.assembly, both, both.stated.force), whole, 1e-9);
}

}  // namespace
}  // namespace voussoir::critical_level_test
