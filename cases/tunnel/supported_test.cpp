// Bolts and lining of an opening in jointed rock, against a linear network of the same blocks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cases/case_tools.hpp"
#include "cases/tunnel/twin.hpp"

namespace voussoir::cases {
namespace {

using verification::CaseReport;
using verification::Kind;

struct Difference {
  double mean = 0;     // of the differences' magnitudes, over the mean magnitude
  double largest = 0;  // over the largest magnitude
};

Difference difference(const std::vector<double>& computed, const std::vector<double>& expected) {
  if (computed.size() != expected.size() || expected.empty()) throw std::runtime_error("nothing to compare");
  double apart = 0, size = 0, worst = 0, largest = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    apart += std::abs(computed[i] - expected[i]);
    size += std::abs(expected[i]);
    worst = std::max(worst, std::abs(computed[i] - expected[i]));
    largest = std::max(largest, std::abs(expected[i]));
  }
  return {apart / size, worst / largest};
}

const char* const network = "linear network of the same blocks (reference/tunnel/network.hpp)";

const char* const why =
    "of 576 joints ten, 7 m and more from the centre, are open or closed in part in the program and whole in the "
    "network, "
    "and three corners overlap where it has no face; what that does to the opening falls with the square of the "
    "distance "
    "over a block's size, 1/50, times the 2 % of joints of which it is true in their region; displacements over block "
    "sizes are 1e-4";

void compare(CaseReport& report, const std::string& what, const std::vector<double>& program,
             const std::vector<double>& linear, verification::Cost cost) {
  const Difference apart = difference(program, linear);
  report.record(
      {what + ": mean difference from the network, of the mean", "1", Kind::exact, network, 0, {0.01, 0}, why},
      apart.mean, cost);
  report.record(
      {what + ": largest difference from the network, of the largest", "1", Kind::exact, network, 0, {0.02, 0}, why},
      apart.largest, cost);
}

TEST(Supported, TheSameBlocksAsTheNetwork) {
  CaseReport report("tunnel", {"convergence: mean difference from the network, of the mean"});
  const SupportedRun run = run_supported("same_blocks.toml");
  const Twins both = twins(run, 2);
  const verification::Cost cost = cases::cost(run.run);
  report.record(
      {"springs of bolts between other blocks than in the network", "1", Kind::exact, network, 0, {0, 0}, "a count"},
      static_cast<double>(std::max(both.linear.bolts.size(), both.program.bolts.size())) - both.same_joints, cost);
  report.record(
      {"mean convergence that supports meet", "m", Kind::exact, network, both.linear.mean_convergence, {0, 0.01}, why},
      both.program.mean_convergence, cost);
  compare(report, "convergence", both.program.convergence, both.linear.convergence, cost);
  compare(report, "bolt forces", both.program.bolts, both.linear.bolts, cost);
  compare(report, "thrust of the lining", both.program.thrust, both.linear.thrust, cost);
  compare(report, "moment of the lining", both.program.moment, both.linear.moment, cost);
}

// Half of what was to come is let off before the supports go in: they get half.
TEST(Supported, WhatIsLetOffBeforeIsNotTheirs) {
  CaseReport report("tunnel");
  const Increment all = twins(run_supported("same_blocks.toml"), 2).program;
  const SupportedRun run = run_supported("same_blocks.toml", {"stage.dig.let_off.share=0.75"});
  const Increment half = twins(run, 2).program;
  const auto sum = [](const std::vector<double>& forces) {
    double total = 0;
    for (const double force : forces)
      total += std::abs(force);
    return total;
  };
  const auto check = [&](const char* what, double computed) {
    report.record({fmt::format("{} where half is let off before, of all", what),
                   "1",
                   Kind::exact,
                   "1 - x of linear supports",
                   0.5,
                   {0.005, 0},
                   "1 % of it: joints far away that open in one run and not in the other, as against the network"},
                  computed, cost(run.run));
  };
  check("bolt forces", sum(half.bolts) / sum(all.bolts));
  check("thrust of the lining", sum(half.thrust) / sum(all.thrust));
  check("moments of the lining", sum(half.moment) / sum(all.moment));
}

}  // namespace
}  // namespace voussoir::cases
