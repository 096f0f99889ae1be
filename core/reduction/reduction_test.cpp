// Strength reduction of a block on a slope, whose critical angle is the slope's.
#include "core/reduction/reduction.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/simulate.hpp"
#include "core/testing/models.hpp"

namespace voussoir {
namespace {

using shapes::block_on_plate;
using shapes::gravity;
using shapes::index_of;

// the bias formula is the leading term in an angle of 0.05 rad
constexpr double bias_tolerance = 0.01;

ReductionReport reduce_from_scratch(const Model<2>& model, const ReducePlan& plan, State<2>& state) {
  ReductionProgress<2> progress;
  return reduce<2>(model, {}, plan, state, progress);
}

TEST(Reduction, ABlockOnASlopeFailsAtTheSlopesAngle) {
  const double slope = 30 * degree;
  Model<2> model = block_on_plate<2>(slope, 40 * degree);
  for (const ReductionMethod method : {ReductionMethod::bisection, ReductionMethod::steps}) {
    State<2> state = initial_state(model);
    ReducePlan plan;
    plan.method = method;
    plan.from = 35 * degree;  // trials meet the slope's own angle
    plan.to = 27 * degree;
    plan.tolerance = 0.1 * degree;
    plan.step = 0.5 * degree;
    plan.failure_displacement = 0.01;
    const ReductionReport report = reduce_from_scratch(model, plan, state);
    ASSERT_TRUE(report.bracketed) << report.message;
    EXPECT_GE(report.stable, slope - 1e-3 * degree);
    EXPECT_LE(report.failed, slope + 1e-3 * degree);
    EXPECT_NEAR(report.critical, slope, report.error_bar + 1e-3 * degree);
    EXPECT_LE(report.error_bar, 0.25 * degree * (1 + 1e-12));
    EXPECT_FALSE(report.rule.empty());
  }
}

// What has moved since the search began counts in every trial, whichever trial it was that moved it.
TEST(Reduction, CountsWhatHasMovedSinceTheSearchBegan) {
  const double slope = 30 * degree;
  const Model<2> model = block_on_plate<2>(slope, 40 * degree);
  ReducePlan plan;
  plan.from = 35 * degree;
  plan.to = 27 * degree;
  plan.tolerance = 1 * degree;
  plan.failure_displacement = 0.01;

  State<2> state = initial_state(model);
  ReductionProgress<2> progress;
  ASSERT_TRUE(reduce<2>(model, {}, plan, state, progress).bracketed);
  ASSERT_EQ(progress.begin.size(), model.bodies.size());
  for (const Vector<2>& begin : progress.begin)
    EXPECT_EQ(begin, Vector<2>::Zero()) << "no trial moves the beginning";

  // a search that has moved the block by 0.2 m when a trial begins: the trial fails at once
  state = initial_state(model);
  progress = {};
  progress.begin.assign(model.bodies.size(), Vector<2>(0.2, 0));
  const ReductionReport report = reduce<2>(model, {}, plan, state, progress);
  EXPECT_FALSE(report.bracketed);
  EXPECT_NE(report.message.find("fails already"), std::string::npos) << report.message;
}

TEST(Reduction, AtConstantRateTheBiasIsTheOnePredicted) {
  const double slope = 30 * degree;
  Model<2> model = block_on_plate<2>(slope, 40 * degree);
  model.bodies[index_of(model, "block")].free_rotation.fill(false);  // rocking would mix in
  State<2> state = initial_state(model);
  ReducePlan plan;
  plan.method = ReductionMethod::rate;
  plan.from = 32 * degree;
  plan.to = 10 * degree;
  plan.rate = 2 * degree;
  plan.failure_displacement = 0.05;
  const ReductionReport report = reduce_from_scratch(model, plan, state);
  ASSERT_TRUE(report.bracketed) << report.message;
  const double bias = std::cbrt(6 * 0.05 * std::cos(slope) * plan.rate * plan.rate / (0.3 * gravity));
  EXPECT_NEAR(slope - report.critical, bias, bias_tolerance * bias);
}

// the lag of each rate is some degrees, what the extrapolation leaves a hundredth of that
TEST(Reduction, TwoRatesTellWhatNoRateWouldFind) {
  const double slope = 30 * degree;
  Model<2> model = block_on_plate<2>(slope, 40 * degree);
  model.bodies[index_of(model, "block")].free_rotation.fill(false);
  State<2> state = initial_state(model);
  ReducePlan plan;
  plan.method = ReductionMethod::two_rates;
  plan.from = 32 * degree;
  plan.to = 10 * degree;
  plan.rate = 2 * degree;
  plan.slower_rate = 0.5 * degree;
  plan.failure_displacement = 0.05;
  const ReductionReport report = reduce_from_scratch(model, plan, state);
  ASSERT_TRUE(report.bracketed) << report.message;
  const double bias = std::cbrt(6 * 0.05 * std::cos(slope) * plan.slower_rate * plan.slower_rate / (0.3 * gravity));
  EXPECT_NEAR(report.critical - report.failed, bias, 2 * bias_tolerance * bias);
  EXPECT_NEAR(report.critical, slope, bias_tolerance * bias);
  EXPECT_LT(std::abs(report.critical - slope), report.error_bar);
  EXPECT_NEAR(report.error_bar, 0.25 * (report.critical - report.failed), 1e-12);
}

// Steps that suffice far from the critical angle, not near it: what is known then is the answer, with the bar that is
// left.
TEST(Reduction, ATrialThatStaysUndecidedLeavesTheBracketKnownSoFar) {
  const double slope = 30 * degree;
  const Model<2> model = block_on_plate<2>(slope, 40 * degree);
  ReducePlan plan;
  plan.from = 35 * degree;
  plan.to = 20 * degree;
  plan.tolerance = 1e-4 * degree;
  plan.failure_displacement = 0.01;
  plan.step_limit = 3000;
  State<2> state = initial_state(model);
  const ReductionReport report = reduce_from_scratch(model, plan, state);
  ASSERT_TRUE(report.bracketed) << report.message;
  EXPECT_EQ(report.critical, 0.5 * (report.stable + report.failed));
  EXPECT_EQ(report.error_bar, 0.5 * (report.stable - report.failed));
  EXPECT_GT(report.error_bar, plan.tolerance);
  EXPECT_NEAR(report.critical, slope, report.error_bar);
  for (const char* part : {"neither rest nor failure at", "within 3000 steps", "unbalanced", "block) has moved by",
                           "m/s", "stable at", "failed at"})
    EXPECT_NE(report.message.find(part), std::string::npos) << part << ": " << report.message;
  EXPECT_NE(report.rule.find("neither rest nor failure"), std::string::npos) << report.rule;

  // the simulation has the value and is incomplete
  Prepared<2> scene;
  scene.model = model;
  scene.state = initial_state(model);
  scene.stages.resize(1);
  scene.stages[0].name = "critical";
  scene.stages[0].plan = plan;
  Progress<2> progress = initial_progress(scene);
  ASSERT_TRUE(simulate(scene, progress, {}));
  EXPECT_EQ(progress.results.outcome, Outcome::incomplete);
  EXPECT_NE(progress.results.message.find("neither rest nor failure"), std::string::npos) << progress.results.message;
  const Value* found = progress.results.find("critical_friction");
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, report.critical / degree, 1e-12);
  EXPECT_NEAR(*found->error_bar, report.error_bar / degree, 1e-12);
}

// A trial that relaxation cannot decide: true motion and relaxation take turns until its steps are used up.
TEST(Reduction, RelaxationAndTrueMotionTakeTurns) {
  const Model<2> model = block_on_plate<2>(30 * degree, 40 * degree);
  ReducePlan plan;
  plan.from = 35 * degree;
  plan.to = 29.9 * degree;  // slides, but not by the failure displacement within the steps
  plan.tolerance = 0.1 * degree;
  plan.failure_displacement = 1;
  plan.step_limit = 3000;
  State<2> state = initial_state(model);
  ReductionProgress<2> progress;
  std::vector<int> turns;  // steps of each turn of the second trial
  bool relaxed = false;
  RunHooks<2> hooks;
  hooks.after_step = [&](const State<2>& now, double) {
    if (progress.trial != 1) return;
    if (turns.empty() || now.relaxation.under_way != relaxed) turns.push_back(0);
    relaxed = now.relaxation.under_way;
    ++turns.back();
  };
  reduce<2>(model, {}, plan, state, progress, hooks);
  ASSERT_EQ(turns.size(), 18u) << "eight times 60 and 300 steps, then 60 and 60";
  for (std::size_t i = 0; i < turns.size(); ++i)
    EXPECT_EQ(turns[i], i % 2 == 0 || i == 17 ? 60 : 300) << "turn " << i;
  EXPECT_EQ(progress.trial_steps, plan.step_limit);
}

TEST(Reduction, WithOneSideKnownItSaysWhichOne) {
  const Model<2> model = block_on_plate<2>(30 * degree, 40 * degree);
  ReducePlan plan;
  plan.from = 35 * degree;
  plan.to = 29.9 * degree;  // slides, but not by the failure displacement within the steps
  plan.tolerance = 0.1 * degree;
  plan.failure_displacement = 1;
  plan.step_limit = 3000;
  State<2> state = initial_state(model);
  const ReductionReport report = reduce_from_scratch(model, plan, state);
  EXPECT_FALSE(report.bracketed);
  EXPECT_NE(report.message.find("stable at 35 deg, no failed angle is known"), std::string::npos) << report.message;
}

TEST(Reduction, SaysWhenTheSearchIsInTheWrongPlace) {
  Model<2> model = block_on_plate<2>(30 * degree, 40 * degree);
  ReducePlan plan;
  plan.from = 25 * degree;
  plan.to = 20 * degree;
  plan.tolerance = 0.1 * degree;
  plan.failure_displacement = 0.01;
  State<2> state = initial_state(model);
  const ReductionReport low = reduce_from_scratch(model, plan, state);
  EXPECT_FALSE(low.bracketed);
  EXPECT_NE(low.message.find("start higher"), std::string::npos) << low.message;
  plan.from = 40 * degree;
  plan.to = 35 * degree;
  state = initial_state(model);
  const ReductionReport high = reduce_from_scratch(model, plan, state);
  EXPECT_FALSE(high.bracketed);
  EXPECT_NE(high.message.find("end lower"), std::string::npos) << high.message;
}

}  // namespace
}  // namespace voussoir
