// Complete scenes in memory: their histories and results.
#include "core/run/simulate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/output/paraview.hpp"
#include "core/run/snapshot.hpp"
#include "core/step/free_fall.hpp"
#include "core/testing/models.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::simulate_test {
namespace {

using shapes::block_on_plate;

StagePlan stage_of(const std::string& name, std::variant<SettlePlan, RunPlan, ReducePlan> plan) {
  StagePlan stage;
  stage.name = name;
  stage.plan = std::move(plan);
  return stage;
}

// a block on a plate that dips by 30 degrees, on a joint "joint"; another property, "other", comes first
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
  return simulated(scene, watcher).results;
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

TEST(Simulate, AStageGivesFrictionByNameOrToEveryJoint) {
  StagePlan slide = stage_of("slide", RunPlan{.duration = 0.01});
  slide.change.friction_of = {{"other", 25 * degree}};
  const Results one = results_of(block_on_slope({slide}));
  EXPECT_EQ(one.history.columns, (std::vector<std::string>{"time_s", "stage", "friction_other_deg"}));
  EXPECT_NEAR(one.history.rows.front()[2], 25, 1e-9);

  slide.change.friction = 35 * degree;  // the others
  const Results both = results_of(block_on_slope({slide}));
  EXPECT_NEAR(column_of(both.history, "friction_other_deg").back(), 25, 1e-9);
  EXPECT_NEAR(column_of(both.history, "friction_joint_deg").back(), 35, 1e-9);

  // a stage's statement ends the factor that a search left, only for that property
  StagePlan factor = stage_of("factor", ReducePlan{.searched = Searched::factor,
                                                   .factor = {.from = 0.8, .to = 2, .tolerance = 0.1},
                                                   .properties = {},
                                                   .failure_displacement = 0.01});
  slide.change.friction.reset();
  const Results after = results_of(block_on_slope({factor, slide}));
  EXPECT_NEAR(column_of(after.history, "friction_other_deg").back(), 25, 1e-9);
  EXPECT_NEAR(column_of(after.history, "friction_joint_deg").back(), 30, 2);
  EXPECT_NEAR(column_of(after.history, "strength_factor").back(), after.find("factor_of_safety")->value,
              *after.find("factor_of_safety")->error_bar + 1e-12);
}

// A joint that has softened by slip has its initial friction again after the slip is set to zero.
TEST(Simulate, PlasticSlipIsSetToZeroOnRequest) {
  for (const int sub_contacts : {1, 2}) {
    StagePlan slide = stage_of("slide", RunPlan{.duration = 0.3}),
              stand = stage_of("stand", SettlePlan{.step_limit = 20'000});
    slide.change.friction = 20 * degree;
    stand.change.friction = 35 * degree;
    const auto last_state = [&](bool zero) {
      // settled and held upright, the block keeps its contact, and with it its slip, throughout
      Prepared<2> scene = block_on_slope({stage_of("settle", SettlePlan{}), slide, stand});
      scene.model.bodies[shapes::index_of(scene.model, "block")].free_rotation.fill(false);
      for (JointProperties& p : scene.model.properties) {
        p.laws.friction = FrictionLaw::softening;
        p.softening_drop = 0.2;
        p.softening_slip = 0.01;
        p.sub_contacts = sub_contacts;
      }
      scene.stages[2].change.zero_slip = zero;
      Progress<2> progress = initial_progress(scene);
      EXPECT_TRUE(simulate(scene, progress, {}));
      return progress;
    };
    const Progress<2> kept = last_state(false), zeroed = last_state(true);
    EXPECT_EQ(kept.results.outcome, Outcome::incomplete) << "tan 35 deg less 0.2 does not hold a slope of 30 deg";
    EXPECT_EQ(zeroed.results.outcome, Outcome::done) << zeroed.results.message;
  }
}

TEST(Simulate, AStageIsMarkedRelaxedIfItEndsByRelaxation) {
  const auto relaxed = [](const std::variant<SettlePlan, RunPlan, ReducePlan>& plan, Statics statics) {
    Prepared<2> scene = block_on_slope({stage_of("only", plan)});
    scene.settings.statics.method = statics;
    return results_of(scene).stages.at(0).relaxed;
  };
  EXPECT_TRUE(relaxed(SettlePlan{}, Statics::adaptive));
  EXPECT_FALSE(relaxed(SettlePlan{}, Statics::local));
  EXPECT_FALSE(relaxed(RunPlan{.duration = 0.01}, Statics::adaptive));
  EXPECT_TRUE(relaxed(reduction_to(27 * degree), Statics::adaptive));
  EXPECT_TRUE(relaxed(reduction_to(27 * degree, ReductionMethod::steps), Statics::adaptive));
  // a reduction at constant rate is true motion, though the search begins in equilibrium
  EXPECT_FALSE(relaxed(reduction_to(10 * degree, ReductionMethod::rate), Statics::adaptive));
  EXPECT_FALSE(relaxed(reduction_to(10 * degree, ReductionMethod::two_rates), Statics::adaptive));
}

// Undone trials are separate from the path: the rows without them end at the result.
TEST(Simulate, TimeNeverGoesBackOnThePathToTheResult) {
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

// The final state of a search is the last stable one, whichever trial came last: a wedge that fell out of its roof has
// no contact force left as a reference.
TEST(Simulate, TheMeasureOfEquilibriumIsThatOfTheFinalState) {
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

// ---- bonds made in the first stage, before any block has moved ------------------------------------------------------

// the block's weight over its base of 1 x 1 m
constexpr double weight = shapes::density * 0.5 * shapes::gravity;

Prepared<2> bonded_block(double slope, double tension, double cohesion, const std::vector<StagePlan>& stages,
                         Statics statics = Settings{}.statics.method) {
  Prepared<2> scene;
  scene.settings.statics.method = statics;
  scene.model = block_on_plate<2>(slope, 30 * degree);
  // a block that leans on its lower edge is bonded only there
  scene.model.bodies[shapes::index_of(scene.model, "block")].free_rotation.fill(false);
  JointProperties& joint = scene.model.properties.front();
  joint.tension = tension;
  joint.cohesion = cohesion;
  joint.laws.bond = tension > 0 || cohesion > 0;
  scene.state = initial_state(scene.model);
  scene.stages = stages;
  scene.stages.front().change.bond = true;
  return scene;
}

// Under its weight, then lifted by a multiple of it: a bond holds while the uplift is below its strength. It has
// cohesion, too: without it, a small shear would break it as soon as it is in tension.
TEST(Bonds, OfTheFirstStageHoldABlockInTension) {
  for (const Statics statics : {Statics::adaptive, Statics::newton})
    for (const double fraction : {0.995, 1.005}) {
      const GravityPlan lift{.ramp = 1, .from = 1, .to = -fraction};
      const Results results = results_of(bonded_block(
          0, weight, weight,
          {stage_of("settle", SettlePlan{.gravity = {.ramp = 0.5}}), stage_of("lift", SettlePlan{.gravity = lift})},
          statics));
      ASSERT_EQ(results.stages.size(), 2u) << results.message;
      EXPECT_EQ(results.stages[0].ended, "equilibrium");
      EXPECT_EQ(results.stages[1].ended, fraction < 1 ? "equilibrium" : "a body falls freely") << results.message;
      ASSERT_TRUE(results.bonds.has_value());
      EXPECT_EQ(results.bonds->made, 1);
      EXPECT_EQ(results.bonds->whole, fraction < 1 ? 1 : 0);
      EXPECT_EQ(results.bonds->broken, fraction < 1 ? 0 : 1);
      if (statics != Statics::newton) continue;
      EXPECT_GT(results.counters.static_iterations, 0);
      EXPECT_EQ(results.counters.static_fallbacks, fraction < 1 ? 0 : 1) << "breaking bonds are left to relaxation";
      EXPECT_EQ(results.counters.broken_bonds_fallbacks, results.counters.static_fallbacks);
    }
}

// c A + W cos a tan f against W sin a
TEST(Bonds, OfTheFirstStageHoldABlockBeyondItsFrictionAngle) {
  const double friction = std::tan(30 * degree);
  for (const Statics statics : {Statics::adaptive, Statics::newton})
    for (const double slope : {40 * degree, 50 * degree}) {
      const double needed = weight * (std::sin(slope) - std::cos(slope) * friction);
      for (const double fraction : {0.98, 1.02}) {
        const Results results = results_of(bonded_block(
            slope, 0, fraction * needed, {stage_of("settle", SettlePlan{.gravity = {.ramp = 1}})}, statics));
        EXPECT_EQ(results.stages.at(0).ended, fraction > 1 ? "equilibrium" : "a body falls freely") << results.message;
        EXPECT_EQ(results.bonds->made, 1);
        EXPECT_EQ(results.bonds->whole, fraction > 1 ? 1 : 0);
      }
    }
  // the slope at which a cohesion of half the block's weight is just sufficient, by 0.5 = sin a - cos a tan f
  const double critical = 30 * degree + std::asin(0.5 * std::cos(30 * degree));
  for (const double away : {-0.3 * degree, 0.3 * degree}) {
    const Results results = results_of(
        bonded_block(critical + away, 0, 0.5 * weight, {stage_of("settle", SettlePlan{.gravity = {.ramp = 1}})}));
    EXPECT_EQ(results.stages.at(0).ended, away < 0 ? "equilibrium" : "a body falls freely") << results.message;
  }
}

// Bonds that are due when a run is interrupted are due when it continues; neither threads nor the candidates' skin have
// an effect.
TEST(Bonds, ThatAreDueSurviveAnInterruption) {
  for (const int along : {1, 2}) {
    Prepared<3> scene;
    scene.model = shapes::model_of<3>(shapes::jointed_box({-0.3, 0.4}));
    JointProperties& joint = scene.model.properties.front();
    joint.tension = 2e4;
    joint.cohesion = 5e4;
    joint.laws.bond = true;
    joint.sub_contacts = along;
    scene.state = initial_state(scene.model);
    scene.stages = {stage_of("load", RunPlan{.duration = 6e-3, .gravity = {.ramp = 4e-3}})};
    scene.stages.front().change.bond = true;
    scene.settings.time.step = 5e-5;
    const Results whole = results_of(scene);
    ASSERT_GT(whole.bonds->made, 0);
    ASSERT_GT(whole.bonds->due, 0) << "else nothing is due at the end";
    for (const long long stop : {0, 1, 5, 17, 60, 110}) {
      const Progress<3> second = continued(scene, stop);
      EXPECT_EQ(second.results.state_hash, whole.state_hash) << stop;
      EXPECT_EQ(second.results.bonds->made, whole.bonds->made) << stop;
    }
    scene.settings.threads = 3;
    for (const double skin : {0.01, 0.5}) {
      scene.settings.contact.skin = skin;
      EXPECT_EQ(results_of(scene).state_hash, whole.state_hash) << skin;
    }
  }
}

TEST(Bonds, AreNotReportedIfNoStageMakesAny) {
  EXPECT_FALSE(results_of(block_on_slope({stage_of("settle", SettlePlan{})})).bonds.has_value());
  const Results none = results_of(bonded_block(0, 0, 0, {stage_of("settle", SettlePlan{})}));
  ASSERT_EQ(none.warnings.size(), 1u);
  EXPECT_NE(none.warnings[0].find("no bond"), std::string::npos);
}

// ---- between steps ----------------------------------------------------------------------------------------------

std::string drawn(const Model<2>& model, const State<2>& state) {
  return vtp(contact_points(model, state, state.schedule.time)) + vtp(force_lines(model, state, state.schedule.time));
}

TEST(Snapshot, EqualsTheFramesWithinStagesAndAtTheirEnds) {
  StagePlan slide = stage_of("slide", RunPlan{.duration = 0.05});
  slide.change.friction = 20 * degree;
  StagePlan lost = stage_of("lost", SettlePlan{});
  lost.change.remove.push_back({.names = {"block"}, .above = {}, .below = {}, .inside = {}});
  Prepared<2> scene = block_on_slope({stage_of("settle", SettlePlan{}), slide});
  scene.output.frame_interval = 0.01;
  for (const bool fails : {false, true}) {
    if (fails) scene.stages.push_back(lost);
    Progress<2> progress = initial_progress(scene);
    std::string before, frame;
    int compared = 0;
    Watcher<2> watcher;
    watcher.pause = [&](const Progress<2>& now) {
      const Snapshot<2> shown = snapshot(scene, now);
      before = drawn(shown.model, shown.state);
      return false;
    };
    watcher.frame = [&](const Model<2>& model, const State<2>& state, double time) {
      frame = drawn(model, state);
      const bool within = progress.stage_under_way && time < progress.stage_began + 0.045;
      if (!within || progress.stage != 1) return;
      EXPECT_EQ(frame, before);
      ++compared;
    };
    EXPECT_TRUE(simulate(scene, progress, watcher));
    EXPECT_EQ(progress.results.outcome, fails ? Outcome::incomplete : Outcome::done);
    EXPECT_GE(compared, 4);
    const Snapshot<2> end = snapshot(scene, progress);
    EXPECT_EQ(drawn(end.model, end.state), frame);
    EXPECT_EQ(end.state.contacts.list.empty() || !end.state.contacts.list.front().touching(), fails);
  }
}

// ---- early ends of a run, and the results kept -------------------------------------------------------------------

TEST(Simulate, AStageWithoutAFreeBlockEndsTheRunAndKeepsEarlierResults) {
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

TEST(Simulate, AStageThatCannotBeExecutedEndsTheRunWithAMessage) {
  // a single block without joints, and no stated time step
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

TEST(Simulate, WithoutEquilibriumTheBlockThatMovesMostIsNamed) {
  Prepared<2> scene = block_on_slope({stage_of("settle", SettlePlan{.step_limit = 300})});
  for (double& friction : scene.state.schedule.friction)
    friction = 20 * degree;
  const Results results = results_of(scene);
  EXPECT_EQ(results.outcome, Outcome::incomplete);
  EXPECT_NE(results.message.find("(block) moves most"), std::string::npos) << results.message;
}

// A block that slides off its plate ends a stage that seeks equilibrium, but not a stage of given duration.
TEST(Simulate, AFreelyFallingBlockEndsTheSearchForEquilibrium) {
  for (const Statics statics : {Statics::adaptive, Statics::local}) {
    Prepared<2> scene = block_on_slope({stage_of("settle", SettlePlan{})});
    scene.settings.statics.method = statics;
    for (double& friction : scene.state.schedule.friction)
      friction = 5 * degree;
    const Results results = results_of(scene);
    EXPECT_EQ(results.outcome, Outcome::incomplete);
    EXPECT_EQ(results.stages.at(0).ended, "a body falls freely");
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
  EXPECT_NE(results.warnings[0].find("(block) falls freely"), std::string::npos) << results.warnings[0];
}

TEST(FreeFall, IsNotReportedIfSomethingMayCatchTheBlock) {
  Model<2> model = block_on_plate<2>(0, 40 * degree);
  const int block = shapes::index_of(model, "block"), plate = shapes::index_of(model, "plate");
  State<2> state = initial_state(model);
  state.bodies.motions[block].displacement = {0, -50};
  EXPECT_EQ(falling_free(model, state), block);
  EXPECT_EQ(fastest(model, state), -1);
  state.bodies.motions[block].velocity = {0, 1};
  EXPECT_EQ(falling_free(model, state), -1) << "it comes back";
  EXPECT_EQ(fastest(model, state), block);
  state.bodies.motions[block].velocity.setZero();
  model.bodies[plate].reference[1] -= 100;
  EXPECT_EQ(falling_free(model, state), -1) << "the plate is below";
  model.bodies[plate].reference[1] += 100;
  state.bodies.motions[block].displacement = {0, -5};
  EXPECT_EQ(falling_free(model, state), -1) << "less than the width of the model";
  state.bodies.motions[block].displacement = {0, -50};
  state.schedule.gravity_factor = 0;
  EXPECT_EQ(falling_free(model, state), -1) << "no load acts";
}

}  // namespace
}  // namespace voussoir::simulate_test
