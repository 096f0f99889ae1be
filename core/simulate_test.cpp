// Whole scenes in memory: what their histories and results say.
#include "core/simulate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/motion/free_fall.hpp"
#include "core/testing/models.hpp"

namespace voussoir {
namespace {

using shapes::block_on_plate;
using shapes::degree;

StagePlan stage_of(const std::string& name, std::variant<SettlePlan, RunPlan, ReducePlan> plan) {
  StagePlan stage;
  stage.name = name;
  stage.plan = std::move(plan);
  return stage;
}

// a block on a plate that dips by 30 degrees, on a joint "joint"; a second property, "other", comes first
Prepared<2> block_on_slope(const std::vector<StagePlan>& stages) {
  Prepared<2> scene;
  scene.model = block_on_plate<2>(30 * degree, 40 * degree);
  JointProperties other = scene.model.properties.front();
  other.name = "other";
  scene.model.properties.insert(scene.model.properties.begin(), other);
  for (Joint<2>& joint : scene.model.joints)
    joint.properties = 1;
  scene.model.default_properties = 1;
  scene.state = initial_state(scene.model);
  scene.stages = stages;
  return scene;
}

ReducePlan reduction_to(double to, ReductionMethod method = ReductionMethod::bisection) {
  ReducePlan plan;
  plan.method = method;
  plan.properties = {"joint"};
  plan.from = 35 * degree;
  plan.to = to;
  plan.tolerance = 0.5 * degree;
  plan.step = 1 * degree;
  plan.rate = 4 * degree;
  plan.slower_rate = 2 * degree;
  plan.failure_displacement = 0.01;
  return plan;
}

template <int Dim>
Results results_of(const Prepared<Dim>& scene, const Watcher<Dim>& watcher = {}) {
  Progress<Dim> progress = begin(scene);
  EXPECT_TRUE(simulate(scene, progress, watcher));
  return progress.results;
}

std::vector<double> column_of(const History& history, const std::string& name) {
  const auto found = std::find(history.columns.begin(), history.columns.end(), name);
  EXPECT_NE(found, history.columns.end()) << name;
  std::vector<double> column;
  if (found == history.columns.end()) return column;
  for (const std::vector<double>& row : history.rows)
    column.push_back(row[found - history.columns.begin()]);
  return column;
}

TEST(Simulate, TheHistoryShowsEveryFrictionThatChangesAndNoOther) {
  const auto settled = stage_of("settle", SettlePlan{});
  const Results results = results_of(block_on_slope({settled, stage_of("reduce", reduction_to(27 * degree))}));
  EXPECT_EQ(results.history.columns, (std::vector<std::string>{"time_s", "stage", "trial", "friction_joint_deg"}));
  const std::vector<double> friction = column_of(results.history, "friction_joint_deg");
  ASSERT_FALSE(friction.empty());
  EXPECT_NEAR(friction.front(), 40, 1e-9);
  EXPECT_NEAR(friction.back(), 30, 0.5) << "the reduced one, at the last stable angle";

  // a stage that states an angle gives it to every joint
  StagePlan slide = stage_of("slide", RunPlan{.duration = 0.01});
  slide.change.friction = 20 * degree;
  const Results slid = results_of(block_on_slope({settled, slide}));
  EXPECT_NEAR(column_of(slid.history, "friction_joint_deg").back(), 20, 1e-9);
  EXPECT_NEAR(column_of(slid.history, "friction_other_deg").back(), 20, 1e-9);

  EXPECT_EQ(results_of(block_on_slope({settled})).history.columns, (std::vector<std::string>{"time_s", "stage"}));
}

TEST(Simulate, AStageIsMarkedRelaxedWhereItEndsByRelaxation) {
  const auto relaxed = [](const std::variant<SettlePlan, RunPlan, ReducePlan>& plan, Statics statics) {
    Prepared<2> scene = block_on_slope({stage_of("only", plan)});
    scene.settings.damping.statics = statics;
    return results_of(scene).stages.at(0).relaxed;
  };
  EXPECT_TRUE(relaxed(SettlePlan{}, Statics::adaptive));
  EXPECT_FALSE(relaxed(SettlePlan{}, Statics::local));
  EXPECT_FALSE(relaxed(RunPlan{.duration = 0.01}, Statics::adaptive));
  EXPECT_TRUE(relaxed(reduction_to(27 * degree), Statics::adaptive));
  EXPECT_TRUE(relaxed(reduction_to(27 * degree, ReductionMethod::steps), Statics::adaptive));
  // a fall at constant rate is true motion, though the search begins at rest
  EXPECT_FALSE(relaxed(reduction_to(10 * degree, ReductionMethod::rate), Statics::adaptive));
  EXPECT_FALSE(relaxed(reduction_to(10 * degree, ReductionMethod::two_rates), Statics::adaptive));
}

// What was taken back stands beside the path: whatever is left when it is put aside ends on the answer.
TEST(Simulate, TimeNeverGoesBackOnThePathToTheAnswer) {
  for (const ReductionMethod method :
       {ReductionMethod::bisection, ReductionMethod::steps, ReductionMethod::two_rates}) {
    const double to = method == ReductionMethod::two_rates ? 10 : 27;
    const Prepared<2> scene =
        block_on_slope({stage_of("settle", SettlePlan{}), stage_of("reduce", reduction_to(to * degree, method)),
                        stage_of("after", SettlePlan{.step_limit = 100})});
    std::vector<double> frames;
    std::vector<int> trials;
    Watcher<2> watcher;
    watcher.frame = [&](const Model<2>&, const State<2>&, double time) { frames.push_back(time); };
    watcher.trial_frame = [&](const Model<2>&, const State<2>&, int trial) { trials.push_back(trial); };
    const Results results = results_of(scene, watcher);

    const std::vector<double> time = column_of(results.history, "time_s"), trial = column_of(results.history, "trial");
    std::vector<double> path;
    std::vector<int> detours;
    for (std::size_t i = 0; i < time.size(); ++i)
      trial[i] == 0 ? path.push_back(time[i]) : detours.push_back(static_cast<int>(trial[i]));
    EXPECT_TRUE(std::is_sorted(path.begin(), path.end()));
    EXPECT_EQ(trial.back(), 0) << "the history ends on the path";
    EXPECT_FALSE(detours.empty());
    EXPECT_TRUE(std::is_sorted(detours.begin(), detours.end()));
    EXPECT_EQ(detours, trials) << "each has its row and its frame";
    EXPECT_GE(frames.size(), 2u);
    EXPECT_TRUE(std::is_sorted(frames.begin(), frames.end()));
  }
}

// The state that a search leaves is the last stable one, whichever trial came last: a wedge that fell out of its roof
// has no contact left to measure by.
TEST(Simulate, TheMeasureOfEquilibriumIsThatOfTheStateLeft) {
  ReducePlan plan = reduction_to(10 * degree);
  plan.failure_displacement = 6;  // beyond the edge of the plate
  plan.tolerance = 40 * degree;   // so that the last trial is the one that fails
  Prepared<2> scene = block_on_slope({stage_of("reduce", plan), stage_of("slide", RunPlan{.duration = 1e-3}),
                                      stage_of("fall", reduction_to(10 * degree, ReductionMethod::rate))});
  const Results results = results_of(scene);
  ASSERT_EQ(results.stages.size(), 3u);
  EXPECT_GE(results.stages[0].unbalanced, 0);
  EXPECT_LE(results.stages[0].unbalanced, scene.settings.equilibrium.unbalanced);
  EXPECT_EQ(results.stages[1].unbalanced, -1);
  EXPECT_EQ(results.stages[2].unbalanced, -1);
}

// ---- what ends a run early, and what is kept then -------------------------------------------------------------------

TEST(Simulate, AStageWithoutAFreeBlockEndsTheRunAndKeepsWhatWasDone) {
  StagePlan excavate = stage_of("excavate", SettlePlan{});
  excavate.change.remove.push_back({.names = {"block"}, .above = {}, .below = {}, .inside = {}});
  const Results results =
      results_of(block_on_slope({stage_of("settle", SettlePlan{}), stage_of("reduce", reduction_to(27 * degree)),
                                 excavate, stage_of("after", SettlePlan{})}));
  EXPECT_EQ(results.outcome, Outcome::incomplete);
  EXPECT_TRUE(results.message.starts_with("stage excavate: no block is free to move")) << results.message;
  ASSERT_EQ(results.stages.size(), 3u);
  EXPECT_EQ(results.stages[0].ended, "equilibrium");
  EXPECT_EQ(results.stages[2].steps, 0);
  ASSERT_NE(results.find("critical_friction"), nullptr);
  EXPECT_NEAR(results.find("critical_friction")->value, 30, 0.5);
}

TEST(Simulate, AStageThatCannotBeDoneEndsTheRunInASentence) {
  // a block alone, of no joint, and no time step stated
  Prepared<2> scene;
  scene.model = shapes::model_of<2>({shapes::body_of<2>(shapes::box<2>({0, 0}, {1, 1}))});
  scene.model.properties.clear();
  scene.state = initial_state(scene.model);
  scene.stages = {stage_of("wait", RunPlan{.duration = 1}), stage_of("after", SettlePlan{})};
  const Results results = results_of(scene);
  EXPECT_EQ(results.outcome, Outcome::failed);
  EXPECT_TRUE(results.message.starts_with("stage wait: no contact and no joint property determines the time step"))
      << results.message;
  EXPECT_EQ(results.stages.size(), 1u);
  EXPECT_FALSE(results.history.rows.empty());
}

TEST(Simulate, WithoutRestTheBlockThatMovesMostIsNamed) {
  Prepared<2> scene = block_on_slope({stage_of("settle", SettlePlan{.step_limit = 300})});
  for (double& friction : scene.state.schedule.friction)
    friction = 20 * degree;
  const Results results = results_of(scene);
  EXPECT_EQ(results.outcome, Outcome::incomplete);
  EXPECT_NE(results.message.find("(block) moves most"), std::string::npos) << results.message;
}

// A block that slides off its plate ends a stage that waits for rest, and no stage that lasts for a time.
TEST(Simulate, ABlockThatFallsFreeEndsTheWaitForRest) {
  for (const Statics statics : {Statics::adaptive, Statics::local}) {
    Prepared<2> scene = block_on_slope({stage_of("settle", SettlePlan{})});
    scene.settings.damping.statics = statics;
    for (double& friction : scene.state.schedule.friction)
      friction = 5 * degree;
    const Results results = results_of(scene);
    EXPECT_EQ(results.outcome, Outcome::incomplete);
    EXPECT_EQ(results.stages.at(0).ended, "a body falls free");
    EXPECT_NE(results.message.find("(block) has left all others behind"), std::string::npos) << results.message;
    EXPECT_LT(results.stages.at(0).steps, 200'000);
  }
  Prepared<2> timed = block_on_slope({stage_of("fall", RunPlan{.duration = 5})});
  timed.settings.damping.local = 0;
  for (double& friction : timed.state.schedule.friction)
    friction = 5 * degree;
  const Results results = results_of(timed);
  EXPECT_EQ(results.outcome, Outcome::done);
  ASSERT_EQ(results.warnings.size(), 1u);
  EXPECT_NE(results.warnings[0].find("(block) falls free"), std::string::npos) << results.warnings[0];
}

TEST(FreeFall, IsNotSeenWhereSomethingMayCatchTheBlock) {
  Model<2> model = block_on_plate<2>(0, 40 * degree);
  const int block = shapes::index_of(model, "block"), plate = shapes::index_of(model, "plate");
  State<2> state = initial_state(model);
  state.motions[block].displacement = {0, -50};
  EXPECT_EQ(falling_free(model, state), block);
  EXPECT_EQ(fastest(model, state), -1);
  state.motions[block].velocity = {0, 1};
  EXPECT_EQ(falling_free(model, state), -1) << "it comes back";
  EXPECT_EQ(fastest(model, state), block);
  state.motions[block].velocity.setZero();
  model.bodies[plate].reference[1] -= 100;
  EXPECT_EQ(falling_free(model, state), -1) << "the plate lies below";
  model.bodies[plate].reference[1] += 100;
  state.motions[block].displacement = {0, -5};
  EXPECT_EQ(falling_free(model, state), -1) << "less far than the model is wide";
  state.motions[block].displacement = {0, -50};
  state.schedule.gravity_factor = 0;
  EXPECT_EQ(falling_free(model, state), -1) << "nothing pulls";
}

}  // namespace
}  // namespace voussoir
