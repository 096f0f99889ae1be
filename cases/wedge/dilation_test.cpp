// A wedge whose joints dilate, from none to associated flow.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cases/case_tools.hpp"
#include "cases/wedge/wedge_scene.hpp"

namespace voussoir::cases::wedge_dilation_test {
namespace {

using verification::CaseReport;
using verification::Kind;

// A symmetric wedge: its line plunges by ε, its faces are at the angle a to the vertical plane through that line. Slip
// with dilation ψ turns out of the line by δ, sin δ = tan ψ cot a, and is possible from
//   tan φ = sin a tan ε / (cos δ + tan ε cos a sin δ)
// on; ψ = φ is associated flow, the least angle.
double critical_deg(double dilation_deg) {
  const double plunge = 38 * degree, a = 45 * degree;
  const double delta = std::asin(std::tan(dilation_deg * degree) / std::tan(a));
  return std::atan(std::sin(a) * std::tan(plunge) /
                   (std::cos(delta) + std::tan(plunge) * std::cos(a) * std::sin(delta))) /
         degree;
}

double associated_deg() {
  const double slope = std::tan(38 * degree);
  return std::atan(std::sin(45 * degree) * slope / std::sqrt(1 + 0.5 * slope * slope)) / degree;
}

// planes that meet in a line that plunges by 38 degrees to the east, each at 45 degrees to the vertical plane through
// it
const reference::Wedge symmetric = wedge(56.137086019, 31.619006537, 56.137086019, 148.380993463);

double found(double dilation_deg) {
  std::vector<std::string> sets = overrides(symmetric);
  sets.insert(sets.end(), {"joint_properties.rock.dilation_law=constant", "joint_properties.rock.dilation_until_m=1",
                           fmt::format("joint_properties.rock.dilation_deg={:.17g}", dilation_deg)});
  return value(run("scene.toml", sets), "critical_friction");
}

TEST(WedgeDilation, LowersTheCriticalFriction) {
  CaseReport report("wedge");
  const char* const because =
      "bracket 0.005; elastic settlement and the overlap move it by 0.01, as without dilation (28.927 of 28.919)";
  for (const double dilation : {5.0, 10.0, 20.0})
    report.record({fmt::format("critical friction, joints that dilate by {:g} degrees", dilation),
                   "deg",
                   Kind::exact,
                   "equilibrium of a wedge whose slip leaves its faces at the dilation",
                   critical_deg(dilation),
                   {0.02, 0},
                   because},
                  found(dilation));
  // from 30 degrees down the dilation in force is the friction itself
  report.record({"critical friction, joints that dilate by their friction",
                 "deg",
                 Kind::exact,
                 "equilibrium of the same wedge, associated flow",
                 associated_deg(),
                 {0.02, 0},
                 because},
                found(30));
}

}  // namespace
}  // namespace voussoir::cases::wedge_dilation_test
