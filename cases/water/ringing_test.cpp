// A block whose weight doubles suddenly slips while its contact rings: the joint itself, without water.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/case_tools.hpp"
#include "reference/water/ringing.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::ringing_test {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;

// as ringing.toml states it
const reference::RingingBlock block{2000, 35 * degree, 40 * degree, 1e7, 2.5e6, 9.81};
constexpr int settle = 1, ring = 2;

struct Slip {
  std::vector<double> time, slip;  // s since gravity doubled, m
};

// plastic slip down the incline: displacement of the block less the elastic part of its spring
Slip slip_of(const SceneRun& run, double shear_stiffness) {
  const auto plastic = [&](int stage) {
    const std::vector<double> x = column(run, "block_displacement_x_m", stage),
                              y = column(run, "block_displacement_y_m", stage),
                              shear = column(run, "joint_shear_force_N", stage);
    std::vector<double> slip;
    for (std::size_t i = 0; i < x.size(); ++i)
      slip.push_back(-x[i] * std::cos(block.incline) - y[i] * std::sin(block.incline) - shear[i] / shear_stiffness);
    return slip;
  };
  const double start = column(run, "time_s", settle).back(), before = plastic(settle).back();
  Slip found{column(run, "time_s", ring), plastic(ring)};
  for (double& time : found.time)
    time -= start;
  for (double& slip : found.slip)
    slip -= before;
  return found;
}

TEST(RingingBlock, SlipsWhileItsContactIsLight) {
  CaseReport report("water", {"slip after 0.5 s, ringing block", "slip after 1 s, ringing block"});
  for (const double time : {0.5, 1.0}) {
    const SceneRun run = cases::run("ringing.toml", {"stage.ring.duration_s=" + std::to_string(time)});
    const Slip found = slip_of(run, block.shear_stiffness);
    report.record({time == 1 ? "slip after 1 s, ringing block" : "slip after 0.5 s, ringing block",
                   "m",
                   Kind::exact,
                   "spring and slider under a contact force that rings, reference/water",
                   ringing_slip(block, time),
                   {0, 5e-3},
                   "a slip begins and ends within a step, a hundredth of the stable one: 2e-5; as demanded"},
                  found.slip.back(), cost(run));
    if (time < 1) continue;
    std::vector<double> closed_form, slip_mm;
    for (std::size_t i = 0; i < found.time.size(); ++i) {
      closed_form.push_back(1e3 * ringing_slip(block, found.time[i]));
      slip_mm.push_back(1e3 * found.slip[i]);
    }
    write_csv("water", "ringing.csv", {"time_s", "slip_mm", "closed_form_mm"}, {found.time, slip_mm, closed_form});
  }
}

TEST(RingingBlock, KeepsItsMobilisedFrictionOnEqualSprings) {
  CaseReport report("water");
  const SceneRun run = cases::run("ringing.toml", {"joint_properties.rock.shear_stiffness=1e7"});
  double most = 0;
  for (const double slip : slip_of(run, 1e7).slip)
    most = std::max(most, std::abs(slip));
  report.record({"largest slip, ringing block, ks = kn",
                 "m",
                 Kind::limit,
                 "identity: shear and normal force ring alike",
                 0,
                 {1e-9, 0, Bound::at_most},
                 "the effect of 1e-9 of unbalanced force, and rounding of millimetres"},
                most, cost(run));
}

}  // namespace
}  // namespace voussoir::cases::ringing_test
