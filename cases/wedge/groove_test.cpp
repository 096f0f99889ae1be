// A wedge in a groove: sent off along it, let loose at rest, and by limit analysis. The three are questions of their
// own: rigid blocks at rest have an equilibrium at every friction angle between the last and the first.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "app/limit/limit_analysis.hpp"
#include "cases/case_tools.hpp"
#include "reference/wedge/groove.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::groove_test {
namespace {

using verification::CaseReport;
using verification::Kind;

const reference::Groove groove{45 * degree, 38 * degree};
constexpr double bracket = 0.005;  // deg
const std::string quantity = "groove 45/38: ";

// along the groove; m from the start, by rows of the history
std::vector<double> path(double friction, std::vector<std::string> overrides) {
  overrides.push_back(fmt::format("joint_properties.rock.friction_deg={:.17g}", friction));
  return column(cases::run("groove.toml", overrides), "wedge_displacement_x_m");
}

// the path at a time, from rows 0.05 s apart, of which the first is the start
double at(const std::vector<double>& path, double time) {
  return path.at(static_cast<std::size_t>(std::lround(time / 0.05)));
}

// middle of the last bracket of the least friction angle at which it holds
double bisect(double fails, double holds, const std::function<bool(double)>& test) {
  while (holds - fails > bracket) {
    const double middle = 0.5 * (fails + holds);
    (test(middle) ? holds : fails) = middle;
  }
  return 0.5 * (fails + holds);
}

TEST(WedgeInAGroove, GetsFasterBelowTheFrictionOfItsClosedForm) {
  CaseReport report("wedge", {quantity + "critical friction, kinetic"});
  const double found = bisect(15, 40, [](double friction) {
    const std::vector<double> p = path(friction, {});
    return at(p, 1.5) - at(p, 1) <= at(p, 1) - at(p, 0.5);
  });
  report.record({quantity + "critical friction, kinetic",
                 "deg",
                 Kind::exact,
                 "Coulomb: tan phi = sin a tan psi, reference/wedge",
                 sliding_friction(groove) / degree,
                 {bracket, 0},
                 "the bracket is half of this; the joint's dashpot acts across the sliding"},
                found);
}

TEST(WedgeInAGroove, HoldsAtRestAboveTheSameAngle) {
  CaseReport report("wedge", {quantity + "critical friction, at rest"});
  const std::vector<std::string> rest{"blocks.wedge.velocity=[0, 0, 0]", "stage.slide.gravity_ramp_s=1",
                                      "stage.slide.duration_s=3.5", "stage.slide.damping.viscous_ratio=0.5"};
  const double found = bisect(27, 31, [&](double friction) {
    const std::vector<double> p = path(friction, rest);
    return at(p, 3.5) - at(p, 2.5) - (at(p, 2.5) - at(p, 1.5)) <= 5e-4 && at(p, 3.5) <= 0.3;
  });
  report.record(
      {quantity + "critical friction, at rest",
       "deg",
       Kind::exact,
       "Coulomb, weight that grows in proportion: the slip across the groove keeps its ratio to the slip along it, "
       "which grows without bound at the angle of sliding, reference/wedge",
       sliding_friction(groove) / degree,
       {2 * bracket, 0},
       "half the bracket; a growth of 0.5 mm a second is 5e-4 m/s2, which 0.004 deg of friction give"},
      found);
}

TEST(WedgeInAGroove, HasNoEquilibriumBelowTheFrictionOfLimitAnalysis) {
  CaseReport report("wedge", {quantity + "least friction of any equilibrium"});
  const LoadedScene scene = load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / "groove.toml", {});
  const LimitAnalysis<3> found = analyse_limit<3>(scene, LimitRequest{});
  for (const auto& [name, value] : found.values)
    if (name == "critical_friction_lower_bound")
      report.record({quantity + "least friction of any equilibrium",
                     "deg",
                     Kind::exact,
                     "limit analysis by hand: tan phi = sin a tan psi/(1 + tan2 psi cos2 a)^1/2, reference/wedge",
                     least_groove_friction(groove) / degree,
                     {3e-6, 0},
                     "bracket of 1e-6 degrees, and a gravity written with ten decimals"},
                    value.value);
}

}  // namespace
}  // namespace voussoir::cases::groove_test
