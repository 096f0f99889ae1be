// Block on level ground that is given a speed: its slip, by explicit and by implicit steps.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/case_tools.hpp"
#include "reference/small/small.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::pulse_test {
namespace {

using verification::CaseReport;
using verification::Kind;

// as pulse.toml states it: a square with sides of 2 m
constexpr double g = 9.81, speed = 0.5, acceleration = 0.5 * g, density = 2000, shear_stiffness = 1e12, side = 2;

double slip_of(const SceneRun& run) {
  return value(run, "ground_displacement_x") - value(run, "block_displacement_x");
}

TEST(Pulse, SlipsByNewmarksDistance) {
  const auto name_of = [](const std::string& friction, const std::string& steps) {
    return "slip of a pulse, tan 0." + friction + ", " + steps + " steps";
  };
  CaseReport report("shaking", {name_of("1", "explicit"), name_of("1", "implicit"), name_of("3", "explicit"),
                                name_of("3", "implicit")});
  const double frequency = std::sqrt(shear_stiffness * side / (density * side * side));
  for (const auto& [tenths, friction] : {std::pair{"1", 0.1}, std::pair{"3", 0.3}})
    for (const std::string steps : {"explicit", "implicit"}) {
      const SceneRun run =
          cases::run("pulse.toml", {"stage.push.time.integration=" + steps,
                                    "joint_properties.rock.friction_deg=" + text(std::atan(friction) / degree)});
      const double lasts = speed / (friction * g);
      report.record({name_of(tenths, steps),
                     "m",
                     Kind::exact,
                     "Newmark (1965), sliding block",
                     reference::slip_of_pulse(speed, acceleration, friction * g),
                     {acceleration / frequency * lasts, 0},
                     "the pulse begins with full acceleration: until the joint is fully sheared the ground gains at "
                     "most that over the block's frequency on the joint, 0.3 mm/s, and keeps it while the slip lasts"},
                    slip_of(run), cost(run));
    }
}

}  // namespace
}  // namespace voussoir::cases::pulse_test
