// Settings that `[accuracy] level` changes, and those that it does not.
#include "core/scene/accuracy_level.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/accuracy.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/scene.hpp"
#include "text/angle.hpp"

namespace voussoir::accuracy_level_test {
namespace {

const std::string bisected = R"(dimension = 2
density = 2000
gravity = [0, -10]
[domain]
box = { min = [-1, -1], max = [1, 1] }
[[joints]]
name = "A"
dip = 30
dip_direction = 90
point = [0, 0]
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e8
friction_deg = 60
[[fix]]
below = ["A"]
[[stage]]
name = "settle"
kind = "settle"
[[stage]]
name = "critical"
kind = "reduce"
from_deg = 60
to_deg = 10
)";

Scene parse(const std::string& more, const std::vector<std::string>& overrides = {}) {
  return parse_scene(more + bisected, "scene.toml", overrides);
}

const ReducePlan& reduction(const Scene& scene) {
  return std::get<ReducePlan>(scene.stages.back().plan.plan);
}

TEST(AccuracyLevel, SetsUnstatedSettings) {
  EXPECT_THROW(parse(""), SceneError) << "a bisection needs its tolerance";
  double last = 1e300;
  for (const std::string_view level : accuracy_levels) {
    const Scene scene = parse("accuracy = { level = \"" + std::string(level) + "\" }\n");
    EXPECT_GT(reduction(scene).tolerance, 0);
    EXPECT_LT(reduction(scene).tolerance, last) << level;
    last = reduction(scene).tolerance;
    EXPECT_TRUE(std::is_permutation(
        scene.from_level.begin(), scene.from_level.end(),
        std::vector<std::string>{"stage.critical.tolerance_deg", "stage.critical.ramp_steps", "equilibrium.unbalanced",
                                 "time.fraction"}
            .begin(),
        [](const std::string& set, const std::string& key) { return set.substr(0, set.find(' ')) == key; }))
        << level;
  }
}

TEST(AccuracyLevel, KeepsStatedSettings) {
  const std::string level = "accuracy = { level = \"reference\" }\ntime = { fraction = 0.15 }\n";
  const Scene scene = parse(level, {"stage.critical.tolerance_deg=3", "equilibrium.unbalanced=1e-7"});
  EXPECT_NEAR(reduction(scene).tolerance, 3 * degree, 1e-12);
  EXPECT_EQ(scene.settings.time.fraction, 0.15);
  EXPECT_EQ(scene.settings.equilibrium.unbalanced, 1e-7);
  EXPECT_EQ(scene.from_level.size(), 1u) << "the ramp alone";

  const Scene fixed = parse("accuracy = { level = \"reference\" }\ntime = { step_s = 1e-4 }\n");
  EXPECT_EQ(fixed.settings.time.fraction, TimeSettings{}.fraction);
  const Scene without = parse("", {"stage.critical.tolerance_deg=3"});
  EXPECT_TRUE(without.from_level.empty());
  EXPECT_EQ(without.settings.time.fraction, TimeSettings{}.fraction);
}

TEST(AccuracyLevel, TakesSmallerStepsForDashpots) {
  const std::string level = "accuracy = { level = \"balanced\" }\n";
  const double plain = parse(level).settings.time.fraction;
  EXPECT_LT(parse(level, {"damping.viscous_ratio=0.1"}).settings.time.fraction, plain);
  EXPECT_EQ(parse(level, {"damping.viscous_ratio=0"}).settings.time.fraction, plain);
  EXPECT_LT(parse(level, {"stage.settle.damping.viscous_ratio=0.1"}).settings.time.fraction, plain);
}

TEST(AccuracyLevel, IsOneOfTheNames) {
  try {
    parse("accuracy = { level = \"exact\" }\n", {"stage.critical.tolerance_deg=3"});
    FAIL();
  } catch (const SceneError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("accuracy.level"), std::string::npos) << text;
    for (const std::string_view level : accuracy_levels)
      EXPECT_NE(text.find(level), std::string::npos) << text;
  }
}

// The table's values are in the ranges of their keys, and a higher accuracy never has a coarser setting.
TEST(AccuracyLevel, TableIsSound) {
  for (const LevelSetting& setting : level_settings) {
    const KeyRow* row = find_row({setting.table}, setting.key);
    ASSERT_NE(row, nullptr) << setting.key;
    for (const double value : setting.values) {
      EXPECT_TRUE(row->range.holds(value)) << setting.key;
      EXPECT_TRUE(row->plausible.holds(value)) << setting.key << ": a level must not make a scene look implausible";
    }
    const bool more_is_finer = setting.key == "ramp_steps";
    const auto& v = setting.values;
    EXPECT_TRUE(more_is_finer ? v[0] <= v[1] && v[1] <= v[2] : v[0] >= v[1] && v[1] >= v[2]) << setting.key;
  }
}

}  // namespace
}  // namespace voussoir::accuracy_level_test
