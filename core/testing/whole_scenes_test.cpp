// Complete scenes with closed forms: stages of kind run by themselves, and rows that are of one time.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/testing/whole_runs.hpp"

namespace voussoir::whole_scenes_test {
namespace {

Progress<2> ran(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return whole_run(scene_of(text, overrides));
}

// a column of the history, over the rows of one stage (numbered from 1)
std::vector<double> column(const Progress<2>& run, const std::string& name, int stage) {
  const History& h = run.results.history;
  const auto place = std::find(h.columns.begin(), h.columns.end(), name) - h.columns.begin();
  EXPECT_LT(place, static_cast<long>(h.columns.size())) << name;
  std::vector<double> values;
  for (const std::vector<double>& row : h.rows)
    if (row[1] == stage) values.push_back(row[place]);
  return values;
}

constexpr const char* stone = R"(dimension = 2
gravity = [0, -9.81]
density = 2600
joint_properties = [{ name = "rock", normal_stiffness = 1e10, shear_stiffness = 1e9, friction_deg = 35 }]
blocks = [{ name = "ground", box = { min = [-5, -1], max = [5, 0] }, fixed = true },
          { name = "stone", box = { min = [0, 2], max = [1, 3] } }]
stage = [{ name = "fall", kind = "run", duration_s = 0.5 }]
monitors = [{ name = "stone", bodies = ["stone"], quantities = ["displacement"] }]
)";

TEST(RunStage, LetsAStoneFallAtG) {
  const Progress<2> run = ran(stone);
  const std::vector<double> time = column(run, "time_s", 1), fallen = column(run, "stone_displacement_y_m", 1);
  EXPECT_EQ(time.front(), 0);
  EXPECT_EQ(time.back(), 0.5);
  for (std::size_t i = 0; i < time.size(); ++i)
    EXPECT_NEAR(fallen[i], -0.5 * 9.81 * time[i] * time[i], 1e-11);
}

TEST(RunStage, IsDampedAsStated) {
  for (const char* stated : {"damping.local=0.3", "stage.fall.damping.local=0.3"}) {
    const Progress<2> run = ran(stone, {stated});
    EXPECT_NEAR(run.state.bodies.motions[1].displacement[1] + run.state.bodies.motions[0].displacement[1],
                -0.7 * 0.5 * 9.81 * 0.5 * 0.5, 1e-3)
        << stated;
  }
}

// a block is pressed into the ground at constant speed: every row's force is that of its displacement
TEST(History, HasRowsOfOneTime) {
  const std::string text = R"(dimension = 2
density = 2600
blocks = [{ name = "ground", box = { min = [-5, -1], max = [5, 0] }, fixed = true },
          { name = "block", box = { min = [0, 0], max = [1, 1] } }]
restrain = [{ bodies = ["block"], rotation = true }]
monitors = [{ name = "block", bodies = ["block"], quantities = ["displacement", "contact_load"] }]
[[joint_properties]]
name = "rock"
normal_stiffness = 1e8
shear_stiffness = 1e7
friction_deg = 35
constant_stiffness = true
[time]
step_s = 1e-3
[[stage]]
name = "press"
kind = "run"
duration_s = 0.0295
move = [{ bodies = ["block"], velocity = [0, -0.01] }]
[[stage]]
name = "lift"
kind = "run"
duration_s = 0.0195
move = [{ bodies = ["block"], velocity = [0, 0.01] }]
)";
  const Progress<2> run = ran(text);
  const double duration[] = {0.0295, 0.0195};
  for (const int stage : {1, 2}) {
    const std::vector<double> time = column(run, "time_s", stage), load = column(run, "block_contact_load_y_N", stage),
                              moved = column(run, "block_displacement_y_m", stage);
    EXPECT_NEAR(time.back() - time.front(), duration[stage - 1], 1e-15);
    for (std::size_t i = 0; i < time.size(); ++i)
      EXPECT_NEAR(load[i], std::max(0.0, -1e8 * moved[i]), 1e-4) << "stage " << stage << ", row " << i;
  }
  EXPECT_NEAR(column(run, "block_displacement_y_m", 2).back(), -0.01 * (0.0295 - 0.0195), 1e-15);
  EXPECT_NEAR(run.results.find("block_contact_load_y")->value, 1e4, 1e-4);
}

// a column of two blocks on a slope of 20 degrees, which local damping holds up: its balance is not closed, and not
// because of the time step
TEST(EnergyBalance, NamesTheCauseWhenItDoesNotClose) {
  const std::string text = R"(preset = "thesis"
dimension = 2
gravity = [3.35521761, -9.21838466]
density = 2500
joint_properties = [{ name = "rock", normal_stiffness = 1e10, shear_stiffness = 1e9, friction_deg = 40 }]
blocks = [{ name = "ground", box = { min = [-2, -1], max = [4, 0] }, fixed = true },
          { name = "lower", box = { min = [0, 0], max = [1, 1.5] } },
          { name = "upper", box = { min = [0, 1.5], max = [1, 3] } }]
stage = [{ name = "topple", kind = "run", duration_s = 0.5, damping = { local = 0.7 } }]
)";
  const Progress<2> run = ran(text);
  ASSERT_EQ(run.results.warnings.size(), 1u);
  const std::string& warning = run.results.warnings.front();
  EXPECT_NE(warning.find("in the balance of the contacts"), std::string::npos) << warning;
  EXPECT_NE(warning.find("local damping removed"), std::string::npos) << warning;
  EXPECT_EQ(warning.find("time.fraction"), std::string::npos) << warning;
}

}  // namespace
}  // namespace voussoir::whole_scenes_test
