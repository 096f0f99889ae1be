// Cost of the critical angle of the roof wedge: bisection by relaxation against the thesis' constant rate.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/speed_up.hpp"
#include "reference/roofwedge/roofwedge.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::speed_up_test {
namespace {

// long: the thesis' method takes a million and a half steps
TEST(RoofWedgeSavingLong, BisectionAgainstTheThesisRate) {
  reference::RoofWedge wedge;
  for (int i = 0; i < 3; ++i) {
    wedge.planes[i].dip = 60 * degree;
    wedge.planes[i].dip_direction = (30 + 120 * i) * degree;
  }
  wedge.gravity = 9.81;
  const SoughtAngle sought{reference::first_slip(wedge).friction / degree, "Goodman, Shi & Boyle (1982)",
                           "as demanded; the bracket is worth 0.02"};
  verification::CaseReport report("roofwedge", {"critical friction, bisection over ten degrees"});
  const SceneRun thesis = run("thesis_rate.toml");
  expect_honest_bar(report, sought, "the thesis' rate", thesis);
  expect_speed_up(report, sought, "bisection over ten degrees", run("narrow.toml"), thesis);
}

}  // namespace
}  // namespace voussoir::cases::speed_up_test
