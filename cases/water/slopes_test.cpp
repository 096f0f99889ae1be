// Blocks under thrust and uplift of water: the friction angle and the water level at which they fail, by distinct
// elements and by limit analysis.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cases/recorded_run.hpp"
#include "cases/water/plane_failure.hpp"
#include "core/step/integrate.hpp"

namespace voussoir::cases::slopes_test {
namespace {

using reference::DrawnDownBlock;
using reference::GravityBlock;
using reference::PlaneFailure;
using verification::Bound;
using verification::CaseReport;
using verification::Check;
using verification::Kind;

constexpr double gravity = 9.81;  // m/s2

Check angle_check(const std::string& quantity, const std::string& source, double expected, double tolerance_deg,
                  const std::string& because) {
  return {quantity, "deg", Kind::exact, source, expected / degree, {tolerance_deg, 0}, because};
}

// --- incline

TEST(SubmergedIncline, SlidesAtItsDipWhateverTheLevel) {
  CaseReport report("water", {"acceleration under water"});
  for (const double level : {-2.0, 0.0, 0.4, 3.0})
    report.record(
        angle_check(fmt::format("critical friction of the incline, level {} m", level),
                    "equilibrium: buoyancy reduces weight and contact force by the same fraction", 30 * degree, 0.005,
                    "half the bracket of 0.01; the unbalanced force in equilibrium, 1e-6 of the contact force, is "
                    "worth 0.00005"),
        value(run("incline.toml", {fmt::format("water.lake.level={}", level)}), "critical_friction"));
  const SceneRun slides = run("incline.toml");
  const std::vector<double> x = column(slides, "block_displacement_x_m"), y = column(slides, "block_displacement_y_m"),
                            time = column(slides, "time_s");
  const std::size_t start = column(slides, "time_s", 1).size() + column(slides, "time_s", 2).size() - 1;
  const double way = std::hypot(x.back() - x[start], y.back() - y[start]), duration = time.back() - time[start];
  report.record(
      {"acceleration under water",
       "m/s2",
       Kind::exact,
       "Newton: (1 - rho_w/rho) g (sin - cos tan phi)",
       reference::submerged_acceleration(30 * degree, 20 * degree, 2, gravity),
       {0, 5e-3},
       "twice the displacement over the square of the time: half a step at the start is dt/t, some 2e-4; as demanded"},
      2 * way / (duration * duration), cost(slides));
}

// --- plane failure

TEST(PlaneFailure, SlidesUnderTheWaterInItsCrack) {
  CaseReport report("water", {"critical friction, DEM, crack full", "critical friction, limit analysis, crack full"});
  std::vector<double> fills{0, 0.5, 1}, found, limit;
  for (const double fill : fills) {
    const PlaneFailure slope = plane_failure(fill);
    const double expected = critical_friction(slope);
    const std::string water = fill == 0 ? empty_crack : table_of(slope);
    const SceneRun scene = run("scene.toml", {water});
    if (fill == 1) report.reference("critical_friction", expected / degree, "deg");
    found.push_back(value(scene, "critical_friction"));
    limit.push_back(limit_answer("scene.toml", {water}, {.properties = {"joint"}, .with_dilation = true}));
    report.record(angle_check("critical friction, DEM" + filled(fill), plane_source, expected, 0.02,
                              "half the bracket is 0.005; the table stays fixed, and a block that has moved by 1 mm "
                              "has left 0.01 of the load"),
                  found.back(), cost(scene));
    report.record(angle_check("critical friction, limit analysis" + filled(fill), plane_source, expected, 1e-5,
                              "the bracket is 1e-6 wide"),
                  limit.back());
  }
  std::vector<double> fill_form, angle_form;
  for (int i = 0; i <= 50; ++i) {
    fill_form.push_back(i / 50.0);
    angle_form.push_back(critical_friction(plane_failure(i / 50.0)) / degree);
  }
  write_csv("water", "plane_form.csv", {"fill", "critical_deg"}, {fill_form, angle_form});
  write_csv("water", "plane.csv", {"fill", "dem_deg", "limit_deg"}, {fills, found, limit});
}

// The block slides out of its water: by the strength that its motion requires no displacement has to be stated.
TEST(PlaneFailure, NeedsNoFailureDisplacementByRequiredStrength) {
  CaseReport report("water", {"critical friction by required strength, relaxation",
                              "critical friction by required strength, Newton's method"});
  const PlaneFailure slope = plane_failure(1);
  for (const auto& [name, statics] : {std::pair("relaxation", "adaptive"), std::pair("Newton's method", "newton")}) {
    const SceneRun scene = run("scene.toml", {table_of(slope), "stage.critical.failure_displacement=0",
                                              "stage.critical.failure_criterion=\"required_strength\"",
                                              fmt::format("statics=\"{}\"", statics)});
    report.record(
        angle_check(fmt::format("critical friction by required strength, {}", name), plane_source,
                    critical_friction(slope), 0.002,
                    "first order in 1/kn: the load changes by 0.01 of its angle with each millimetre, and the "
                    "joint gives way by less than 0.2 mm"),
        value(scene, "critical_friction"), cost(scene));
  }
}

// --- gravity block

TEST(GravityBlock, SlidesOnItsFoundation) {
  CaseReport report("water", {"critical friction, gravity block", "critical friction, gravity block, limit analysis"});
  const double expected = critical_friction(GravityBlock{8, 10, 24e3, 9});
  const SceneRun scene = run("dam.toml");
  report.record(
      angle_check(
          "critical friction, gravity block", "equilibrium: thrust over weight less uplift", expected, 0.02,
          "half the bracket is 0.005; the table stays fixed, and the dam leaves 0.004 of it with every millimetre"),
      value(scene, "critical_friction"), cost(scene));
  report.record(angle_check("critical friction, gravity block, limit analysis",
                            "equilibrium: thrust over weight less uplift", expected, 1e-5, "the bracket is 1e-6 wide"),
                limit_answer("dam.toml", {}));
}

// Is the slender block in equilibrium under this water (m)? It has tipped when it leans by more than `tipped`.
bool stands(double water, double tipped) {
  const RecordedRun<2> recorded =
      record<2>("slender_dam.toml", {fmt::format("stage.critical.water.lake.table=[[0, {}], [4, 0]]", water)},
                Demand::goals, [&](const Prepared<2>& prepared, const State<2>& state) {
                  const int dam = prepared.model.bodies[0].fixed ? 1 : 0;
                  return std::abs(rotation_vector(state.bodies.motions[dam].rotation)[0]) > tipped;
                });
  return recorded.ended;
}

TEST(GravityBlock, TipsWhenTheWaterRises) {
  CaseReport report("water", {"water that tips a slender gravity block"});
  constexpr double bracket = 0.01, tipped = 0.008;  // m, rad: see NOTES.md
  double low = 9, high = 10;
  ASSERT_TRUE(stands(low, tipped));
  ASSERT_FALSE(stands(high, tipped));
  while (high - low > bracket) {
    const double middle = 0.5 * (low + high);
    (stands(middle, tipped) ? low : high) = middle;
  }
  report.record({"water that tips a slender gravity block",
                 "m",
                 Kind::exact,
                 "equilibrium: moments about the dry edge",
                 tipping_water(GravityBlock{4, 10, 24e3, 0}),
                 {0, 0.01},
                 "half the bracket is 0.005 m"},
                0.5 * (low + high));
}

// --- drawdown

TEST(Drawdown, SlidesOnAJointThatIsStillFull) {
  CaseReport report("water", {"critical friction, drawdown"});
  DrawnDownBlock block{4, 2, 20 * degree, 2500 * gravity, 0};
  block.level = highest_corner(block);
  const SceneRun scene = run("drawdown.toml");
  report.record(angle_check("critical friction, drawdown", "equilibrium: weight over contact force less uplift",
                            critical_friction(block), 0.02, "half the bracket is 0.005"),
                value(scene, "critical_friction"), cost(scene));
}

}  // namespace
}  // namespace voussoir::cases::slopes_test
