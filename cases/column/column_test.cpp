// Column of cubes on springs: how far each joint closes, and the period of the first mode.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/case_tools.hpp"
#include "reference/small/small.hpp"

namespace voussoir::cases::column_test {
namespace {

using verification::CaseReport;
using verification::Kind;

// as the scenes state it
const reference::Column eight{8, 2000, 2e8, 10};
constexpr double top_speed_scale = 0.01;  // m/s

std::vector<double> displacement(const SceneRun& run, int cube) {
  return column(run, fmt::format("cube_{}_displacement_z_m", cube));
}

// In equilibrium joint j carries the cubes above it.
TEST(Column, SettlesOnItsSprings) {
  CaseReport report("column", {"overlap of joint 0", "overlap of joint 7", "settlement of the top"});
  const SceneRun run = cases::run("scene.toml");
  const std::vector<double> overlaps = reference::column_overlaps(eight);
  const double one = overlaps.back(), tolerance = 4e-5 * one;
  const std::string because =
      "equilibrium leaves each of 8 cubes 1e-6 of the mean contact force, 4.5 weights, unbalanced: 3.6e-5 of a weight "
      "at most";
  double below = 0, settlement = 0;
  std::vector<double> joint, expected_mm, found_mm;
  for (int j = 0; j < eight.blocks; ++j) {
    const double here = displacement(run, j + 1).back();
    report.record({fmt::format("overlap of joint {}", j),
                   "m",
                   Kind::exact,
                   "equilibrium: (8 - j) m g/k",
                   overlaps[j],
                   {tolerance, 0},
                   because},
                  below - here, cost(run));
    joint.push_back(j);
    expected_mm.push_back(1e3 * overlaps[j]);
    found_mm.push_back(1e3 * (below - here));
    settlement += overlaps[j];
    below = here;
  }
  report.reference("cube_8_displacement_z", -settlement, "m");
  report.record({"settlement of the top",
                 "m",
                 Kind::exact,
                 "equilibrium: 36 m g/k",
                 settlement,
                 {8 * tolerance, 0},
                 "eight joints, each with its own fraction"},
                -below, cost(run));
  write_csv("column", "overlaps.csv", {"joint", "overlap_mm", "closed_form_mm"}, {joint, found_mm, expected_mm});
}

// Started in the shape of the first mode, it oscillates in it, with its period.
TEST(Column, SwingsInItsFirstMode) {
  CaseReport report("column", {"period of the first mode", "largest distance from the first mode"});
  const SceneRun run = cases::run("mode.toml");
  const double frequency = reference::column_frequency(eight), period = 2 * std::numbers::pi / frequency;
  const double step = run.results.stages.front().time_step, half = 0.5 * frequency * step;

  // zeros of the top's displacement on its way up, between rows
  const std::vector<double> time = column(run, "time_s"), top = displacement(run, 8);
  std::vector<double> zeros;
  for (std::size_t i = 1; i < top.size(); ++i)
    if (top[i - 1] < 0 && top[i] >= 0)
      zeros.push_back(time[i - 1] + (time[i] - time[i - 1]) * top[i - 1] / (top[i - 1] - top[i]));
  report.record({"period of the first mode",
                 "s",
                 Kind::exact,
                 "Newton: 2 sqrt(k/m) sin(pi/34), chain of equal springs",
                 period,
                 {0, half * half / 4},
                 "leapfrog shortens it by (omega dt)2/24; half as much for zeros between rows"},
                (zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1), cost(run));

  // every cube against its place in the mode
  double largest = 0;
  const double amplitude = top_speed_scale / frequency;
  std::vector<double> closed_form_mm, top_mm;
  for (int i = 1; i <= eight.blocks; ++i) {
    const std::vector<double> found = displacement(run, i);
    const double shape = amplitude * std::sin(i * std::numbers::pi / 17);
    for (std::size_t k = 0; k < time.size(); ++k)
      largest = std::max(largest, std::abs(found[k] - shape * std::sin(frequency * time[k])));
  }
  report.record({"largest distance from the first mode",
                 "m",
                 Kind::exact,
                 "identity: A_i sin(omega t)",
                 0,
                 {amplitude * half * half * (1 + frequency * time.back() / 6), 0},
                 "leapfrog: amplitude by (omega dt/2)2/2, phase by omega t (omega dt/2)2/6; the remainder is a margin"},
                largest, cost(run));
  for (std::size_t k = 0; k < time.size(); ++k) {
    top_mm.push_back(1e3 * top[k]);
    closed_form_mm.push_back(1e3 * amplitude * std::sin(8 * std::numbers::pi / 17) * std::sin(frequency * time[k]));
  }
  write_csv("column", "mode.csv", {"time_s", "top_mm", "closed_form_mm"}, {time, top_mm, closed_form_mm});
}

}  // namespace
}  // namespace voussoir::cases::column_test
