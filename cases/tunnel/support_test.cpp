// Bolts and lining of an opening in jointed rock beside Boon (2013), section 5.4.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/case_tools.hpp"
#include "reference/tunnel/lining.hpp"

namespace voussoir::cases {
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

// the largest force of each bolt, over p0 D, by the angle of the bolt
void write_bolts(const std::string& file, const SceneRun& run) {
  std::vector<double> angles, forces;
  int bolt = 0;
  for (const BoltRow& spring : run.results.bolts) {
    if (spring.bolt != bolt) {
      angles.push_back(degrees(spring.x, spring.y));
      forces.push_back(0);
    }
    bolt = spring.bolt;
    forces.back() = std::max(forces.back(), spring.force / (pressure * diameter));
  }
  write_csv("tunnel", file, {"angle_deg", "force"}, {angles, forces});
}

void write_lining(const std::string& file, const SceneRun& run) {
  std::vector<std::vector<double>> columns(4);
  for (const LiningRow& node : run.results.linings) {
    columns[0].push_back(degrees(node.x, node.y));
    columns[1].push_back(node.forces.thrust);
    columns[2].push_back(node.forces.moment);
    columns[3].push_back(node.smoothed_moment.value_or(std::nan("")));
  }
  write_csv("tunnel", file, {"angle_deg", "thrust_N", "moment_Nm", "smoothed_moment_Nm"}, columns);
}

const std::string two_deviations =
    "the thesis' three draws differ by a standard deviation of 0.009 (sudden removal); two of them";

TEST(Support, BoltsCarryWhatIsPublished) {
  CaseReport report("tunnel", {"largest bolt force over p0 D, 7 m at 11.25°, let off in steps to rest"});
  const SceneRun found = run("bolts.toml");
  report.record({"largest bolt force over p0 D, 7 m at 11.25°, let off in steps to rest",
                 "1",
                 Kind::published,
                 thesis + ", sudden removal",
                 0.030,
                 {0.018, 0},
                 two_deviations},
                largest_bolt_force(found), cost(found));
  write_bolts("support_bolts.csv", found);
  report.report("convergence, mean, 7 m bolts at 11.25°", "m", mean_convergence(found),
                "beside figure 5.15, which is not printed as numbers");
}

TEST(Support, AnchorsHardlyMatterAndBoltsMeetWhatIsLeft) {
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
  const SceneRun late = run("bolts.toml", with(large_blocks, {"stage.dig.let_off.share=0.4"}));
  report.record({"mean bolt force put in after 60 % is let off, over that wished in place, blocks of 0.5 m",
                 "1",
                 Kind::limit,
                 "bolts meet the convergence that is left",
                 1,
                 {0, 0, Bound::at_most},
                 "0.4 in elastic rock; slip, which grows with what is let off, makes it more"},
                value(late, "bolts_mean_force") / value(offset, "bolts_mean_force"), cost(late));
}

TEST(Support, LiningStopsTheWall) {
  CaseReport report("tunnel");
  double thrust = 0;
  for (const double stiffness : {1e8, 1e9}) {
    const SceneRun lined = run("lining.toml", with(large_blocks, interface(stiffness)));
    report.report(fmt::format("mean hoop force, K_L {:.0e} Pa/m, blocks of 0.5 m", stiffness), "N", mean_thrust(lined),
                  "beside figure 5.45", cost(lined));
    if (thrust > 0)
      report.record({"mean hoop force, K_L 1 over 0.1 GPa/m, blocks of 0.5 m",
                     "1",
                     Kind::limit,
                     "a stiffer interface carries more",
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
                 "lining takes part of the ground's pressure",
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
}

}  // namespace
}  // namespace voussoir::cases
