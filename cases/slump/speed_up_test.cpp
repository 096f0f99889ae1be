// What the critical angle of the slumping slope costs: bisection by relaxation against the thesis' constant rate.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/speed_up.hpp"

namespace voussoir::cases {
namespace {

// Long: the thesis' way takes four million steps of fifty contacts. SearchedQuantity is the angle of this model with
// this failure displacement, found by a finer bracket: the slope yields and rests again while it moves, so that the
// angle goes with the displacement that counts as failure (README), which is no matter of the search.
TEST(SlumpSavingLong, BisectionAgainstTheThesisRate) {
  verification::CaseReport report("slump", {"critical friction, bisection over ten degrees"});
  const SceneRun fine = run("scene.toml");
  const SoughtAngle sought{value(fine, "critical_friction"), "comparison: the same model, bisection to 0.013 degrees",
                           "as demanded; the brackets leave 0.04 and 0.013"};
  const SceneRun thesis = run("thesis_rate.toml");
  expect_honest_bar(report, sought, "the thesis' rate", thesis);
  expect_speed_up(report, sought, "bisection over ten degrees", run("narrow.toml"), thesis);
}

}  // namespace
}  // namespace voussoir::cases
