// Bolts and lining of an opening in jointed rock, compared with Boon (2013), section 5.4.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "cases/case_tools.hpp"
#include "reference/tunnel/lining.hpp"
#include "reference/tunnel/rock_mass.hpp"

namespace voussoir::cases::support_test {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;
using Overrides = std::vector<std::string>;

constexpr double pressure = 662175, diameter = 10;  // Pa, m: p0 and D
const std::string thesis = "Boon (2013), section 5.4";
const Overrides large_blocks{"slicing.smallest_inscribed_radius=0.5"};

Overrides with(Overrides settings, const Overrides& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

Overrides short_bolts(double spacing_deg) {
  return {"bolts.bolts.fan.from_deg=0", "bolts.bolts.fan.to_deg=180", "bolts.bolts.fan.length=4",
          fmt::format("bolts.bolts.fan.spacing_deg={}", spacing_deg)};
}

Overrides interface(double stiffness) {
  return {fmt::format("joint_properties.lining.normal_stiffness={}", stiffness),
          fmt::format("joint_properties.lining.shear_stiffness={}", stiffness)};
}

double largest_bolt_force(const SceneRun& run) {
  return value(run, "bolts_largest_force") / (pressure * diameter);
}

double mean_convergence(const SceneRun& run) {
  return value(run, "mean_mean_convergence");
}

double mean_thrust(const SceneRun& run) {
  const std::vector<LiningRow>& nodes = run.results.linings;
  double sum = 0;
  for (const LiningRow& node : nodes)
    sum += node.forces.thrust / nodes.size();
  return sum;
}

double degrees(double x, double y) {
  const double angle = std::atan2(y, x) * 180 / std::numbers::pi;
  return angle < -90 ? angle + 360 : angle;
}

struct LargestForces {
  std::vector<double> angles, forces;  // degrees; of each bolt the largest, over p0 D
};

LargestForces largest_forces(const SceneRun& run) {
  LargestForces found;
  int bolt = 0;
  for (const BoltRow& spring : run.results.bolts) {
    if (spring.bolt != bolt) {
      found.angles.push_back(degrees(spring.x, spring.y));
      found.forces.push_back(0);
    }
    bolt = spring.bolt;
    found.forces.back() = std::max(found.forces.back(), spring.force / (pressure * diameter));
  }
  return found;
}

void write_bolts(const std::string& file, const SceneRun& run) {
  const LargestForces found = largest_forces(run);
  write_csv("tunnel", file, {"angle_deg", "force"}, {found.angles, found.forces});
}

// the mean of the normalised maximum bolt forces of section 5.4.5
double mean_over_bolts(const SceneRun& run) {
  const std::vector<double> forces = largest_forces(run).forces;
  return std::accumulate(forces.begin(), forces.end(), 0.0) / static_cast<double>(forces.size());
}

// in the order of the figure's axis, so that a line through the nodes is one
void write_lining(const std::string& file, const SceneRun& run) {
  std::vector<LiningRow> nodes = run.results.linings;
  std::ranges::stable_sort(nodes, {}, [](const LiningRow& node) { return degrees(node.x, node.y); });
  std::vector<std::vector<double>> columns(4);
  for (const LiningRow& node : nodes) {
    columns[0].push_back(degrees(node.x, node.y));
    columns[1].push_back(node.forces.thrust);
    columns[2].push_back(node.forces.moment);
    columns[3].push_back(node.smoothed_moment.value_or(std::nan("")));
  }
  write_csv("tunnel", file, {"angle_deg", "thrust_N", "moment_Nm", "smoothed_moment_Nm"}, columns);
}

// convergence at the points of the monitor `wall`, which the scenes state from -82.5 degrees on, 15 apart
void write_walls(const std::string& file, const std::vector<std::string>& names, const std::vector<SceneRun>& runs) {
  constexpr int points = 24;
  std::vector<std::string> header{"angle_deg"};
  std::vector<std::vector<double>> columns(1);
  for (int k = 0; k < points; ++k)
    columns[0].push_back(-82.5 + 360.0 / points * k);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    header.push_back(names[r]);
    columns.emplace_back();
    for (int k = 1; k <= points; ++k)
      columns.back().push_back(value(runs[r], fmt::format("wall_convergence_{}", k)));
  }
  write_csv("tunnel", file, header, columns);
}

// of three draws of 21 bolts, merged: their standard deviation, and that of their mean
constexpr double published_mean = 0.030, published_deviation = 0.009, published_bolts = 63;

TEST(Support, BoltsCarryThePublishedForces) {
  const std::string ratio =
      "mean over bolts of the largest force of each, sudden removal (published) over let off in steps to rest";
  CaseReport report("tunnel", {ratio});
  const SceneRun found = run("bolts.toml");
  const double mean = mean_over_bolts(found);
  const double bar = 2 * published_deviation / std::sqrt(published_bolts) / mean;
  report.record({ratio,
                 "1",
                 Kind::published,
                 thesis + ".5",
                 1.5,
                 {0.5 + bar, 0},
                 "the extension of a suddenly loaded spring is one to two times that of one loaded slowly; two "
                 "standard deviations of the published mean"},
                published_mean / mean, cost(found));
  report.report("mean over bolts of the largest force of each, over p0 D, 7 m at 11.25°, let off in steps to rest", "1",
                mean, "sudden removal: 0.030, three draws (section 5.4.5)");
  report.report("largest bolt force over p0 D, 7 m at 11.25°, let off in steps to rest", "1", largest_bolt_force(found),
                "of all 21 bolts: not the mean that is published");
  write_bolts("support_bolts.csv", found);
  report.report("convergence, mean, 7 m bolts at 11.25°", "m", mean_convergence(found),
                "compare figure 5.15, which has no printed numbers");
}

TEST(Support, AnchorsHardlyMatterAndBoltsMeetTheRemainingConvergence) {
  CaseReport report("tunnel");
  const SceneRun offset = run("bolts.toml", large_blocks);
  const SceneRun midway = run("bolts.toml", with(large_blocks, {R"(bolts.bolts.anchors="midway")"}));
  report.record({"largest bolt force, anchors midway over offset, blocks of 0.5 m",
                 "1",
                 Kind::published,
                 thesis + ": differs by 8.1 % at most",
                 1,
                 {0, 0.081},
                 "the largest difference that the thesis found among its bolts"},
                largest_bolt_force(midway) / largest_bolt_force(offset), cost(midway));
  report.record({"mean convergence, anchors midway over offset, blocks of 0.5 m",
                 "1",
                 Kind::published,
                 thesis + ": differs by 4.0 % at most",
                 1,
                 {0, 0.04},
                 "the largest difference that the thesis found along the wall"},
                mean_convergence(midway) / mean_convergence(offset), cost(midway));
  const SceneRun late = run("bolts.toml", with(large_blocks, {"stage.dig.excavation_forces.remaining=0.4"}));
  report.record({"mean bolt force put in after 60 % is let off, over that wished in place, blocks of 0.5 m",
                 "1",
                 Kind::limit,
                 "comparison: bolts meet the convergence that is left",
                 1,
                 {0, 0, Bound::at_most},
                 "0.4 in elastic rock; slip, which grows with the released share, increases it"},
                value(late, "bolts_mean_force") / value(offset, "bolts_mean_force"), cost(late));
}

TEST(Support, LiningReducesTheConvergence) {
  CaseReport report("tunnel");
  double thrust = 0;
  for (const double stiffness : {1e8, 1e9}) {
    const SceneRun lined = run("lining.toml", with(large_blocks, interface(stiffness)));
    report.report(fmt::format("mean hoop force, K_L {:.0e} Pa/m, blocks of 0.5 m", stiffness), "N", mean_thrust(lined),
                  "compare figure 5.45", cost(lined));
    if (thrust > 0)
      report.record({"mean hoop force, K_L 1 over 0.1 GPa/m, blocks of 0.5 m",
                     "1",
                     Kind::limit,
                     "comparison: a stiffer interface carries more",
                     1,
                     {0, 0, Bound::at_least},
                     "the sign of a trend"},
                    mean_thrust(lined) / thrust, cost(lined));
    thrust = mean_thrust(lined);
  }
  const SceneRun bolted = run("bolts.toml", with(large_blocks, short_bolts(15)));
  const SceneRun both = run("both.toml", large_blocks);
  report.record({"mean convergence with 10 cm of lining over without, 4 m bolts at 15°, blocks of 0.5 m",
                 "1",
                 Kind::limit,
                 "comparison: lining takes part of the ground's pressure",
                 1,
                 {0, 0, Bound::at_most},
                 "the sign of a trend; the thesis: almost half"},
                mean_convergence(both) / mean_convergence(bolted), cost(both));
  report.record({"largest bolt force with 10 cm of lining over without, 4 m bolts at 15°, blocks of 0.5 m",
                 "1",
                 Kind::limit,
                 thesis + ", figure 5.46: bolt forces decrease",
                 1,
                 {0, 0, Bound::at_most},
                 "the sign of a trend"},
                largest_bolt_force(both) / largest_bolt_force(bolted), cost(both));
  write_walls("support_walls.csv", {"bolts_m", "bolts_and_lining_m"}, {bolted, both});
}

// Eq. 5.14 with the shear moduli between which the thesis found its hoop forces.
TEST(Support, LiningCarriesThePublishedForces) {
  CaseReport report("tunnel", {"mean hoop force, 0.3 m, K_L 1 GPa/m, against the softest rock"});
  const SceneRun lined = run("lining.toml");
  const auto rock = reference::network::spaced_joints_moduli(0.77, 5e9, 0.5e9, 0.2);  // m, Pa/m, 1: table 5.3
  for (const auto& [name, modulus, bound] : {std::tuple("softest", rock.shear_modulus, Bound::at_most),
                                             {"stiffest", rock.isotropic_shear_modulus, Bound::at_least}}) {
    const double force = reference::lining_hoop_force({.radius = diameter / 2,
                                                       .in_situ_pressure = pressure,
                                                       .shear_modulus = modulus,
                                                       .lining_modulus = 25e9,
                                                       .lining_thickness = 0.3,
                                                       .interface_stiffness = 1e9});
    report.record({fmt::format("mean hoop force, 0.3 m, K_L 1 GPa/m, against the {} rock", name),
                   "N",
                   Kind::limit,
                   thesis + ".7, Eq. 5.14: between the elastic solutions of its moduli",
                   force,
                   {0, 0, bound},
                   "an inequality"},
                  mean_thrust(lined), cost(lined));
  }
  write_lining("support_lining.csv", lined);
}

// The thesis' method, three draws: the largest force within 0.15 s, and the force of Newton's method.
TEST(SupportLong, SuddenRemoval) {
  CaseReport report("tunnel", {"largest bolt force, let off in steps over sudden removal, blocks of 0.5 m"});
  constexpr int draws = 3;
  double sudden = 0, gradual = 0, mean = 0;
  for (int seed = 1; seed <= draws; ++seed) {
    Overrides draw = large_blocks;
    for (const char set : {'A', 'B', 'C'})
      draw.push_back(fmt::format("joint_sets.{}.seed={}", set, seed));
    const SceneRun slow = run("bolts.toml", draw);
    const SceneRun fast = run("sudden.toml", with(draw, {"stage.dig.duration_s=0.15"}));
    const double peak = std::ranges::max(column(fast, "bolts_largest_force_N")) / (pressure * diameter);
    report.report(fmt::format("largest bolt force over p0 D, sudden removal, draw {}", seed), "1", peak,
                  fmt::format("let off in steps: {:.4f}", largest_bolt_force(slow)), cost(fast));
    mean += mean_over_bolts(slow) / draws;
    sudden += peak / draws;
    gradual += largest_bolt_force(slow) / draws;
  }
  report.report("largest bolt force over p0 D, sudden removal, blocks of 0.5 m", "1", sudden,
                "mean of three draws; of all bolts: not the mean over bolts that is published");
  report.report("mean over bolts of the largest force of each, over p0 D, let off in steps, blocks of 0.5 m", "1", mean,
                "mean of three draws; sudden removal: 0.030 (section 5.4.5)");
  report.record({"largest bolt force, let off in steps over sudden removal, blocks of 0.5 m",
                 "1",
                 Kind::limit,
                 "comparison: a suddenly loaded spring extends further",
                 1,
                 {0, 0, Bound::at_most},
                 "the sign of a trend"},
                gradual / sudden);
}

// Blocks of 0.5 m; the lining of 10 cm and bolts of 4 m at 15°.
TEST(SupportLong, Trends) {
  CaseReport report("tunnel");
  const auto follow = [&](const std::string& what, const SceneRun& found) {
    report.report("mean convergence, " + what, "m", mean_convergence(found), "compare section 5.4.8", cost(found));
    return found;
  };
  const SceneRun both = follow("10 cm", run("both.toml", large_blocks));
  const SceneRun thick = follow("30 cm", run("both.toml", with(large_blocks, {"linings.lining.thickness=0.3"})));
  const SceneRun soft = follow("K_a / 3", run("both.toml", with(large_blocks, {"bolts.bolts.stiffness=0.66666667e8"})));
  const SceneRun plain = follow("bolts alone", run("bolts.toml", with(large_blocks, short_bolts(15))));
  const SceneRun tight =
      follow("bolts alone, 150 kN of pretension",
             run("bolts.toml", with(with(large_blocks, short_bolts(15)), {"bolts.bolts.pretension=150e3"})));
  const auto less = [&](const std::string& quantity, double ratio) {
    report.record(
        {quantity + ", blocks of 0.5 m", "1", Kind::limit, thesis, 1, {0, 0, Bound::at_most}, "the sign of a trend"},
        ratio);
  };
  less("mean convergence, 30 over 10 cm", mean_convergence(thick) / mean_convergence(both));
  less("mean hoop force, 10 over 30 cm", mean_thrust(both) / mean_thrust(thick));
  less("largest bolt force, K_a / 3 over K_a", largest_bolt_force(soft) / largest_bolt_force(both));
  less("mean hoop force, K_a over K_a / 3", mean_thrust(both) / mean_thrust(soft));
  less("mean convergence, 150 kN over no pretension", mean_convergence(tight) / mean_convergence(plain));
  less("largest bolt force, none over 150 kN of pretension", largest_bolt_force(plain) / largest_bolt_force(tight));
  const auto crown_over_mean = [&](double k0) {
    const SceneRun found = run(
        "both.toml",
        with(large_blocks,
             {fmt::format(R"(stage.stress.boundary=[{{side=["left","right"],in_situ={{surface=25,k0={}}}}}])", k0)}));
    return value(found, "crown_mean_convergence") / mean_convergence(found);
  };
  const double low = crown_over_mean(0.5), high = crown_over_mean(1.5);
  less("mean over crown's convergence, K0 0.5", 1 / low);
  less("crown's over mean convergence, K0 1.5", high);
}

}  // namespace
}  // namespace voussoir::cases::support_test
