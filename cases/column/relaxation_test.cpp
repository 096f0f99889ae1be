// A column reaches equilibrium: relaxation against local damping, in steps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "cases/case_tools.hpp"
#include "reference/small/small.hpp"

namespace voussoir::cases::relaxation_test {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;

constexpr double rest = 1e-8;  // of the mean contact force

// squares of 1 m, 20 kN each, on joints of 200 MN/m
constexpr double density = 2000, stiffness = 2e8, gravity = 10;

// a column in the plane under weight applied suddenly; rows of the top's displacement every `interval` s
std::string scene_text(int blocks, const std::string& statics, double interval) {
  std::string text = fmt::format(R"(title = "Column of {0} squares, to rest"
preset = "thesis"
dimension = 2
gravity = [0, -{1}]
density = {2}
[[joint_properties]]
name = "rock"
normal_stiffness = {3}
shear_stiffness = {3}
friction_deg = 30
[[restrain]]
all = true
rotation = true
[damping]
statics = "{4}"
local = 0.8
[equilibrium]
unbalanced = {5}
[[stage]]
name = "settle"
kind = "settle"
step_limit = 100000000
[[monitors]]
name = "top"
bodies = ["square {0}"]
quantities = ["displacement"]
[output]
history_interval_s = {6}
[[blocks]]
name = "base"
box = {{ min = [-0.5, -1], max = [1.5, 0] }}
fixed = true
)",
                                 blocks, gravity, density, stiffness, statics, rest, interval);
  for (int i = 1; i <= blocks; ++i)
    text += fmt::format("[[blocks]]\nname = \"square {}\"\nbox = {{ min = [0, {}], max = [1, {}] }}\n", i, i - 1, i);
  return text;
}

struct Settled {
  SceneRun run;
  long long steps;
};

Settled settle(int blocks, const std::string& statics, double interval = 1e9) {
  const std::filesystem::path file = verification::case_output("column") / fmt::format("{}_{}.toml", statics, blocks);
  std::ofstream(file) << scene_text(blocks, statics, interval);
  SceneRun run = run_scene(file);
  EXPECT_EQ(run.results.outcome, Outcome::done) << run.results.message;
  const long long steps = run.results.stages.front().steps;
  return {std::move(run), steps};
}

double settlement(int blocks) {
  double sum = 0;
  for (const double overlap : reference::column_overlaps({blocks, density, stiffness, gravity}))
    sum += overlap;
  return sum;
}

// the largest error of the top's place from each row on, as a fraction of its settlement
void write_approach(const std::string& file, int blocks, const SceneRun& run) {
  const std::vector<double> time = column(run, "time_s"), top = column(run, "top_displacement_y_m");
  std::vector<double> steps(time.size()), error(time.size());
  double largest = 0;
  for (std::size_t i = time.size(); i-- > 0;) {
    largest = std::max(largest, std::abs(-top[i] / settlement(blocks) - 1));
    error[i] = largest;
    steps[i] = std::round(time[i] / run.results.stages.front().time_step);
  }
  write_csv("column", file, {"steps", "error"}, {steps, error});
}

void compare(CaseReport& report, int blocks, double relaxation_interval, double local_interval) {
  const Settled relaxed = settle(blocks, "adaptive", relaxation_interval),
                damped = settle(blocks, "local", local_interval);
  report.record(
      {fmt::format("settlement by relaxation, {} blocks", blocks),
       "m",
       Kind::exact,
       "equilibrium: N (N + 1)/2 m g/k",
       settlement(blocks),
       {0, rest * blocks * blocks},
       "equilibrium leaves each of N blocks 1e-8 of the mean contact force unbalanced, which N joints collect"},
      -value(relaxed.run, "top_displacement_y"), cost(relaxed.run));
  report.record({fmt::format("steps of local damping over steps of relaxation, {} blocks", blocks),
                 "1",
                 Kind::limit,
                 "demanded: at least 15 times fewer steps to a residual of 1e-8",
                 15,
                 {0, 0, Bound::at_least},
                 "no margin: steps are counted"},
                static_cast<double>(damped.steps) / static_cast<double>(relaxed.steps), cost(damped.run));
  report.report(fmt::format("steps of relaxation, {} blocks", blocks), "steps", static_cast<double>(relaxed.steps),
                "count of steps", cost(relaxed.run));
  report.report(fmt::format("steps of local damping 0.8, {} blocks", blocks), "steps",
                static_cast<double>(damped.steps), "time step 0.2 of the limit, above which contacts gain energy",
                cost(damped.run));
  write_approach(fmt::format("relaxation_{}.csv", blocks), blocks, relaxed.run);
  write_approach(fmt::format("local_{}.csv", blocks), blocks, damped.run);
}

TEST(ColumnAtRest, RelaxationTakesFifteenTimesFewerSteps) {
  CaseReport report("column");
  compare(report, 100, 0.02, 0.05);
}

// run by make test-long
TEST(ColumnAtRestLong, SoDoLongerColumns) {
  CaseReport report("column");
  compare(report, 200, 0.05, 0.2);
  compare(report, 400, 0.1, 1);
}

}  // namespace
}  // namespace voussoir::cases::relaxation_test
