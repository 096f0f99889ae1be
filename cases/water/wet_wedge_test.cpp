// The wedge of cases/wedge under water, against the closed form with uplift and, if settlement locks in shear, against
// the elastic-plastic path; and three methods of lowering friction against each other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cases/case_tools.hpp"
#include "reference/wedge/wedge_path.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::wet_wedge_test {
namespace {

using reference::ElasticPlasticWedge;
using verification::CaseReport;
using verification::Check;
using verification::Kind;

// as wedge.toml states it
constexpr double face_dip = 70, face_dip_direction = 182, height = 1;  // deg, deg, m
constexpr double normal_stiffness = 1e9;                               // Pa/m

// with a pressure in both joints, Pa, or water in them up to a level above the lowest corner, m
ElasticPlasticWedge wedge(double stiffness_ratio, double pressure, double full_to = 0) {
  ElasticPlasticWedge block;
  block.wedge.a = {40 * degree, 130 * degree};
  block.wedge.b = {60 * degree, 220 * degree};
  const reference::WedgeFaces faces = wedge_faces(block.wedge, face_dip * degree, face_dip_direction * degree, height);
  const reference::WedgeUplift uplift = wedge_uplift(faces, height, full_to, 9810);
  block.wedge.weight = faces.volume * 2000 * 9.81;
  block.wedge.a.uplift_force = pressure * faces.area_a + uplift.a;
  block.wedge.b.uplift_force = pressure * faces.area_b + uplift.b;
  block.area_a = faces.area_a;
  block.area_b = faces.area_b;
  block.normal_stiffness = normal_stiffness;
  block.shear_stiffness = stiffness_ratio * normal_stiffness;
  return block;
}

Check angle_check(const std::string& quantity, const std::string& source, double expected, double tolerance_deg,
                  const std::string& because) {
  return {quantity, "deg", Kind::exact, source, expected / degree, {tolerance_deg, 0}, because};
}

const std::string closed_form = "Hoek & Bray (1974), with uplift";

TEST(WetWedge, SlidesAtOneAngleWhateverTheLevel) {
  CaseReport report("water");
  const double expected = *critical_friction(wedge(0.01, 0).wedge);
  for (const double level : {-0.4, 0.5})
    report.record(
        angle_check(fmt::format("critical friction, wedge under water, level {} m", level), closed_form, expected, 0.1,
                    "half the bracket is 0.005; the sliver contact below the wedge's edge is worth 0.02; as "
                    "demanded"),
        value(run("wedge_level.toml", {fmt::format("water.lake.level={}", level)}), "critical_friction"));
}

TEST(WetWedge, SlidesEarlierOnJointsUnderPressure) {
  CaseReport report("water");
  report.record(angle_check("critical friction, wedge, 1 kPa in its joints", closed_form,
                            *critical_friction(wedge(0.01, 1000).wedge), 0.1,
                            "settlement locks in some shear even at ks = kn/100: 0.03; half the bracket is 0.005"),
                value(run("wedge_pressure.toml"), "critical_friction"));
  report.record(angle_check("critical friction, wedge, joints half full", closed_form,
                            *critical_friction(wedge(0.01, 0, 0.5).wedge), 0.1, "as under pressure"),
                value(run("wedge_joints.toml"), "critical_friction"));
}

// The wedge on stiffer joints is stable to a slightly lower angle.
TEST(WetWedge, StiffShearFollowsTheElasticPlasticPath) {
  CaseReport report("water");
  std::vector<double> ratios{0.01, 0.1, 1}, path, found;
  for (const double ratio : ratios) {
    path.push_back(elastic_plastic_path(wedge(ratio, 1000)).critical_friction / degree);
    const SceneRun scene =
        run("wedge_pressure.toml", {fmt::format("joint_properties.rock.shear_stiffness={}", ratio * normal_stiffness)});
    found.push_back(value(scene, "critical_friction"));
    if (ratio < 0.1) continue;
    report.record(angle_check(fmt::format("critical friction, wedge, 1 kPa in its joints, ks/kn = {}", ratio),
                              "elastic-plastic block with three translations on two faces, reference/wedge",
                              path.back() * degree, 0.05,
                              "half the bracket is 0.005, the path's steps 0.0003; additional slip by inertia releases "
                              "locked-in shear, by up to 0.03 on the dry wedge"),
                  found.back(), cost(scene));
  }
  std::vector<double> ratio_path, angle_path;
  for (double power = -2; power < 0.01; power += 0.1) {
    ratio_path.push_back(std::pow(10, power));
    angle_path.push_back(elastic_plastic_path(wedge(ratio_path.back(), 1000)).critical_friction / degree);
  }
  write_csv("water", "wedge.csv", {"ks_over_kn", "computed_deg"}, {ratios, found});
  write_csv("water", "wedge_path.csv", {"ks_over_kn", "path_deg"}, {ratio_path, angle_path});
}

// Bisection, steps and a rate: within their error bars and the effect of the loading path.
TEST(ThreeWays, LowerFrictionToTheSameAngle) {
  CaseReport report("water");
  constexpr double path_dependence = 0.1;  // deg
  for (const std::string scene : {"scene", "drawdown", "wedge_pressure"}) {
    const std::string name = scene == "scene" ? "plane" : scene;
    const SceneRun by_bisection = run(scene + ".toml");
    const Value expected = *by_bisection.results.find("critical_friction");
    for (const std::string way : {"steps", "rate"}) {
      const SceneRun other = run(name + "_" + way + ".toml");
      const Value found = *other.results.find("critical_friction");
      report.record({fmt::format("critical friction, {}, by {}", name, way),
                     "deg",
                     Kind::limit,
                     "comparison: bisection",
                     expected.value,
                     {*expected.error_bar + *found.error_bar + path_dependence, 0},
                     "both error bars, and 0.1 for the loading path"},
                    found.value, cost(other));
    }
  }
}

}  // namespace
}  // namespace voussoir::cases::wet_wedge_test
