// Masonry arch under a point load at the quarter of its span: its collapse load, by limit analysis and by distinct
// elements on joints of different stiffness, the part of the difference that is due to the joints, and the mechanism.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/limit/limit_analysis.hpp"
#include "cases/arch/arch_trial.hpp"
#include "reference/arch/loaded_arch.hpp"

namespace voussoir::cases::quarter_point_test {
namespace {

using reference::ElasticLoad;
using verification::Bound;
using verification::CaseReport;
using verification::Kind;

// as quarter_point.toml states it
const reference::LoadedArch loaded{{15, 5, 2500 * 9.81}, 0.75, -2.5};
const ArchShape shape{loaded.arch.voussoirs, loaded.arch.radius};
constexpr double stated_load = 60e3, stated_stiffness = 1e11;  // N/m, Pa/m
constexpr double asked = 0.02;                                 // of the limit analysis' load
const std::string elastic = "equilibria of rigid voussoirs on elastic joints, reference/arch";

const double rigid = greatest_rigid_load(loaded).load;  // N/m

double drop(const Trial& trial) {
  const reference::Corner point = loaded_point(loaded).point;
  return trial.drop("voussoir_6", {point.x, point.y});
}

Trial under(double load, double stiffness, double down) {
  std::vector<std::string> overrides = on_joints(stiffness);
  overrides.push_back("stage.load.force.point.force=[0, " + text(-load) + "]");
  overrides.push_back("stage.load.step_limit=20000000");  // so close to the collapse load, equilibrium takes long
  return attempt("quarter_point.toml", overrides, down);
}

// The collapse load of the arch, as a share of that of rigid voussoirs.
struct Found {
  double stiffness = 0;  // Pa/m
  double load = 0, half_bracket = 0;
  std::vector<double> loads, drops;  // N/m, m: of the trials that reached equilibrium
  Trial fallen;                      // under the load that rigid voussoirs carry
  verification::Cost cost;
};

Found search(double stiffness, double narrow) {
  constexpr double down = 0.02;  // m: at the limit the load has dropped by 7 mm on the softest joints
  Found found;
  found.stiffness = stiffness;
  const auto attempted = [&](double load, double until) {
    Trial trial = under(load * rigid, stiffness, until);
    if (trial.stands == trial.comes_down)
      throw std::runtime_error("the arch neither reaches equilibrium nor collapses");
    found.cost.contact_evaluations += trial.cost.contact_evaluations;
    found.cost.seconds += trial.cost.seconds;
    if (trial.stands) {
      found.loads.push_back(load * rigid);
      found.drops.push_back(drop(trial));
    }
    return trial;
  };
  double low = 0.5, high = 1;
  found.fallen = attempted(high, fallen);
  if (found.fallen.stands || !attempted(low, down).stands)
    throw std::runtime_error("the search does not bracket the load");
  while (high - low > narrow) {
    const double middle = 0.5 * (low + high);
    (attempted(middle, down).stands ? low : high) = middle;
  }
  found.load = 0.5 * (low + high);
  found.half_bracket = 0.5 * (high - low);
  return found;
}

// Rotation of the hinge that rotates most. The reference has it to the first order, so its load is right to that share
// of the reduction by the joints.
double most_turn(const ElasticLoad& limit) {
  double turn = 0;
  for (const reference::ElasticJoint& joint : limit.joints)
    turn = std::max(turn, std::abs(joint.turn));
  return turn;
}

// both as shares of what rigid voussoirs carry
struct Expected {
  double load = 0, left_out = 0;
};

Expected expected_on(double stiffness) {
  const ElasticLoad limit = greatest_elastic_load(loaded, {stiffness, stiffness});
  return {limit.load / rigid, most_turn(limit) * (1 - limit.load / rigid)};
}

std::string on(double stiffness) {
  return text(stiffness / 1e9) + " GPa/m";
}

// kN/m and mm, for the figure
void write_states(const std::string& file, std::vector<double> loads, std::vector<double> drops) {
  for (double& load : loads)
    load /= 1e3;
  for (double& drop : drops)
    drop *= 1e3;
  write_csv("arch", file, {"drop_mm", "load_kN"}, {drops, loads});
}

Found judge_load(double stiffness, double narrow, CaseReport& report) {
  Found found = search(stiffness, narrow);
  const Expected expected = expected_on(stiffness);
  report.record({"point load that brings it down, " + on(stiffness),
                 "1",
                 Kind::exact,
                 elastic,
                 expected.load,
                 {found.half_bracket + expected.left_out, 0},
                 "over that of rigid voussoirs: half the bracket of the search, and the reduction by the joints times "
                 "the rotation of a hinge, which the reference has to the first order"},
                found.load, found.cost);
  write_states("quarter_rests_" + text(stiffness / 1e9) + ".csv", found.loads, found.drops);
  return found;
}

double limit_analysis() {
  const LoadedScene scene = load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / "quarter_point.toml");
  const LimitAnalysis<2> analysis = analyse_limit<2>(scene, {.load = limit_load("applied"), .with_dilation = true});
  if (!analysis.answered) throw std::runtime_error(analysis.message);
  return analysis.values.front().second.value * stated_load;
}

// The load on rigid joints, extrapolated from two stiffnesses by a line over k^-1/3, against limit analysis.
void judge_extrapolation(const Found& soft, const Found& stiff, CaseReport& report) {
  const double x = std::pow(soft.stiffness, -1.0 / 3), y = std::pow(stiff.stiffness, -1.0 / 3);
  const auto extrapolated = [&](double at_x, double at_y) { return (at_y * x - at_x * y) / (x - y); };
  const Expected at_x = expected_on(soft.stiffness), at_y = expected_on(stiff.stiffness);
  const double next_power = std::abs(extrapolated(at_x.load, at_y.load) - 1);
  const double brackets =
      (x * (stiff.half_bracket + at_y.left_out) + y * (soft.half_bracket + at_x.left_out)) / (x - y);
  report.record(
      {"point load on rigid joints, from " + on(soft.stiffness) + " and " + on(stiff.stiffness),
       "N",
       Kind::limit,
       "limit analysis: voussoir limit --load applied",
       limit_analysis(),
       {0, std::min(asked, next_power + brackets)},
       "the distance of a line through the reference's own two loads from the rigid one, since it leaves out the next "
       "power, and the effect of both brackets on the line; at most the required 2 %"},
      extrapolated(soft.load, stiff.load) * rigid,
      {soft.cost.contact_evaluations + stiff.cost.contact_evaluations, soft.cost.seconds + stiff.cost.seconds});
}

// the collapsing arch: which joints rotate, and about which ends
void judge_hinges(const Trial& fallen, CaseReport& report) {
  const std::vector<Joint> hinges = hinges_of(joints_of(fallen, shape));
  int as_expected = 0;
  for (const reference::Hinge& expected : greatest_rigid_load(loaded).hinges) {
    const double angle = std::numbers::pi * (static_cast<double>(expected.joint) / shape.voussoirs - 0.5);
    for (const Joint& hinge : hinges)
      as_expected += std::abs(hinge.angle - angle) < 1e-6 && (hinge.outwards > 0) == expected.outside;
  }
  report.record({"hinges under the point load",
                 "1",
                 Kind::exact,
                 "the mechanism of rigid voussoirs that needs the least load, reference/arch",
                 4,
                 {0, 0},
                 "a count of the joints that rotate about the right ends: on the left at 66 degrees from the crown "
                 "inside and at 18 outside, on the right at 42 inside and at the springing outside"},
                static_cast<int>(hinges.size()) == as_expected ? as_expected : -1, fallen.cost);
  draw_blocks("quarter_falling.csv", fallen);
  draw_points("quarter_hinges.csv", hinges);
}

TEST(QuarterPoint, HasTheCollapseLoadOfTheThrustLineByLimitAnalysis) {
  CaseReport report("arch", {"point load, limit analysis"});
  report.record({"point load, limit analysis",
                 "N",
                 Kind::exact,
                 "mechanism of four hinges whose thrust line stays inside, reference/arch",
                 rigid,
                 {0, 1e-7},
                 "the solver's tolerance"},
                limit_analysis());
  double soft = 1e12, stiff = 1e14;
  while (stiff / soft > 1.001) {
    const double middle = std::sqrt(soft * stiff);
    (expected_on(middle).load < 1 - asked ? soft : stiff) = middle;
  }
  report.report("stiffness from which joints cost less than 2 % of the point load", "Pa/m", stiff, elastic);
}

TEST(QuarterPoint, HasTheCollapseLoadOfElasticJoints) {
  CaseReport report("arch");
  const Found soft = judge_load(1e10, 1.0 / 256, report), stiff = judge_load(stated_stiffness, 1.0 / 128, report);
  judge_extrapolation(soft, stiff, report);
  judge_hinges(stiff.fallen, report);
  write_csv("arch", "quarter_found.csv", {"stiffness_GPa_m", "load_kN"},
            {{soft.stiffness / 1e9, stiff.stiffness / 1e9}, {soft.load * rigid / 1e3, stiff.load * rigid / 1e3}});
}

// closer, and on joints whose arch takes long to reach equilibrium
TEST(QuarterPointLong, HasTheCollapseLoadOfElasticJointsMoreClosely) {
  CaseReport report("arch");
  judge_load(1e10, 1.0 / 2048, report);
  const Found soft = judge_load(stated_stiffness, 1.0 / 1024, report), stiff = judge_load(1e12, 1.0 / 128, report);
  judge_extrapolation(soft, stiff, report);
}

// the scene as committed
TEST(QuarterPoint, HasTheEquilibriumOfElasticJoints) {
  CaseReport report("arch", {"drop under the point load", "thrust under the point load",
                             "where the thrust crosses the joints under the point load"});
  const reference::ArchJoints joints{stated_stiffness, stated_stiffness};
  const ElasticLoad expected = elastic_load(loaded, joints, stated_load);
  const Expected limit = expected_on(stated_stiffness);
  const ElasticLoad more = elastic_load(loaded, joints, stated_load + limit.left_out * rigid);
  const std::string because =
      "change of the reference under a load greater by its truncation: the rotation of a hinge at the limit, 0.4 %, of "
      "the 11 % that the joints take away";
  const Trial trial = under(stated_load, stated_stiffness, fallen);
  ASSERT_TRUE(trial.stands);
  report.record(
      {"drop under the point load", "m", Kind::exact, elastic, expected.drop, {more.drop - expected.drop, 0}, because},
      drop(trial), trial.cost);
  const std::vector<Joint> found = joints_of(trial, shape);
  ASSERT_EQ(found.size(), expected.joints.size());
  report.record({"thrust under the point load",
                 "N",
                 Kind::exact,
                 elastic,
                 expected.thrust,
                 {more.thrust - expected.thrust, 0},
                 because},
                std::abs(found.front().force[0]), trial.cost);
  double worst = 0, allowed = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    worst = std::max(worst, std::abs(found[k].outwards - expected.joints[k].crossing));
    allowed = std::max(allowed, std::abs(more.joints[k].crossing - expected.joints[k].crossing));
  }
  report.record({"where the thrust crosses the joints under the point load",
                 "m",
                 Kind::limit,
                 elastic,
                 0,
                 {allowed, 0, Bound::at_most},
                 "largest deviation at 16 joints; " + because},
                worst, trial.cost);
  draw_blocks("quarter_standing.csv", trial);
  draw_forces("quarter_forces.csv", trial);
  draw_points("quarter_thrust.csv", found);
}

// the reference, for the figure
TEST(QuarterPointFigure, HasItsReference) {
  for (const double stiffness : {1e10, 1e11, 1e12}) {
    std::vector<double> loads, drops;
    for (const ElasticLoad& state : elastic_load_path(loaded, {stiffness, stiffness}, 0.03)) {
      loads.push_back(state.load);
      drops.push_back(state.drop);
    }
    write_states("quarter_path_" + text(stiffness / 1e9) + ".csv", loads, drops);
  }
  std::vector<double> stiffness, load;
  for (double exponent = 9.75; exponent < 13.51; exponent += 0.125) {
    stiffness.push_back(std::pow(10, exponent - 9));
    load.push_back(expected_on(std::pow(10, exponent)).load * rigid / 1e3);
  }
  write_csv("arch", "quarter_limit.csv", {"stiffness_GPa_m", "load_kN"}, {stiffness, load});
  write_csv("arch", "quarter_rigid.csv", {"load_kN"}, {{limit_analysis() / 1e3}});
}

}  // namespace
}  // namespace voussoir::cases::quarter_point_test
