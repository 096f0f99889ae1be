// Strength reduction of a block on a slope, whose critical angle is the slope's.
#include "core/run/reduction.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/run/simulate.hpp"
#include "core/testing/models.hpp"

namespace voussoir::reduction_test {
namespace {

using shapes::block_on_plate;
using shapes::gravity;
using shapes::index_of;

// the bias formula is the leading term for an angle of 0.05 rad
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

// Displacement since the search began counts in every trial, in whichever trial it occurred.
TEST(Reduction, CountsDisplacementSinceTheSearchBegan) {
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
    EXPECT_EQ(begin, Vector<2>::Zero()) << "no trial changes the reference";

  // a search that has moved the block by 0.2 m when a trial begins: the trial fails immediately
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
  model.bodies[index_of(model, "block")].free_rotation.fill(false);  // without rocking
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

// the lag of each rate is a few degrees, the error of the extrapolation a hundredth of that
TEST(Reduction, TwoRatesExtrapolateToZeroRate) {
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

// Steps that suffice far from the critical angle, but not near it: the result is the bracket known so far.
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
  for (const char* part : {"neither equilibrium nor failure at", "within 3000 steps", "unbalanced",
                           "block) has moved by", "m/s", "stable at", "failed at"})
    EXPECT_NE(report.message.find(part), std::string::npos) << part << ": " << report.message;
  EXPECT_NE(report.rule.find("neither equilibrium nor failure"), std::string::npos) << report.rule;

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
  EXPECT_NE(progress.results.message.find("neither equilibrium nor failure"), std::string::npos)
      << progress.results.message;
  const Value* found = progress.results.find("critical_friction");
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, report.critical / degree, 1e-12);
  EXPECT_NEAR(*found->error_bar, report.error_bar / degree, 1e-12);
}

// One undecided level only: the bracket closes around it from both sides.
TEST(Reduction, ALevelThatNoTrialDecidesIsAvoided) {
  const double slope = 30 * degree;
  const Model<2> model = block_on_plate<2>(slope, 40 * degree);
  ReducePlan plan;
  plan.from = 35 * degree;
  plan.to = 27 * degree;
  plan.tolerance = 0.1 * degree;
  plan.failure_displacement = 0.01;
  for (const double level : {30.5, 29.7}) {  // it would be stable, it would fail
    State<2> state = initial_state(model);
    ReductionProgress<2> progress;
    progress.trial = 2;
    progress.stable = plan.from;
    progress.failed = plan.to;
    progress.begin.assign(model.bodies.size(), Vector<2>::Zero());
    progress.base = state;
    progress.avoids = true;
    progress.undecided = level * degree;
    std::vector<double> tried;
    const ReductionReport report =
        reduce<2>(model, {}, plan, state, progress, {},
                  [&](const State<2>&, double at, SearchTrial) { tried.push_back(at / degree); });
    ASSERT_TRUE(report.bracketed) << report.message;
    EXPECT_TRUE(report.message.empty()) << report.message;
    EXPECT_NEAR(tried.front(), level == 30.5 ? 32.75 : 32.35, 1e-9) << "half way to the farther end";
    for (const double at : tried)
      EXPECT_GT(std::abs(at - level), 1e-6);
    EXPECT_NEAR(report.critical, slope, report.error_bar);
    EXPECT_LE(report.error_bar, 0.5 * plan.tolerance * (1 + 1e-9));
  }
}

// A trial that relaxation cannot decide: true motion and relaxation alternate until its steps are used up.
TEST(Reduction, RelaxationAndTrueMotionAlternate) {
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

TEST(Reduction, WithOneSideKnownItReportsThatOne) {
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

// ---- factor of safety ----------------------------------------------------------------------------------------------

ReducePlan factor_plan(ReductionMethod method, double from, double to) {
  ReducePlan plan;
  plan.method = method;
  plan.searched = Searched::factor;
  plan.factor = {.from = from, .to = to, .tolerance = 0.002, .step = 0.02};
  plan.failure_displacement = 0.01;
  return plan;
}

// on a plane it is the ratio of the tangents, for any start of the search
TEST(FactorOfSafety, OfABlockOnASlopeIsTheRatioOfTheTangents) {
  const Model<2> model = block_on_plate<2>(30 * degree, 40 * degree);
  const double exact = std::tan(40 * degree) / std::tan(30 * degree);
  for (const ReductionMethod method : {ReductionMethod::bisection, ReductionMethod::steps})
    for (const double from : {0.6, 1.3}) {
      State<2> state = initial_state(model);
      const ReductionReport report = reduce_from_scratch(model, factor_plan(method, from, 1.6), state);
      ASSERT_TRUE(report.bracketed) << report.message;
      EXPECT_LT(report.stable, report.failed);
      EXPECT_NEAR(report.critical, exact, report.error_bar + 1e-4);
      EXPECT_LE(report.error_bar, method == ReductionMethod::steps ? 0.01 * (1 + 1e-9) : 0.001);
      EXPECT_EQ(state.schedule.strength_factor, std::vector<double>{report.stable}) << "stays in force";
      EXPECT_EQ(state.schedule.friction.front(), std::atan(std::tan(40 * degree) / report.stable));
    }
}

// A bonded joint supports (c A + tan φ N)/F. Too weak for its own slope, it is only stable at the start of the search.
TEST(FactorOfSafety, DividesTheCohesionOfABondToo) {
  const double slope = 30 * degree, weight = shapes::density * 0.5 * gravity;
  Model<2> model = block_on_plate<2>(slope, 15 * degree);
  model.bodies[index_of(model, "block")].free_rotation.fill(false);
  model.properties.front().laws.bond = true;
  model.properties.front().cohesion = 0.3 * weight;  // Pa, over 1 m²
  const double exact = (0.3 * weight + weight * std::cos(slope) * std::tan(15 * degree)) / (weight * std::sin(slope));
  ASSERT_NEAR(exact, 1.064, 1e-3);
  for (const double part : {1.0, 0.7}) {  // of the strength that this case states
    model.properties.front().cohesion = 0.3 * weight * part;
    model.properties.front().friction = std::atan(std::tan(15 * degree) * part);
    Prepared<2> scene;
    scene.model = model;
    scene.state = initial_state(model);
    scene.stages.resize(1);
    scene.stages[0].name = "factor";
    scene.stages[0].plan = factor_plan(ReductionMethod::bisection, 0.4, 2);
    scene.stages[0].change.bond = true;
    Progress<2> progress = initial_progress(scene);
    ASSERT_TRUE(simulate(scene, progress, {}));
    EXPECT_EQ(progress.results.outcome, Outcome::done) << progress.results.message;
    const Value* found = progress.results.find("factor_of_safety");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->unit, "1");
    EXPECT_NEAR(found->value, part * exact, *found->error_bar + 1e-3);
    EXPECT_EQ(progress.results.history.columns,
              (std::vector<std::string>{"time_s", "stage", "trial", "friction_joint_deg", "strength_factor"}));
    EXPECT_NEAR(progress.results.history.rows.back()[4], found->value, *found->error_bar + 1e-12);
  }
}

TEST(FactorOfSafety, ReportsASearchInTheWrongRange) {
  const Model<2> model = block_on_plate<2>(30 * degree, 40 * degree);
  const auto message = [&](const ReducePlan& plan) {
    State<2> state = initial_state(model);
    const ReductionReport report = reduce_from_scratch(model, plan, state);
    EXPECT_FALSE(report.bracketed);
    return report.message;
  };
  const std::string late = message(factor_plan(ReductionMethod::bisection, 1.5, 2)),
                    early = message(factor_plan(ReductionMethod::bisection, 0.5, 1.2)),
                    rate = message(factor_plan(ReductionMethod::rate, 0.5, 1.2));
  EXPECT_NE(late.find("fails already at from_factor = 1.5: start lower"), std::string::npos) << late;
  EXPECT_NE(early.find("still stable at to_factor = 1.2: end higher"), std::string::npos) << early;
  EXPECT_NE(rate.find("by bisection or in steps"), std::string::npos) << rate;
}

// ---- a loose block --------------------------------------------------------------------------------------------------

// A block on a slope of 20 degrees, and a loose one of 4 % of the free mass on a slope of 40, which slides down and
// falls: with a fraction of the mass it prevents neither the search nor the equilibrium of a trial.
TEST(Reduction, ALooseBlockDoesNotEndASearchByFraction) {
  const Matrix<2> steep = matrix(Rotation<2>{40 * degree}), gentle = matrix(Rotation<2>{20 * degree});
  const auto turned_box = [](const Vector<2>& low, const Vector<2>& high, const Matrix<2>& turn, double x) {
    return shapes::placed<2>(shapes::box<2>(low, high), turn, Vector<2>(x, 0));
  };
  const Model<2> model =
      shapes::model_of<2>({shapes::body_of<2>(turned_box({-3, -3}, {3, 0}, gentle, 0), true, "plate"),
                           shapes::body_of<2>(turned_box({-0.5, 0}, {0.5, 0.5}, gentle, 0), false, "block"),
                           shapes::body_of<2>(turned_box({-0.3, -0.3}, {0.3, 0}, steep, 20), true, "ledge"),
                           shapes::body_of<2>(turned_box({-0.1, 0}, {0.1, 0.1}, steep, 20), false, "stone")},
                          50 * degree);
  ReducePlan plan;
  plan.from = 45 * degree;
  plan.to = 15 * degree;
  plan.tolerance = 1 * degree;
  plan.failure_displacement = 0.01;
  for (const Statics statics : {Statics::adaptive, Statics::local, Statics::newton}) {
    Settings settings;
    settings.statics.method = statics;
    for (const auto& [fraction, critical] : {std::pair(0.0, 40.0), {0.03, 40.0}, {0.1, 20.0}, {1.0, 20.0}}) {
      plan.failure_fraction = fraction;
      State<2> state = initial_state(model);
      ReductionProgress<2> progress;
      const ReductionReport report = reduce<2>(model, settings, plan, state, progress);
      ASSERT_TRUE(report.bracketed && report.message.empty()) << fraction << ": " << report.message;
      EXPECT_NEAR(report.critical / degree, critical, report.error_bar / degree + 0.01) << fraction;
      EXPECT_EQ(report.rule.find("of the free mass") != std::string::npos, fraction > 0) << report.rule;
      EXPECT_EQ(report.rule.find("is not in the error bar") != std::string::npos, statics == Statics::newton);
    }
  }
}

TEST(Reduction, ReportsASearchInTheWrongRange) {
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
}  // namespace voussoir::reduction_test
