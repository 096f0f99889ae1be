// Cost of the critical angle of the slumping slope: bisection by relaxation against the thesis' constant rate.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/speed_up.hpp"

namespace voussoir::cases::speed_up_test {
namespace {

// Long: the thesis' method takes four million steps of fifty contacts. SearchedQuantity is the angle of this model with
// this failure displacement, found by a finer bracket: the slope yields and reaches equilibrium again while it moves,
// so that the angle depends on the failure displacement (README), not on the search.
TEST(SlumpSavingLong, BisectionAgainstTheThesisRate) {
  verification::CaseReport report("slump", {"critical friction, bisection over ten degrees"});
  const SceneRun fine = run("scene.toml");
  const SoughtAngle sought{value(fine, "critical_friction"), "comparison: the same model, bisection to 0.013 degrees",
                           "as demanded; the brackets are worth 0.04 and 0.013"};
  const SceneRun thesis = run("thesis_rate.toml");
  expect_honest_bar(report, sought, "the thesis' rate", thesis);
  expect_speed_up(report, sought, "bisection over ten degrees", run("narrow.toml"), thesis);
}

}  // namespace
}  // namespace voussoir::cases::speed_up_test
