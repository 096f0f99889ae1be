// A stage of implicit steps as it is asked for and reported: its rows, the forces of its joints, friction that it
// lowers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ranges>

#include "core/testing/whole_runs.hpp"
#include "text/angle.hpp"

namespace voussoir::stage_test {
namespace {

constexpr double g = 9.81, dip = 30, duration = 0.5, mass = 2000;

// A block on a wide plane, gravity inclined by the dip: its friction falls from 45 to 20 deg as it is let go.
Prepared<2> lowered(const std::string& time, const std::string& output = "") {
  return scene_of<2>(fmt::format(R"(
dimension = 2
gravity = [{}, {}]
density = 2000
blocks = [{{ name = "plane", box = {{ min = [-5, -1], max = [5, 0] }}, fixed = true }},
          {{ name = "block", box = {{ min = [0, 0], max = [1, 1] }} }}]
joint_properties = [{{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 45 }}]
contact = {{ face = "integrated" }}
restrain = [{{ bodies = ["block"], rotation = true }}]
monitors = [{{ name = "block", bodies = ["block"], quantities = ["displacement"] }}]
{}
[[stage]]
name = "settle"
kind = "settle"
gravity_ramp_s = 0.2
[[stage]]
name = "slide"
kind = "run"
duration_s = {}
friction_deg = 20
damping = {{ local = 0 }}
{}
)",
                                 g * std::sin(dip * degree), -g * std::cos(dip * degree), output, duration, time));
}

std::vector<double> column(const Results& results, const std::string& name) {
  const History& history = results.history;
  const auto found = std::ranges::find(history.columns, name);
  if (found == history.columns.end()) {
    ADD_FAILURE() << "no column " << name;
    return {0};
  }
  std::vector<double> values;
  for (const std::vector<double>& row : history.rows)
    if (row[1] == 2) values.push_back(row[found - history.columns.begin()]);
  return values;
}

TEST(ImplicitStage, LoweredFrictionSlipsAtOnce) {
  const Results results = whole_run(lowered("time = { integration = \"implicit\" }")).results;
  const double slides = g * (std::sin(dip * degree) - std::cos(dip * degree) * std::tan(20 * degree));
  const std::vector<double> x = column(results, "block_displacement_x_m");
  EXPECT_NEAR(x.back() - x.front(), 0.5 * slides * duration * duration, 1e-6);
  EXPECT_LT(std::abs(results.energy.relative_error()), 1e-9);
}

TEST(ImplicitStage, JointsHaveTheForcesOfItsSteps) {
  const Progress<2> run = whole_run(lowered("time = { integration = \"implicit\" }"));
  const double normal = mass * g * std::cos(dip * degree);
  const Contact<2>& bed = run.state.contacts.list.front();
  EXPECT_NEAR(std::abs(bed.force.y()), normal, 1e-9 * normal);
  EXPECT_NEAR(std::abs(bed.force.x()), normal * std::tan(20 * degree), 1e-9 * normal);
  EXPECT_EQ(run.results.stages.back().mechanism.clusters.front().motion, FailureMotion::slides);
}

TEST(ImplicitStage, RowsComeAtTheirInterval) {
  const std::string rows = "output = { history_interval_s = 0.05 }";
  const Results results = whole_run(lowered("time = { integration = \"implicit\" }", rows)).results;
  const std::vector<double> times = column(results, "time_s");
  for (std::size_t k = 2; k + 1 < times.size(); ++k)
    EXPECT_NEAR(times[k] - times[k - 1], 0.05, 1e-12);
  EXPECT_GE(times.size(), 11u);
  // of equal steps, too, whose sum is short of a multiple by rounding
  const Results fixed = whole_run(lowered("time = { integration = \"implicit\", step_s = 0.05 }", rows)).results;
  EXPECT_EQ(column(fixed, "time_s").size(), 11u);
}

}  // namespace
}  // namespace voussoir::stage_test
