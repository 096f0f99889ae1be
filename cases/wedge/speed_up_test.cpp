// Cost of the critical angle: bisection by relaxation and two extrapolated rates against the thesis' constant rate.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cases/speed_up.hpp"
#include "reference/wedge/wedge.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::speed_up_test {
namespace {

using verification::CaseReport;

SoughtAngle closed_form() {
  reference::Wedge wedge;
  wedge.a = {40 * degree, 130 * degree};
  wedge.b = {60 * degree, 220 * degree};
  return {*reference::critical_friction(wedge) / degree, "Hoek & Bray (1974)",
          "as demanded; the bracket is worth 0.02, the sliver below the edge 0.02; the error of the extrapolation is "
          "in its "
          "error bar"};
}

double error_of(const SceneRun& run) {
  return std::abs(value(run, "critical_friction") - closed_form().expected);
}

TEST(WedgeSaving, BisectionAndTwoRatesAgainstTheThesisRate) {
  CaseReport report("wedge", {"critical friction, bisection over ten degrees", "critical friction, two rates"});
  const SceneRun thesis = run("thesis_rate.toml");
  report.report("critical friction, the thesis' rate", "deg", value(thesis, "critical_friction"),
                "found too late, within its error bar", cost(thesis));
  expect_honest_bar(report, closed_form(), "the thesis' rate", thesis);
  expect_speed_up(report, closed_form(), "bisection over ten degrees", run("narrow.toml"), thesis);
  const SceneRun two = run("two_rates.toml");
  expect_speed_up(report, closed_form(), "two rates", two, thesis);
  expect_honest_bar(report, closed_form(), "two rates", two);
  const SceneRun local = run("narrow.toml", {"statics=\"local\"", "stage.reduce.ramp_steps=500"});
  report.report("contact evaluations of bisection by local damping", "1", evaluations(local),
                "500 steps of ramp, each a fifth as long as relaxation's", cost(local));
}

// a method's error against its cost as one setting varies
void sweep(const std::string& file, const std::string& scene, const std::vector<std::vector<std::string>>& settings) {
  std::vector<double> spent, error;
  for (const std::vector<std::string>& overrides : settings) {
    const SceneRun done = run(scene, overrides);
    spent.push_back(evaluations(done));
    error.push_back(error_of(done));
  }
  write_csv("wedge", file, {"evaluations", "error_deg"}, {spent, error});
}

TEST(WedgeSavingFigure, HasErrorAgainstCost) {
  std::vector<std::vector<std::string>> rates, pairs, brackets, damped;
  for (const double rate : {4.0, 2.0, 1.0, 0.5, 0.25, 0.1, 0.025})
    rates.push_back({fmt::format("stage.reduce.rate_deg_per_s={}", rate)});
  for (const double rate : {8.0, 4.0, 2.0, 1.0, 0.5})
    pairs.push_back({fmt::format("stage.reduce.rate_deg_per_s={}", rate),
                     fmt::format("stage.reduce.slower_rate_deg_per_s={}", rate / 4)});
  for (const double tolerance : {3.0, 1.0, 0.3, 0.1, 0.05, 0.02}) {
    brackets.push_back({fmt::format("stage.reduce.tolerance_deg={}", tolerance)});
    damped.push_back({brackets.back().front(), "statics=\"local\"", "stage.reduce.ramp_steps=500"});
  }
  sweep("rates.csv", "thesis_rate.toml", rates);
  sweep("two_rates.csv", "two_rates.toml", pairs);
  sweep("bisection.csv", "narrow.toml", brackets);
  sweep("bisection_local.csv", "narrow.toml", damped);
}

}  // namespace
}  // namespace voussoir::cases::speed_up_test
