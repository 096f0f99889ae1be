// Bolts: the force of a spring across a joint, of bolts of a hung slab and of a pretensioned column, and the friction
// of a bolted slope.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cases/case_tools.hpp"
#include "reference/small/bolts.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::support_test {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;

// as the scenes state them
constexpr double stiffness = 2e8, pretension = 50e3, slip_rate = 0.02, opening_rate = 0.001;

TEST(Support, SpringsFollowAnOpeningAndSlippingJoint) {
  CaseReport report("support", {"bolt force, offset anchors"});
  const SceneRun run = cases::run("scene.toml");
  const std::vector<double> time = column(run, "time_s");
  struct Anchors {
    const char *name, *column;
    double length;  // m; 0: only along the bolt
  };
  std::vector<double> slip;
  for (const double t : time)
    slip.push_back(slip_rate * t);
  std::vector<std::string> names{"slip_m"};
  std::vector<std::vector<double>> columns{slip};
  for (const Anchors& a : {Anchors{"offset anchors", "offset", 2 * 1.2 * 0.028},
                           Anchors{"anchors at the joint", "at_joint", 0}, Anchors{"anchors midway", "midway", 1}}) {
    const std::vector<double> force = column(run, fmt::format("{}_largest_force_N", a.column));
    std::vector<double> expected;
    for (const double t : time)
      expected.push_back(
          a.length > 0 ? reference::bolt_over_joint(stiffness, a.length, pretension, opening_rate * t, slip_rate * t)
                       : pretension + stiffness * opening_rate * t);
    report.record({fmt::format("bolt force, {}", a.name),
                   "N",
                   Kind::exact,
                   "Eqs 5.1 and 5.2: K (s|d| - l0) + F0",
                   expected.back(),
                   {0, 1e-6},
                   "only rounding of positions, and of the sum of the steps' times"},
                  force.back(), cost(run));
    names.push_back(fmt::format("{}_N", a.column));
    names.push_back(fmt::format("{}_closed_form_N", a.column));
    columns.push_back(force);
    columns.push_back(expected);
  }
  write_csv("support", "slip.csv", names, columns);
}

// as the scene of grouted bars states them
constexpr double axial_stiffness = 98e6, bond_stiffness = 200e6, free_length = 0.5, stiff_bond = 100e9,
                 bond_strength = 400e3, bar_spacing = 0.1, opened = 0.001;

TEST(Support, GroutedBarsFollowAnOpeningJoint) {
  CaseReport report("support", {"bar with a bond that slips"});
  const SceneRun run = cases::run("grouted.toml");
  const auto last = [&](const char* bolts) { return column(run, fmt::format("{}_largest_force_N", bolts)).back(); };
  const double pull_out = reference::pull_out_stiffness(axial_stiffness, bond_stiffness, 3);
  report.record({"bar bonded on both sides of the joint",
                 "N",
                 Kind::exact,
                 "closed form: half of sqrt(EA k) tanh(l sqrt(k/EA)), times the opening",
                 0.5 * pull_out * opened,
                 {0, 0.01},
                 "nodes h apart make a bar h2 k/8EA too soft: 0.26 %"},
                last("bonded"), cost(run));
  report.record({"bar pulled out of the rock by its plate",
                 "N",
                 Kind::exact,
                 "closed form: sqrt(EA k) tanh(l sqrt(k/EA)) and EA over the free length, one behind the other",
                 opened / (1 / pull_out + free_length / axial_stiffness),
                 {0, 0.01},
                 "nodes h apart make the bonded part h2 k/8EA too soft: 0.26 %, the whole bar 0.15 %"},
                last("pulled"), cost(run));
  report.record({"bar with a bond that slips",
                 "N",
                 Kind::exact,
                 "closed form: sqrt(EA S (w - S/k))",
                 reference::bar_over_opening(axial_stiffness, stiff_bond, bond_strength, opened),
                 {0, 0.01},
                 "a node of 20 mm slips as one: of the 0.5 m that slip on a side, at most half a node too many or too "
                 "few, 2 %, changes the force by the square of that"},
                last("slipping"), cost(run));
  report.record({"bar with a bond that slips, against a rigid bond",
                 "N",
                 Kind::exact,
                 "closed form: sqrt(EA S w)",
                 std::sqrt(axial_stiffness * bond_strength * opened),
                 {0, 0.01},
                 "S/kw = 0.4 % of the opening is elastic, half of it of the force"},
                last("slipping"), cost(run));

  std::vector<double> opening, closed;
  for (const double t : column(run, "time_s")) {
    opening.push_back(opening_rate * t);
    closed.push_back(reference::bar_over_opening(axial_stiffness, stiff_bond, bond_strength, opening.back()));
  }
  write_csv("support", "grouted.csv", {"opening_m", "slipping_N", "slipping_closed_form_N"},
            {opening, column(run, "slipping_largest_force_N"), closed});
}

// Halving the spacing of nodes quarters the error.
TEST(Support, GroutedBarsAreOfSecondOrder) {
  CaseReport report("support");
  const double expected = 0.5 * reference::pull_out_stiffness(axial_stiffness, bond_stiffness, 3) * opened;
  const auto error = [&](double spacing) {
    const SceneRun run = cases::run("grouted.toml", {fmt::format("bolts.bonded.node_spacing={}", spacing)});
    return std::abs(column(run, "bonded_largest_force_N").back() / expected - 1);
  };
  const double coarse = error(2 * bar_spacing), fine = error(bar_spacing);
  report.record({"order of a bar's error in the spacing of its nodes",
                 "1",
                 Kind::exact,
                 "convergence: log2 of two errors, nodes 0.2 and 0.1 m apart",
                 2,
                 {0.05, 0},
                 "a half-infinite row of segments and bonds, 1/sqrt(1 + h2 k/4EA) of the bar, has 1.983"},
                std::log2(coarse / fine), {});
}

TEST(Support, ASlabHangsFromItsBolts) {
  CaseReport report("support");
  const SceneRun run = cases::run("hung.toml");
  const double share = 1.5 * 4 * 2500 * 9.81 / 3;  // N
  double worst = share;
  for (const BoltRow& bolt : run.results.bolts)
    if (std::abs(bolt.force - share) > std::abs(worst - share)) worst = bolt.force;
  report.record({"force of the bolt farthest from a third of the slab",
                 "N",
                 Kind::exact,
                 "equilibrium: W/3",
                 share,
                 {0, 1e-6},
                 "equilibrium leaves 1e-9 of the mean force"},
                worst, cost(run));
}

// Three bolts that yield at a total of a thousandth more than the weight hold it, at a thousandth less they do not.
TEST(Support, ASlabFallsIfItsBoltsYield) {
  CaseReport report("support");
  const auto ends = [](double of_weight) {
    const double yield = of_weight * 1.5 * 4 * 2500 * 9.81 / 3;
    return run_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / "hung.toml",
                     {fmt::format("bolts.roof.yield={}", yield)}, 1);
  };
  const SceneRun holds = ends(1.001), falls = ends(0.999);
  report.record({"slabs at rest, of one that yields at 1.001 W and one at 0.999 W",
                 "1",
                 Kind::exact,
                 "equilibrium: m Fy > W",
                 1,
                 {0, 0},
                 "the first reaches equilibrium, the second does not"},
                (holds.results.outcome == Outcome::done) + (falls.results.outcome == Outcome::done), cost(falls));
}

TEST(Support, JointsCloseUnderAPretension) {
  CaseReport report("support");
  const SceneRun run = cases::run("pretension.toml");
  const double expected = reference::pretension_left(100e3, 2e8, 1e9, 1);
  double worst = expected;
  for (const BoltRow& bolt : run.results.bolts)
    if (std::abs(bolt.force - expected) > std::abs(worst - expected)) worst = bolt.force;
  report.record({"pretension left over ten joints, the worst",
                 "N",
                 Kind::exact,
                 "equilibrium: F0 kn A/(kn A + K)",
                 expected,
                 {0, 1e-4},
                 "equilibrium leaves 1e-8; the overlap of 83 micrometres does not change the joints' area"},
                worst, cost(run));
  report.record({"joints crossed", "1", Kind::exact, "demanded: the scene", 10, {0, 0}, "a count"},
                static_cast<double>(run.results.bolts.size()), cost(run));
}

TEST(Support, ABoltHoldsABlockOnASlope) {
  CaseReport report("support", {"critical friction of the bolted block", "critical friction under a grouted bar"});
  const SceneRun run = cases::run("slope.toml"), grouted = cases::run("grouted_slope.toml");
  const double expected = reference::bolted_block_friction(100e3, 40 * degree, 20e3, 30 * degree) / degree;
  report.record({"critical friction of the bolted block",
                 "deg",
                 Kind::exact,
                 "equilibrium: tan = (W sin 40 - Fy cos 30)/(W cos 40 + Fy sin 30)",
                 expected,
                 {0.02, 0},
                 "half the bracket is 0.005; a slip of s rotates the bolt by s sin 30/67 mm, 0.01 deg at 1.5 mm"},
                value(run, "critical_friction"), cost(run));
  report.record({"critical friction under a grouted bar",
                 "deg",
                 Kind::exact,
                 "equilibrium: tan = (W sin 40 - Fy cos 30)/(W cos 40 + Fy sin 30)",
                 expected,
                 {0.02, 0},
                 "as for the bolted block: the bar, too, bends over 67 mm"},
                value(grouted, "critical_friction"), cost(grouted));
}

// The bolt bends as the block slides: by the strength that its motion requires no displacement has to be stated.
TEST(Support, ABoltedBlockNeedsNoFailureDisplacementByRequiredStrength) {
  CaseReport report("support", {"critical friction of the bolted block by required strength, relaxation",
                                "critical friction of the bolted block by required strength, Newton's method"});
  const double expected = reference::bolted_block_friction(100e3, 40 * degree, 20e3, 30 * degree) / degree;
  for (const auto& [name, statics] : {std::pair("relaxation", "adaptive"), std::pair("Newton's method", "newton")}) {
    const SceneRun found = cases::run("slope.toml", {"stage.critical.failure_displacement=0",
                                                     "stage.critical.failure_criterion=\"required_strength\"",
                                                     fmt::format("statics=\"{}\"", statics)});
    report.record({fmt::format("critical friction of the bolted block by required strength, {}", name),
                   "deg",
                   Kind::exact,
                   "equilibrium: tan = (W sin 40 - Fy cos 30)/(W cos 40 + Fy sin 30)",
                   expected,
                   {0.005, 0},
                   "until it yields the bolt lets the block slip by a tenth of a millimetre, which rotates it by "
                   "0.001 deg; the joint's own displacement is less"},
                  value(found, "critical_friction"), cost(found));
  }
}

}  // namespace
}  // namespace voussoir::cases::support_test
