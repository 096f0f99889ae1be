// The table of a run's derivatives: its answer, its keys, its refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/derivatives/derivative_files.hpp"
#include "app/run/run_derivative_table.hpp"
#include "app/testing/derivative_row.hpp"
#include "core/base/bad_input.hpp"
#include "core/scene/scene.hpp"
#include "text/angle.hpp"

namespace voussoir::run_derivatives_table_test {
namespace {

LoadedScene scene_with(const char* file, const std::vector<std::string>& overrides = {}) {
  return load_scene(std::filesystem::path(VOUSSOIR_SOURCE_DIR) / file, overrides);
}

// as block theory, whose blocks do not move: docs/derivatives.md
TEST(RunDerivativeTable, OfAWetSlopeIsThatOfBlockTheory) {
  const DerivativeTable table = run_derivatives(scene_with("examples/wet_slope.toml"), "");
  ASSERT_TRUE(table.base.value) << table.base.reason;
  EXPECT_EQ(table.answer.name, "factor_of_safety");
  EXPECT_NEAR(*row_of(table, "water.rain.table, all points up").derivative.value, -0.18228, 1e-5);
  EXPECT_NEAR(*row_of(table, "stage.safety.friction.joint.friction_deg").derivative.value, 0.021084, 1e-6);
  EXPECT_NEAR(*row_of(table, "joints.crack.point along its normal").derivative.value, -0.058467, 1e-6);
  EXPECT_NE(table.base.words.find("moves first, 32.0/270.0"), std::string::npos) << table.base.words;
  EXPECT_TRUE(row_of(table, "joints.crack.dip").refused) << "it is vertical";
  EXPECT_TRUE(std::ranges::is_sorted(table.rows, [](const DerivativeRow& a, const DerivativeRow& b) {
    return a.refused != b.refused ? b.refused : std::abs(a.change) > std::abs(b.change);
  }));
  EXPECT_NE(derivatives_text(table).find("what moves factor_of_safety 0.84"), std::string::npos);
}

// the distance from collapse: the smallest singular value falls as the level nears the critical one, the second does
// not
TEST(RunDerivativeTable, TellsTheWayToTheCollapse) {
  const DerivativeTable table = run_derivatives(scene_with("cases/wedge/scene.toml", {"statics=newton"}), "");
  ASSERT_TRUE(table.base.value) << table.base.reason;
  ASSERT_GE(table.way.size(), 4u);
  EXPECT_NEAR(table.way.back().level, *table.base.value, table.answer.bar);
  EXPECT_LT(table.way.back().smallest, 0.1 * table.way.front().smallest);
  EXPECT_GT(table.way.back().second, 0.5 * table.way.front().second);
  ASSERT_EQ(table.motion.size(), 1u);
  const std::vector<double>& way = table.motion.front().displacement;
  ASSERT_EQ(way.size(), 3u);
  EXPECT_NEAR(std::hypot(way[0], way[1], way[2]), 1, 1e-12);
  EXPECT_NEAR(way[2], -std::sin(37.058295 * degree), 1e-3) << "the line of its planes";
  const auto json = nlohmann::json::parse(with_derivatives("{}", table))["derivatives"];
  EXPECT_EQ(json["way_to_collapse"].size(), table.way.size());
  EXPECT_EQ(json["motion_at_collapse"][0]["displacement"].size(), 3u);
}

// a block that sticks on a level joint under an inclined gravity
TEST(RunDerivativeTable, AtRestIsOfTheValueThatIsNamed) {
  const LoadedScene scene = load_changed(parse_scene(R"(
dimension = 2
statics = "newton"
gravity = [3, -9]
density = 2600
[domain]
box = { min = [-1, -1], max = [3, 2] }
[[joints]]
name = "base"
dip = 0
dip_direction = 90
point = [0, 0]
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 5e8
friction_deg = 40
[[fix]]
below = ["base"]
[[restrain]]
above = ["base"]
rotation = true
[[stage]]
name = "settle"
kind = "settle"
[[monitors]]
name = "block"
above = ["base"]
quantities = ["displacement"]
[[monitors]]
name = "base"
joint = "base"
quantities = ["contact_force"]
)",
                                                     "text.toml"),
                                         {});
  const DerivativeTable moved = run_derivatives(scene, "");
  ASSERT_TRUE(moved.base.value) << moved.base.reason;
  EXPECT_EQ(moved.answer.name, "block_displacement_x");
  const DerivativeRow& soft = row_of(moved, "joint_properties.rock.shear_stiffness");
  EXPECT_NEAR(*soft.derivative.value * soft.key.value / *moved.base.value, -1, 1e-4);
  EXPECT_EQ(std::ranges::count(moved.still, "joint_properties.rock.friction_deg"), 1) << "it sticks";

  const DerivativeTable force = run_derivatives(scene, "base_normal_force");
  EXPECT_EQ(force.answer.name, "base_normal_force");
  const DerivativeRow& heavy = row_of(force, "density");
  EXPECT_NEAR(*heavy.derivative.value * 2600 / *force.base.value, 1, 1e-6);
}

TEST(RunDerivativeTable, SaysWhyThereIsNone) {
  const LoadedScene wedge = scene_with("cases/wedge/scene.toml");
  const DerivativeTable table = run_derivatives(wedge, "");
  EXPECT_FALSE(table.base.value);
  EXPECT_NE(derivatives_text(table).find("does not use Newton's method"), std::string::npos);
  EXPECT_NO_THROW(require_answer(wedge, ""));
  EXPECT_NO_THROW(require_answer(wedge, "wedge_displacement_x"));
  EXPECT_THROW(require_answer(wedge, "wedge_displacement"), BadInput);
}

}  // namespace
}  // namespace voussoir::run_derivatives_table_test
