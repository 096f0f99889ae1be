// Floating blocks, in the plane and in space: heave, roll and pitch, the least width that floats upright, and the angle
// of loll.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/case_tools.hpp"
#include "reference/water/floating.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::floating_test {
namespace {

using reference::FloatingBlock;
using verification::Bound;
using verification::CaseReport;
using verification::Kind;

// as the scenes state them
const FloatingBlock raft{2, 1, 0.6, 9.81}, tender{1.1, 1, 0.5, 9.81};
constexpr double length = 3;     // m, in space
constexpr double pushed = 0.05;  // m/s and rad/s
const std::string in_plane = "raft.toml", in_space = "raft_space.toml";

// s: the mean of whole periods between the first and the last upward zero of a curve
double period_of(const std::vector<double>& time, const std::vector<double>& curve) {
  std::vector<double> rises;
  for (std::size_t i = 1; i < curve.size(); ++i)
    if (curve[i - 1] < 0 && curve[i] >= 0)
      rises.push_back(time[i - 1] - curve[i - 1] * (time[i] - time[i - 1]) / (curve[i] - curve[i - 1]));
  if (rises.size() < 3) throw std::runtime_error("too few swings to measure a period");
  return (rises.back() - rises.front()) / static_cast<double>(rises.size() - 1);
}

TEST(FloatingBlock, HeavesRollsAndPitches) {
  CaseReport report("water", {"heave, in the plane", "roll, in the plane", "roll, in space", "pitch, in space"});
  const FloatingBlock lengthwise{length, raft.height, raft.relative_density, raft.gravity};
  struct Swing {
    std::string name, column;
    double period;
  };
  const auto judge = [&](const std::string& scene, const std::string& where, const std::vector<Swing>& swings) {
    const SceneRun run = cases::run(scene);
    const std::vector<double> time = column(run, "time_s");
    for (const Swing& swing : swings)
      report.record({swing.name + where,
                     "s",
                     Kind::exact,
                     "Archimedes (Eq. 6.8); metacentre, I/V - BG",
                     swing.period,
                     {0, 5e-3},
                     "swings of 12 mm and a degree: the righting arm grows by 2e-4 with the square of the heel, and "
                     "the coupling of heave and roll is as small; the steps are some thousandth of a period"},
                    period_of(time, column(run, swing.column)), cost(run));
    return run;
  };
  const SceneRun plane =
      judge(in_plane, ", in the plane",
            {{"heave", "raft_displacement_y_m", heave_period(raft)}, {"roll", "raft_rotation_deg", roll_period(raft)}});
  judge(in_space, ", in space",
        {{"heave", "raft_displacement_z_m", heave_period(raft)},
         {"roll", "raft_rotation_y_deg", roll_period(raft)},
         {"pitch", "raft_rotation_x_deg", roll_period(lengthwise)}});
  const std::vector<double> time = column(plane, "time_s");
  std::vector<double> heave, roll;
  for (const double t : time) {
    heave.push_back(1e3 * pushed * heave_period(raft) / (2 * std::numbers::pi) *
                    std::sin(2 * std::numbers::pi * t / heave_period(raft)));
    roll.push_back(pushed * roll_period(raft) / (2 * std::numbers::pi * degree) *
                   std::sin(2 * std::numbers::pi * t / roll_period(raft)));
  }
  std::vector<double> heaved = column(plane, "raft_displacement_y_m");
  for (double& height : heaved)
    height *= 1e3;
  write_csv("water", "raft.csv", {"time_s", "heave_mm", "roll_deg", "heave_form_mm", "roll_form_deg"},
            {time, heaved, column(plane, "raft_rotation_deg"), heave, roll});
}

// deg: the angle at which it comes to rest
double heel_of(const std::string& scene, const std::vector<std::string>& overrides = {}) {
  const SceneRun run = cases::run(scene, overrides);
  return std::abs(value(run, scene.find("space") == std::string::npos ? "raft_rotation" : "raft_rotation_y"));
}

TEST(FloatingBlock, FloatsUprightFromAWidth) {
  CaseReport report("water");
  constexpr double upright = 1;  // deg
  const auto rights_itself = [](const std::string& scene, double width) {
    const double half = 0.5 * width;
    const bool space = scene == in_space;
    return heel_of(scene, {fmt::format("blocks.raft.box.min=[{}, {}-0.6]", -half, space ? "-1.5, " : ""),
                           fmt::format("blocks.raft.box.max=[{}, {}0.4]", half, space ? "1.5, " : ""),
                           space ? "blocks.raft.velocity=[0, 0, 0]" : "blocks.raft.velocity=[0, 0]",
                           space ? "blocks.raft.angular_velocity=[0, 0.002, 0]" : "blocks.raft.angular_velocity=0.002",
                           "damping.local=0.7", "stage.float.duration_s=30", "output.history_interval_s=1"}) < upright;
  };
  for (const std::string& scene : {in_plane, in_space}) {
    double heels = 1.14, floats = 1.25;
    ASSERT_FALSE(rights_itself(scene, heels));
    ASSERT_TRUE(rights_itself(scene, floats));
    const double bracket = scene == in_space ? 0.02 : 0.004;  // m: in space a trial costs ten times as much
    while (floats - heels > bracket) {
      const double middle = 0.5 * (heels + floats);
      (rights_itself(scene, middle) ? floats : heels) = middle;
    }
    report.record({"least width that floats upright" + std::string(scene == in_space ? ", in space" : ", in the plane"),
                   "m",
                   Kind::exact,
                   "equilibrium: metacentre at the centroid: b/h = sqrt(6 s (1 - s))",
                   reference::least_stable_ratio(raft.relative_density) * raft.height,
                   {0, 0.01},
                   "half the bracket is 0.002, in space 0.007; a block narrower by 0.0001 comes to rest at the degree "
                   "that counts as upright"},
                  0.5 * (heels + floats));
  }
}

TEST(FloatingBlock, LollsIfItIsTooNarrow) {
  CaseReport report("water");
  const double expected = angle_of_loll(tender) / degree;
  for (const std::string scene : {"tender.toml", "tender_space.toml"})
    report.record({"angle of loll" + std::string(scene == "tender.toml" ? ", in the plane" : ", in space"),
                   "deg",
                   Kind::exact,
                   "equilibrium: wall-sided formula: tan2 = -2 GM/BM",
                   expected,
                   {0.05, 0},
                   "the remaining oscillation after 60 s of damping"},
                  heel_of(scene));
}

}  // namespace
}  // namespace voussoir::cases::floating_test
