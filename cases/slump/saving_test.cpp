// What the critical angle of the slumping slope costs: bisection by relaxation against the thesis' constant rate.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/saving.hpp"
#include "reference/slump/elastoplastic.hpp"

namespace voussoir::cases {
namespace {

// long: the thesis' way takes five million steps of forty-five contacts
TEST(SlumpSaving, DISABLED_BisectionAgainstTheThesisRate) {
  constexpr double degrees = 180 / std::numbers::pi;
  const reference::LayeredSlope slope{60 / degrees, 5 / degrees, 4, 8, 50, 3, 2500, 9.81, 10e9, 10e9};
  const reference::SlopeCollapse collapse =
      reference::elastoplastic_collapse(slope, 60 / degrees, 5 / degrees, 0.0005 / degrees);
  const SoughtAngle sought{0.5 * (collapse.stands + collapse.collapses) * degrees, "blocks that slip without dilation",
                           "as demanded; the bracket leaves 0.04"};
  verification::CaseReport report("slump", {"critical friction, bisection over ten degrees"});
  const SceneRun thesis = run("thesis_rate.toml");
  report.report("critical friction, the thesis' rate", "deg", value(thesis, "critical_friction"),
                "found too late by a lag that grows with the rate", cost(thesis));
  expect_saving(report, sought, "bisection over ten degrees", run("narrow.toml"), thesis);
}

}  // namespace
}  // namespace voussoir::cases
