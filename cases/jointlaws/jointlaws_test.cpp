// Joint laws on laboratory paths: the law alone against closed forms, and a block on a base under each law, on one to
// eight points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "cases/case_tools.hpp"
#include "core/joint_laws/joint_path.hpp"
#include "core/scene/scene.hpp"
#include "reference/jointedbeam/joint.hpp"
#include "reference/small/shear_curve.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {
namespace {

using verification::CaseReport;
using verification::Kind;

constexpr double angle = 40 * degree;

// Boon (2013), section 4.12; Eq. 6.7 with a scale of slip for a laboratory
const reference::StressStiffness linear_normal{4e9, 7.4e4, 1}, halved_normal{2e9, 3.7e4, 1},
    power_normal{0, 2.1e6, 0.75};
const reference::StressStiffness linear_shear{1e8, 9.7e4, 1}, power_shear{0, 1.9e6, 0.7};
constexpr double softening_drop = 0.4, softening_scale = 2e-4;
double peak_slip(double stress) {
  return 2e-6 * std::pow(stress, 0.213);
}

// as scene.toml states them
using Overrides = std::vector<std::string>;
Overrides stated(const Overrides& keys) {
  Overrides all;
  for (const std::string& key : keys)
    all.push_back("joint_properties.rock." + key);
  return all;
}
const Overrides constant = {};
const Overrides linear = stated({"normal_law=linear", "normal_stiffness=4e9", "normal_growth=7.4e4", "shear_law=linear",
                                 "shear_stiffness=1e8", "shear_growth=9.7e4"});
const Overrides power = stated({"normal_law=power", "normal_stiffness=2.1e6", "normal_exponent=0.75", "shear_law=power",
                                "shear_stiffness=1.9e6", "shear_exponent=0.7"});
const Overrides hardened = stated({"normal_law=linear", "normal_stiffness=2e9", "normal_growth=3.7e4",
                                   "shear_law=power", "shear_stiffness=1.9e6", "shear_exponent=0.7",
                                   "friction_law=hardening", "hardening_slip_m=2e-6", "hardening_exponent=0.213"});
const Overrides softened =
    stated({"shear_stiffness=1e10", "friction_law=softening", "softening_drop=0.4", "softening_slip_m=2e-4"});

struct Law {
  std::string name;
  Overrides overrides;
  reference::StressStiffness normal;
  std::function<double(double stress, double slip)> strength;  // Pa, sheared one way
};

std::vector<Law> laws() {
  const auto plastic = [](const reference::StressStiffness& shear) {
    return [shear](double stress, double slip) {
      return reference::perfectly_plastic_shear({stress, reference::stiffness_at(shear, stress), angle}, slip);
    };
  };
  return {{"constant", constant, {10e9}, plastic({1e9})},
          {"linear", linear, linear_normal, plastic(linear_shear)},
          {"power", power, power_normal, plastic(power_shear)},
          {"hardening", hardened, halved_normal,
           [](double stress, double slip) {
             return reference::hardening_shear({stress, reference::stiffness_at(power_shear, stress), angle},
                                               peak_slip(stress), slip);
           }},
          {"softening", softened, {10e9}, [](double stress, double slip) {
             return reference::softening_shear({stress, 1e10, angle}, softening_drop, softening_scale, slip);
           }}};
}

JointProperties joint(const Overrides& overrides) {
  return read_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / "scene.toml", overrides).properties.front().properties;
}

// ---- the law alone
// ----------------------------------------------------------------------------------------------------

TEST(JointLaws, LaboratoryPathsAreTheClosedForms) {
  CaseReport report("jointlaws");
  for (const Law& law : laws()) {
    const JointProperties properties = joint(law.overrides);
    double normal_error = 0, shear_error = 0;
    std::vector<std::vector<double>> normal(3), shear(5);
    for (const double stress : {0.5e6, 1e6, 2e6, 4e6}) {
      JointPath path;
      path.normal_stress = stress;
      path.slip = 4e-4;
      for (const JointPathPoint& at : follow(properties, path)) {
        if (at.slip == 0) {
          const double expected = reference::normal_stress(law.normal, at.overlap);
          normal_error = std::max(normal_error, std::abs(at.normal_stress - expected) / stress);
          if (stress == 4e6)
            for (const auto& [column, value] :
                 {std::pair{0, 1e6 * at.overlap}, {1, 1e-6 * at.normal_stress}, {2, 1e-6 * expected}})
              normal[column].push_back(value);
          continue;
        }
        const double expected = law.strength(stress, at.slip);
        shear_error = std::max(shear_error, std::abs(at.shear_stress - expected) / stress);
        const double row[] = {1e-6 * stress, 1e6 * at.slip, 1e-6 * at.shear_stress, 1e-6 * expected, at.friction};
        for (int k = 0; k < 5; ++k)
          shear[k].push_back(row[k]);
      }
    }
    const std::string because = "a few roundings of exponentials and powers";
    report.record(
        {"normal stress, " + law.name, "1", Kind::exact, "Boon (2013), Eqs 4.12-4.14", 0, {1e-10, 0}, because},
        normal_error);
    report.record({"shear stress, " + law.name,
                   "1",
                   Kind::exact,
                   "Boon (2013), Eqs 4.11, 4.16-4.18, 6.7",
                   0,
                   {1e-10, 0},
                   because},
                  shear_error);
    write_csv("jointlaws", law.name + "_normal.csv", {"closure_um", "stress_MPa", "closed_form_MPa"}, normal);
    write_csv("jointlaws", law.name + "_shear.csv",
              {"normal_MPa", "slip_um", "shear_MPa", "closed_form_MPa", "friction"}, shear);
  }
}

// curves of the formulas alone: Figs 4.17, 4.30 (b) and 4.31, and loops
TEST(JointLaws, CurvesForTheFigures) {
  std::vector<std::vector<double>> stiffness(5), degrading(3);
  for (int i = 1; i <= 200; ++i) {
    const double stress = 10e6 * i / 200;
    const double row[] = {1e-6 * stress, 1e-9 * reference::stiffness_at(linear_normal, stress),
                          1e-9 * reference::stiffness_at(power_normal, stress),
                          1e-9 * reference::stiffness_at(linear_shear, stress),
                          1e-9 * reference::stiffness_at(power_shear, stress)};
    for (int k = 0; k < 5; ++k)
      stiffness[k].push_back(row[k]);
  }
  for (const double stress : {0.5e6, 1e6, 2e6, 4e6})
    for (int i = 0; i <= 60; ++i) {
      const double slip = 60e-6 * i / 60,
                   left = std::max(1 - slip / peak_slip(stress), 0.0);  // not a law of the program
      const double row[] = {1e-6 * stress, 1e6 * slip, 1e-9 * left * reference::stiffness_at(power_shear, stress)};
      for (int k = 0; k < 3; ++k)
        degrading[k].push_back(row[k]);
    }
  write_csv("jointlaws", "stiffness.csv",
            {"stress_MPa", "linear_normal_GPa_per_m", "power_normal_GPa_per_m", "linear_shear_GPa_per_m",
             "power_shear_GPa_per_m"},
            stiffness);
  write_csv("jointlaws", "degrading.csv", {"normal_MPa", "slip_um", "stiffness_GPa_per_m"}, degrading);

  // two cycles under constant normal load, and the same with surroundings of normal stiffness
  for (const double surroundings : {0.0, 20e9}) {
    std::vector<std::vector<double>> loop(3);
    JointPath path;
    path.normal_stress = 2e6;
    path.slip = 2e-4;
    path.cycles = 2;
    path.surroundings = surroundings;
    path.dilation = surroundings > 0 ? 0.1 : 0;
    double dissipated = 0;
    for (const JointPathPoint& at : follow(joint(hardened), path)) {
      EXPECT_GE(at.dissipated, dissipated);
      dissipated = at.dissipated;
      const double row[] = {1e6 * at.slip, 1e-6 * at.shear_stress, 1e-6 * at.normal_stress};
      for (int k = 0; k < 3; ++k)
        loop[k].push_back(row[k]);
    }
    EXPECT_GT(dissipated, 0);
    write_csv("jointlaws", surroundings > 0 ? "stiffness_loop.csv" : "load_loop.csv",
              {"slip_um", "shear_MPa", "normal_MPa"}, loop);
  }
}

// ---- the law under a block
// --------------------------------------------------------------------------------------------

TEST(JointLaws, ABlockOnOneToEightPoints) {
  CaseReport report("jointlaws");
  const double stress = 4 * 2500 * 9.81;  // Pa: a column of 4 m; its base is 1 m²
  for (const Law& law : laws()) {
    double worst = 0, closure = 0;
    for (const int points : {1, 2, 4, 8}) {
      Overrides overrides = law.overrides;
      overrides.push_back("joint_properties.rock.sub_contacts=" + std::to_string(points));
      const SceneRun done = run("scene.toml", overrides);
      const std::vector<double> slip = column(done, "block_displacement_x_m", 2),
                                sink = column(done, "block_displacement_y_m", 2);
      const std::vector<double> force = column(done, "block_contact_load_x_N", 2);
      const double settled = column(done, "block_displacement_x_m", 1).back();
      for (std::size_t i = 1; i < slip.size(); ++i) {
        const double expected = law.strength(stress, slip[i] - settled);
        worst = std::max(worst, std::abs(-force[i] - expected) / stress);
      }
      closure = std::max(closure, std::abs(reference::normal_stress(law.normal, -sink.back()) - stress) / stress);
    }
    report.record({"closure of a block on 1 to 8 points, " + law.name,
                   "1",
                   Kind::exact,
                   "closed form of the law",
                   0,
                   {1e-5, 0},
                   "equilibrium to 1e-6 of the weight, and the remainder after shearing"},
                  closure);
    report.record({"shear of a block on 1 to 8 points, " + law.name,
                   "1",
                   Kind::exact,
                   "closed form of the law",
                   0,
                   {1e-5, 0},
                   "as the closure"},
                  worst);
  }
}

// ---- joints that dilate
// -----------------------------------------------------------------------------------------------

// L1 of the closed form: surroundings that grow stiffer on a joint that rises
TEST(JointLaws, DilationOnTheLaboratorysPaths) {
  CaseReport report("jointlaws");
  JointProperties p = joint(stated(
      {"shear_stiffness=4e9", "friction_deg=30", "dilation_law=constant", "dilation_deg=8", "dilation_until_m=0.004"}));
  JointPath path;
  path.normal_stress = 1e6;
  path.slip = 6e-3;
  path.surroundings = 2e9;
  const double coefficient = std::tan(p.friction), slope = std::tan(p.dilation);
  const double stiffness = 1 / (1 / p.normal_stiffness + 1 / path.surroundings);
  const double yield = coefficient * path.normal_stress / p.shear_stiffness;
  double worst = 0;
  std::vector<std::vector<double>> curve(5);
  for (const JointPathPoint& at : follow(p, path)) {
    if (at.slip == 0) continue;
    double plastic = std::max((at.slip - yield) / (1 + coefficient * stiffness * slope / p.shear_stiffness), 0.0);
    const double rise = slope * std::min(plastic, p.dilation_until), normal = path.normal_stress + stiffness * rise;
    const double shear = plastic > 0 ? coefficient * normal : p.shear_stiffness * at.slip;
    worst = std::max({worst, std::abs(at.normal_stress - normal) / normal, std::abs(at.shear_stress - shear) / normal});
    const double row[] = {1e3 * at.slip, 1e-6 * at.normal_stress, 1e-6 * at.shear_stress, 1e3 * at.rise, 1e-6 * shear};
    for (int k = 0; k < 5; ++k)
      curve[k].push_back(row[k]);
  }
  report.record({"stress of a joint that dilates between springs",
                 "1",
                 Kind::exact,
                 "closed form of the law",
                 0,
                 {1e-10, 0},
                 "overlaps found by halving, to rounding"},
                worst);
  write_csv("jointlaws", "dilation.csv", {"slip_mm", "normal_MPa", "shear_MPa", "rise_mm", "closed_form_MPa"}, curve);
}

// A rigid block: a = g (sin θ - μ cos θ)/(1 + μ tan ψ) down the plane, and tan ψ as much away from it.
TEST(JointLaws, ABlockSlidesAndRisesOnAJointThatDilates) {
  CaseReport report("jointlaws");
  const double gravity = 9.81, incline = 40 * degree, friction = std::tan(30 * degree), time = 0.5;
  for (const double dilation : {0.0, 8.0, 15.0}) {
    const double slope = std::tan(dilation * degree);
    const double slip =
        0.5 * gravity * (std::sin(incline) - friction * std::cos(incline)) / (1 + friction * slope) * time * time;
    double worst = 0;
    for (const int points : {1, 2}) {
      const SceneRun done =
          run("dilation.toml",
              stated({"dilation_deg=" + std::to_string(dilation), "sub_contacts=" + std::to_string(points)}));
      const std::vector<double> along = column(done, "block_displacement_x_m", 2),
                                away = column(done, "block_displacement_z_m", 2);
      worst = std::max({worst, std::abs(along.back() - along.front() - slip) / slip,
                        std::abs(away.back() - away.front() - slope * slip) / slip});
    }
    report.record({"displacement of a block on a joint that dilates by " + std::to_string(static_cast<int>(dilation)) +
                       " degrees",
                   "1",
                   Kind::exact,
                   "Newton's second law for a rigid block on the risen plane",
                   0,
                   {2e-5, 0},
                   "springs of 1e11 Pa/m: 1e-6 m of 0.2 m"},
                  worst);
  }
}

// The limit of the dilation ends the rise of a block at speed: it flies, and lands on the risen plane.
TEST(JointLaws, ABlockFliesFromTheLimitOfItsDilation) {
  CaseReport report("jointlaws");
  const double until = 0.1, slope = std::tan(8 * degree), gravity = 9.81, incline = 40 * degree;
  const double acceleration =
      gravity * (std::sin(incline) - std::tan(30 * degree) * std::cos(incline)) / (1 + std::tan(30 * degree) * slope);
  const double speed = slope * std::sqrt(2 * acceleration * until), weight = gravity * std::cos(incline);
  const double height = 0.5 * speed * speed / weight, plane = slope * until;
  const SceneRun done = run("dilation.toml", stated({"dilation_until_m=0.1"}));
  const std::vector<double> away = column(done, "block_displacement_z_m", 2);
  report.record({"flight above the risen plane",
                 "m",
                 Kind::exact,
                 "Newton's laws of a rigid block that is thrown",
                 height,
                 {0, 1e-2},
                 "a history of 1 ms misses the top by at most 1e-6 m; springs of 1e11 Pa/m"},
                *std::ranges::max_element(away) - away.front() - plane);
  // it bounces on: no lower than the risen plane and what its springs give
  const std::vector<double> along = column(done, "block_displacement_x_m", 2);
  double lowest = *std::ranges::max_element(away);
  for (std::size_t i = 0; i < away.size(); ++i)
    if (along[i] > 1.05 * until) lowest = std::min(lowest, away[i] - away.front());
  report.record(
      {"lowest place after the landing",
       "m",
       Kind::exact,
       "geometry of the joint",
       plane,
       {3e-5, 0},
       "it lands at 0.085 m/s on springs of 1e11 Pa/m, which give by 2e-5 m, and a history of 1 ms may miss that"},
      lowest);
}

}  // namespace
}  // namespace voussoir::cases
