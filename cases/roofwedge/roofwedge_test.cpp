// A wedge in a roof held by stress on three joints: the friction angle at which it falls, against joint relaxation. The
// stress is applied to the joints, or by tractions on the sides of the model.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "cases/case_tools.hpp"
#include "cases/judged_scene.hpp"
#include "reference/roofwedge/roofwedge.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::roofwedge_test {
namespace {

using verification::CaseReport;
using verification::Kind;

constexpr int settle = 2;

// as scene.toml and unequal.toml state them
constexpr std::array<double, 3> equal_dips{60, 60, 60}, equal_directions{30, 150, 270};
constexpr std::array<double, 3> unequal_dips{60, 65, 55}, unequal_directions{20, 140, 265};

reference::RoofWedge roof_wedge(const std::array<double, 3>& dips, const std::array<double, 3>& directions) {
  reference::RoofWedge wedge;
  for (int i = 0; i < 3; ++i) {
    wedge.planes[i].dip = dips[i] * degree;
    wedge.planes[i].dip_direction = directions[i] * degree;
  }
  return wedge;
}

reference::RoofWedge regular(double gravity = 9.81, double shear_stiffness = 10e6) {
  reference::RoofWedge wedge = roof_wedge(equal_dips, equal_directions);
  wedge.gravity = gravity;
  wedge.shear_stiffness = shear_stiffness;
  return wedge;
}

void check(CaseReport& report, const std::string& name, double expected, double tolerance, const char* reason,
           double found, const SceneRun& run) {
  report.record({name, "deg", Kind::exact, "Goodman, Shi & Boyle (1982)", expected, {tolerance, 0}, reason}, found,
                cost(run));
}

constexpr double tight = 0.005;
constexpr const char* why =
    "half the bracket is 0.0004; the wedge sinks by 3 micrometres into overlaps of 40, and the resulting change of its "
    "faces and stresses is worth less than 0.002";

// block theory has no stress: the wedge falls, whatever the friction
TEST(RoofWedge, FallsWithoutStressByBlockTheory) {
  CaseReport report("roofwedge", {"factor without stress, block theory"});
  const Survey<3> survey = judged("scene.toml");
  ASSERT_EQ(survey.rows.size(), 1u);
  EXPECT_EQ(survey.rows[0].kind(), BlockKind::falls);
  report.record({"factor without stress, block theory",
                 "1",
                 Kind::exact,
                 "equilibrium: no joint is pressed",
                 0,
                 {0, 0},
                 "nothing resists"},
                *survey.rows[0].bolted.factor);
}

TEST(RoofWedge, FallsAtTheAngleOfJointRelaxation) {
  CaseReport report("roofwedge", {"critical friction"});
  struct {
    const char *name, *scene;
    std::vector<std::string> overrides;
    reference::RoofWedge wedge;
  } const variants[] = {{"critical friction", "scene.toml", {}, regular()},
                        {"critical friction, g = 10 m/s2", "scene.toml", {"gravity=[0,0,-10]"}, regular(10)},
                        {"critical friction, free to turn, 16 points a face", "free.toml", {}, regular()},
                        {"critical friction, whole faces", "scene.toml", {whole_faces}, regular()},
                        {"critical friction, free to turn, whole faces", "free.toml", {whole_faces}, regular()},
                        {"critical friction, ks = kn/5", "soft_shear.toml", {}, regular(9.81, 2e6)}};
  for (const auto& v : variants) {
    const SceneRun run = cases::run(v.scene, v.overrides);
    const double expected = reference::first_slip(v.wedge).friction / degree;
    if (&v == variants) report.reference("critical_friction", expected, "deg");
    check(report, v.name, expected, tight, why, value(run, "critical_friction"), run);
  }
}

TEST(RoofWedge, OneOfUnequalJointsSlipsLongBefore) {
  CaseReport report("roofwedge");
  const SceneRun run = cases::run("unequal.toml");
  const reference::RoofWedge wedge = roof_wedge(unequal_dips, unequal_directions);
  // in equilibrium on elastic joints the largest angle mobilised is that of first slip
  double mobilised = 0;
  for (const char* joint : {"A", "B", "C"})
    mobilised = std::max(mobilised, column(run, std::string(joint) + "_mobilised_friction_deg", settle).back());
  check(report, "first slip of unequal joints", reference::first_slip(wedge).friction / degree, tight, why, mobilised,
        run);
  check(report, "critical friction of unequal joints", reference::collapse(wedge).friction / degree, 0.04,
        "0.03 between the elastic-plastic wedge and a dynamic one of the same joints (reference/roofwedge), and as for "
        "equal joints",
        value(run, "critical_friction"), run);
}

// Only stress over weight matters: more weight is equivalent to less stress.
TEST(RoofWedge, NeedsMoreFrictionTheHeavierItIs) {
  CaseReport report("roofwedge");
  std::vector<double> gravity, found, expected;
  for (const double g : {2.5, 5.0, 7.5, 12.5, 20.0}) {
    const SceneRun run = cases::run("scene.toml", {"gravity=[0,0,-" + std::to_string(g) + "]"});
    gravity.push_back(g / 9.81);
    expected.push_back(reference::first_slip(regular(g)).friction / degree);
    found.push_back(value(run, "critical_friction"));
    if (g == 20) check(report, "critical friction, twice the weight", expected.back(), tight, why, found.back(), run);
  }
  write_csv("roofwedge", "weight.csv", {"weight", "friction_deg"}, {gravity, found});
  std::vector<double> weights, curve;
  for (double w = 0.1; w < 2.2; w += 0.05) {
    weights.push_back(w);
    curve.push_back(reference::first_slip(regular(9.81 * w)).friction / degree);
  }
  write_csv("roofwedge", "closed_form.csv", {"weight", "friction_deg"}, {weights, curve});
}

// ---- the stress is applied from outside (traction.toml)

constexpr int arrived = 2;                                  // the stage
constexpr double applied = 0.05e6;                          // Pa, as traction.toml states it
constexpr double stiffness = 1e9, thesis_stiffness = 10e6;  // Pa/m; traction.toml states the first
constexpr double share_across = 0.75;                       // of a horizontal stress, normal to a joint that dips 60

reference::RoofWedge under_stress(double stress, double stiffness_ratio = 1) {
  reference::RoofWedge wedge = regular(9.81, 10e6 / stiffness_ratio);
  wedge.stress = {stress, stress, 0, 0, 0, 0};
  return wedge;
}

double slip_deg(const reference::RoofWedge& wedge) {
  return reference::first_slip(wedge).friction / degree;
}

// softer joints oscillate more slowly and need as much longer to reach equilibrium
double time_to_rest(double ratio, double normal_stiffness) {
  return 0.1 * std::sqrt(stiffness / normal_stiffness * std::max(1.0, ratio));
}

SceneRun press_for(double duration, double stress, double ratio = 1, double normal_stiffness = stiffness,
                   std::vector<std::string> overrides = {}) {
  for (const char* stage : {"stress", "arrived"})
    overrides.push_back(fmt::format("stage.{}.duration_s={}", stage, duration));
  overrides.push_back(fmt::format("stage.stress.boundary.sides.stress=[{0},{0},0,0,0,0]", stress));
  overrides.push_back(fmt::format("joint_properties.rock.normal_stiffness={}", normal_stiffness));
  overrides.push_back(fmt::format("joint_properties.rock.shear_stiffness={}", normal_stiffness / ratio));
  return cases::run("traction.toml", overrides);
}

SceneRun press(double stress, double ratio = 1, double normal_stiffness = stiffness,
               const std::vector<std::string>& overrides = {}) {
  return press_for(time_to_rest(ratio, normal_stiffness), stress, ratio, normal_stiffness, overrides);
}

// Pa, on each of the wedge's joints before gravity is applied to it
std::array<double, 3> arrived_pressure(const SceneRun& run) {
  std::array<double, 3> pressure{};
  for (int i = 0; i < 3; ++i) {
    const std::string joint(1, static_cast<char>('A' + i));
    pressure[i] =
        column(run, joint + "_normal_force_N", arrived).back() / column(run, joint + "_area_m2", arrived).back();
  }
  return pressure;
}

// the horizontal stress in the rock that corresponds to such pressures
double arrived_stress(const SceneRun& run) {
  const std::array<double, 3> pressure = arrived_pressure(run);
  return (pressure[0] + pressure[1] + pressure[2]) / 3 / share_across;
}

constexpr const char* why_of_arrived =
    "half the bracket is 0.0005; the rock has closed in by 0.1 mm on faces a metre high, up to 0.5 mm under the most "
    "stress, which changes areas and shear by up to 0.03 %: 0.004";

void judge_pressure(CaseReport& report, const std::string& name, const SceneRun& run) {
  const std::array<double, 3> pressure = arrived_pressure(run);
  for (int i = 0; i < 3; ++i)
    report.record({fmt::format("pressure that arrives on joint {}{}", static_cast<char>('A' + i), name),
                   "Pa",
                   Kind::limit,
                   "equilibrium: homogeneous stress: 0.75 of the 0.05 MPa applied",
                   share_across * applied,
                   {0, 0.0005},
                   "closures of 0.1 mm change faces by 0.02 %"},
                  pressure[i], cost(run));
}

TEST(RoofWedge, FallsAtTheStressThatArrivesFromTheSides) {
  CaseReport report("roofwedge", {"critical friction, stress from the sides"});
  const std::vector<std::string> turning{"restrain.blocks.rotation=false"};
  std::vector<std::string> on_points = turning;
  on_points.push_back("joint_properties.rock.sub_contacts=4");
  const SceneRun run = press(applied), free = press(applied, 1, stiffness, on_points);
  judge_pressure(report, "", run);
  check(report, "critical friction, stress from the sides", slip_deg(under_stress(arrived_stress(run))), tight,
        why_of_arrived, value(run, "critical_friction"), run);
  judge_pressure(report, ", blocks free to turn on 16 points a face", free);
  check(report, "critical friction, stress from the sides, blocks free to turn on 16 points a face",
        slip_deg(under_stress(arrived_stress(free))), tight, why_of_arrived, value(free, "critical_friction"), free);

  // if a face transfers no moment, or deforms by millimetres, another stress arrives
  const auto tell = [&](const std::string& name, const SceneRun& other) {
    const std::array<double, 3> pressure = arrived_pressure(other);
    report.report("critical friction, stress from the sides, " + name, "deg", value(other, "critical_friction"),
                  fmt::format("closed form {:.3f} at the mean of {:.0f}, {:.0f} and {:.0f} Pa that arrive, of 37500",
                              slip_deg(under_stress(arrived_stress(other))), pressure[0], pressure[1], pressure[2]),
                  cost(other));
  };
  tell("blocks free to turn on one point a face", press(applied, 1, stiffness, turning));
  tell("the thesis' 10 MPa/m", press(applied, 1, thesis_stiffness));
}

TEST(RoofWedgeLong, FallsAtTheStressThatArrivesOnIntegratedFaces) {
  CaseReport report("roofwedge");
  const SceneRun whole = press(applied, 1, stiffness, {"restrain.blocks.rotation=false", whole_faces});
  judge_pressure(report, ", blocks free to turn on whole faces", whole);
  check(report, "critical friction, stress from the sides, blocks free to turn on whole faces",
        slip_deg(under_stress(arrived_stress(whole))), tight, why_of_arrived, value(whole, "critical_friction"), whole);
}

// the thesis' gravity, as for the stress applied to the joints
TEST(RoofWedge, FallsAtTenMetresPerSecondSquaredByTheSidesToo) {
  CaseReport report("roofwedge");
  const SceneRun run = press(applied, 1, stiffness, {"gravity=[0,0,-10]"});
  check(report, "critical friction at 10 m/s2, stress from the sides",
        reference::first_slip(regular(10)).friction / degree, tight, why_of_arrived, value(run, "critical_friction"),
        run);
}

// Without weight only the stress acts, however long it is applied.
TEST(RoofWedge, DoesNotDependOnTheDurationOfTheStress) {
  CaseReport report("roofwedge");
  for (const double duration : {0.1, 2.0}) {
    const SceneRun run = press_for(duration, applied, 5);
    check(report, fmt::format("critical friction, ks = kn/5, stress from the sides for {:g} s", duration),
          slip_deg(under_stress(applied, 5)), tight, why_of_arrived, value(run, "critical_friction"), run);
  }
}

struct Sweep {
  std::vector<double> at, found, expected;
};

void write_sweep(const Sweep& sweep, const std::string& what, const std::string& column) {
  write_csv("roofwedge", "traction_" + what + ".csv", {column, "friction_deg", "at_arrived_deg"},
            {sweep.at, sweep.found, sweep.expected});
}

void try_ratios(CaseReport& report, const std::vector<double>& ratios) {
  Sweep sweep;
  for (const double ratio : ratios) {
    const SceneRun run = press(applied, ratio);
    sweep.at.push_back(ratio);
    sweep.expected.push_back(slip_deg(under_stress(arrived_stress(run), ratio)));
    sweep.found.push_back(value(run, "critical_friction"));
    check(report, fmt::format("critical friction, stress from the sides, kn/ks = {}", ratio), sweep.expected.back(),
          tight, why_of_arrived, sweep.found.back(), run);
  }
  write_sweep(sweep, "ratio", "ratio");
}

void try_stresses(CaseReport& report, const std::vector<double>& stresses) {
  Sweep sweep;
  for (const double stress : stresses) {
    const SceneRun run = press(stress);
    sweep.at.push_back(1e-6 * stress);
    sweep.expected.push_back(slip_deg(under_stress(arrived_stress(run))));
    sweep.found.push_back(value(run, "critical_friction"));
    check(report, fmt::format("critical friction, stress from the sides, {:.3g} MPa", 1e-6 * stress),
          sweep.expected.back(), tight, why_of_arrived, sweep.found.back(), run);
  }
  write_sweep(sweep, "stress", "stress_MPa");
}

void write_closed_forms() {
  std::vector<double> ratios, by_ratio, stresses, by_stress;
  for (double exponent = -1.05; exponent < 1.06; exponent += 0.05) {
    ratios.push_back(std::pow(10, exponent));
    by_ratio.push_back(slip_deg(under_stress(applied, ratios.back())));
  }
  for (double stress = 0.015e6; stress < 0.211e6; stress += 0.0025e6) {
    stresses.push_back(1e-6 * stress);
    by_stress.push_back(slip_deg(under_stress(stress)));
  }
  write_csv("roofwedge", "closed_form_ratio.csv", {"ratio", "friction_deg"}, {ratios, by_ratio});
  write_csv("roofwedge", "closed_form_stress.csv", {"stress_MPa", "friction_deg"}, {stresses, by_stress});
}

TEST(RoofWedge, NeedsTheFrictionOfItsStiffnessRatioAndStress) {
  CaseReport report("roofwedge");
  try_ratios(report, {0.1, 0.2, 0.5, 1, 2, 5, 10});
  try_stresses(report, {0.02e6, 0.03e6, 0.05e6, 0.075e6, 0.1e6, 0.15e6, 0.2e6});
  write_closed_forms();
}

}  // namespace
}  // namespace voussoir::cases::roofwedge_test
