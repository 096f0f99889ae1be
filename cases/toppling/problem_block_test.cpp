// The block of the problem files, which topples over its lower edge as gravity is inclined: rigid, and on elastic
// joints.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/limit/limit_analysis.hpp"
#include "app/limit/limit_loads.hpp"
#include "cases/case_tools.hpp"
#include "reference/small/block_on_joint.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::problem_block_test {
namespace {

using verification::CaseReport;
using verification::Kind;

constexpr double breadth = 0.5, height = 1, density = 2000, gravity = 9.81, bracket = 0.005;  // m, kg/m3, m/s2, deg
const std::string quantity = "block of the problem files: slope that overturns it, ";

std::string inclined(double tilt_deg) {
  return fmt::format("gravity=[{:.17g}, {:.17g}]", gravity * std::sin(tilt_deg * degree),
                     -gravity * std::cos(tilt_deg * degree));
}

// m from the start, by rows 0.05 s apart
bool overturns(double tilt, double stiffness) {
  const std::string k = fmt::format("{:.17g}", stiffness);
  const SceneRun run = cases::run("problem_block.toml", {inclined(tilt), "joint_properties.rock.normal_stiffness=" + k,
                                                         "joint_properties.rock.shear_stiffness=" + k});
  const std::vector<double> x = column(run, "block_displacement_x_m"), y = column(run, "block_displacement_y_m");
  const auto between = [&](std::size_t a, std::size_t b) { return std::hypot(x[b] - x[a], y[b] - y[a]); };
  return between(50, 70) - between(30, 50) > 5e-4 || between(0, 70) > 0.3;
}

TEST(ToppledBlock, OverturnsOnElasticJointsWhereTheClosedFormLosesItsEquilibrium) {
  for (const double stiffness : {1e11, 1e9}) {
    const std::string name = quantity + fmt::format("{:g} GPa/m", 1e-9 * stiffness);
    CaseReport report("toppling", {name});
    reference::BlockOnJoint block;
    block.breadth = breadth;
    block.height = height;
    block.density = density;
    block.gravity = gravity;
    block.normal_stiffness = stiffness;
    const double expected = reference::greatest_resting_slope(block) / degree;
    const double rigid = std::atan(breadth / height) / degree;
    double stands = 15, falls = 40;
    while (falls - stands > bracket) {
      const double middle = 0.5 * (stands + falls);
      (overturns(middle, stiffness) ? falls : stands) = middle;
    }
    report.record(
        {name,
         "deg",
         Kind::exact,
         "equilibria of a block on an elastic joint without tension, reference/small",
         expected,
         {bracket, 0.1 * (rigid - expected) / expected},
         "the bracket; a tenth of what the joint takes from the slope of a rigid block: gravity that grows "
         "within 1 s leaves a lean that swings, and a block within that of its balance moves by 0.5 mm in 2 s"},
        0.5 * (stands + falls));
  }
}

// the acceleration down the slab that overturns it is the tangent of that slope
TEST(ToppledBlock, OverturnsAsARigidBlockByLimitAnalysis) {
  const std::string name = quantity + "rigid";
  CaseReport report("toppling", {name});
  const LoadedScene scene =
      load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / "problem_block.toml", {"gravity=[0, -9.81]"});
  LimitRequest request;
  request.load = limit_load("right");
  for (const auto& [known, value] : analyse_limit<2>(scene, request).values)
    if (known == "collapse_factor_upper_bound")
      report.record({name,
                     "deg",
                     Kind::exact,
                     "equilibrium: moments about the lower edge, tan slope = b/h",
                     std::atan(breadth / height) / degree,
                     {1e-6, 0},
                     "bounds from forces and from the mechanism meet to 1e-9 of the factor"},
                    std::atan(value.value) / degree);
}

}  // namespace
}  // namespace voussoir::cases::problem_block_test
