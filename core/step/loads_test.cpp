// Applied forces: point of action, duration, and effect on a block in 3-D and on its time step.
#include "core/step/loads.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/load/time_factor.hpp"
#include "core/step/integrate.hpp"
#include "core/step/time_step.hpp"
#include "core/testing/end_bytes.hpp"
#include "core/testing/models.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::loads_test {
namespace {

using shapes::block_on_plate;
using shapes::body_of;
using shapes::box;
using shapes::cube;
using shapes::index_of;
using shapes::model_of;
using std::numbers::pi;

constexpr double rounding = 1e-12;

template <int Dim>
std::vector<double> numbers(const Vector<Dim>& v) {
  return {v.begin(), v.end()};
}

template <int Dim>
ForcePlan force_on(const std::string& body, const Vector<Dim>& force, std::vector<double> point = {}) {
  ForcePlan plan;
  plan.name = "push";
  plan.bodies.names = {body};
  plan.force = numbers<Dim>(force);
  plan.point = std::move(point);
  return plan;
}

Change with(std::vector<ForcePlan> forces) {
  Change change;
  change.force = std::move(forces);
  return change;
}

// one block, free of everything else; no joint properties, so that nothing else sets the time step
template <int Dim>
Model<Dim> in_space(const HalfSpaces<Dim>& planes) {
  Model<Dim> model = model_of<Dim>({body_of<Dim>(planes, false, "block")});
  model.gravity.setZero();
  model.properties.clear();
  model.joints.clear();
  return model;
}

template <int Dim>
Load<Dim> applied_to(int body, const Model<Dim>& model, const State<Dim>& state) {
  State<Dim> now = state;
  cache_poses(model, 1, now.bodies);
  list_by_body(model, now.contacts);
  sum_loads(model, Settings(), now.schedule, now.bodies, now.contacts, now.supports, now.loads);
  const std::vector<Load<Dim>>& loads = now.loads.by_source[Source::applied_forces];
  if (loads.empty()) return {};
  EXPECT_EQ(now.loads.total[body].force, loads[body].force) << "nothing else acts";
  EXPECT_EQ(now.loads.total[body].moment, loads[body].moment);
  return loads[body];
}

// ---- point of action
// --------------------------------------------------------------------------------------------------

// on a block far from the origin that has moved and rotated: the point moves with the block, the force rotates only if
// the scene states it
TEST(AppliedForces, ActAtAPointOfTheirBlock) {
  Model<3> model = in_space<3>(box<3>({-1, -2, -3}, {1, 2, 3}));
  model.origin = {1e5, -2e5, 300};
  const Vector<3> place(1, -1, 2), force(3, 5, -7);
  const std::vector<double> point = numbers<3>(model.origin + model.bodies[0].reference + place);
  State<3> state = initial_state(model);
  state.bodies.motions[0].displacement = {4, 5, 6};
  state.bodies.motions[0].rotation = turned(Rotation<3>{}, Spin<3>(0.3, -0.8, 0.5));
  const Matrix<3> axes = matrix(state.bodies.motions[0].rotation);
  const Vector<3> arm = axes * place;

  ForcePlan plan = force_on<3>("block", force, point);
  Load<3> load = applied_to(0, apply(model, with({plan})), state);
  EXPECT_EQ(load.force, force);
  EXPECT_LT((load.moment - arm.cross(force)).norm(), 1e-9) << "coordinates of 2e5 m";

  plan.turns_with_body = true;
  load = applied_to(0, apply(model, with({plan})), state);
  EXPECT_LT((load.force - axes * force).norm(), rounding * force.norm());
  EXPECT_LT((load.moment - axes * place.cross(force)).norm(), 1e-9);

  // without a point at the centroid; forces of different names are added
  ForcePlan at_centroid = force_on<3>("block", force);
  EXPECT_TRUE(applied_to(0, apply(model, with({at_centroid})), state).moment.isZero(0));
  at_centroid.name = "other";
  EXPECT_LT((applied_to(0, apply(model, with({plan, at_centroid})), state).force - axes * force - force).norm(),
            rounding * force.norm());

  // in the plane
  const Model<2> flat = in_space<2>(box<2>({-1, -2}, {1, 2}));
  State<2> leaning = initial_state(flat);
  leaning.bodies.motions[0].rotation.angle = 30 * degree;
  const Load<2> up = applied_to(0, apply(flat, with({force_on<2>("block", {0, 8}, {1, 0})})), leaning);
  EXPECT_NEAR(up.moment[0], 8 * std::cos(30 * degree), rounding * 8);
}

// A force acts until one of the same name replaces it; zero ends it, and so does the excavation of its block.
TEST(AppliedForces, LastUntilOneOfTheirNameReplacesThem) {
  const Model<2> model = in_space<2>(cube<2>(1));
  const State<2> state = initial_state(model);
  ForcePlan first = force_on<2>("block", {3, 0}), other = first;
  other.name = "other";
  other.force = {0, 4};
  Model<2> now = apply(apply(model, with({first, other})), with({}));
  EXPECT_EQ(applied_to(0, now, state).force, Vector<2>(3, 4));
  first.force = {-1, 0};
  now = apply(now, with({first}));
  EXPECT_EQ(applied_to(0, now, state).force, Vector<2>(-1, 4));
  first.force = {0, 0};
  now = apply(now, with({first}));
  EXPECT_EQ(applied_to(0, now, state).force, Vector<2>(0, 4));
  other.force = {0, 0};
  EXPECT_TRUE(apply(now, with({other})).applied.empty()) << "a zero force costs nothing";

  Change removed;
  removed.remove.push_back({.names = {"block"}, .above = {}, .below = {}, .inside = {}});
  EXPECT_TRUE(apply(now, removed).applied.empty());
}

// its factor acts during its stage, and its last value stays, whichever stage follows
TEST(AppliedForces, KeepTheLastValueOfTheirStage) {
  Model<2> model = in_space<2>(cube<2>(1));
  ForcePlan grows = force_on<2>("block", {8, 0});
  grows.factor = {.times = {0, 2}, .factors = {0, 1}};
  grows.last_factor = value_at(grows.factor, 1);
  model = apply(model, with({grows}));
  State<2> state = initial_state(model);
  state.schedule.started = 5;
  for (const double since : {0.0, 0.25, 1.0}) {
    state.schedule.time = 5 + since;
    EXPECT_DOUBLE_EQ(applied_to(0, model, state).force[0], 4 * since);
  }
  for (int stage = 0; stage < 3; ++stage) {
    model = apply(model, with({}));
    EXPECT_EQ(applied_to(0, model, state).force[0], 4) << stage;
  }
  grows.last_factor = 0;
  EXPECT_TRUE(apply(apply(model, with({grows})), with({})).applied.empty());
}

// ---- effect on a block in 3-D -------------------------------------------------------------------------------

StagePlan run_of(double duration, std::vector<ForcePlan> forces) {
  StagePlan stage;
  stage.name = "run";
  stage.plan = RunPlan{.duration = duration};
  for (ForcePlan& plan : forces)
    plan.last_factor = value_at(plan.factor, duration);
  stage.change.force = std::move(forces);
  return stage;
}

template <int Dim>
Prepared<Dim> scene_of(const Model<Dim>& model, const State<Dim>& state, std::vector<StagePlan> stages) {
  Prepared<Dim> scene;
  scene.model = model;
  scene.state = state;
  scene.stages = std::move(stages);
  scene.settings.damping.local = 0;
  return scene;
}

// A block that hangs from a constant force equal to its weight: its centroid stays, and it swings like a pendulum with
// I d²θ/dt² = -F e sin θ, of the period 4 K(sin(θ₀/2)) (I/(F e))^1/2. Only the force determines the time step.
struct Pendulum {
  double arm = 0.8, force = 0;  // m, N
  Model<2> model;
  State<2> state;

  explicit Pendulum(double lean) : model(in_space<2>(box<2>({-0.5, -1}, {0.5, 1}))) {
    force = model.bodies[0].mass * shapes::gravity;
    model.gravity = {0, -shapes::gravity};
    state = initial_state(model);
    state.bodies.motions[0].rotation.angle = lean;
  }
  ForcePlan hook() const { return force_on<2>("block", {0, force}, {0, arm}); }
  double frequency() const { return std::sqrt(force * arm / model.bodies[0].inertia[0]); }  // rad/s, of small swings
};

TEST(AppliedForces, SetTheTimeStepOfABlockThatHangsFromOne) {
  const Pendulum pendulum(0.1);
  Model<2> model = apply(pendulum.model, with({pendulum.hook()}));
  State<2> state = pendulum.state;
  cache_poses(model, 1, state.bodies);
  list_by_body(model, state.contacts);
  sum_loads(model, Settings(), state.schedule, state.bodies, state.contacts, state.supports, state.loads);
  Settings settings;
  EXPECT_NEAR(estimate_time_step(model, settings, {.viscous_ratio = 0}, state.bodies, state.loads, state.contacts,
                                 state.time_step)
                      .limit *
                  pendulum.frequency(),
              2, rounding);

  // a force that turns with its block has no restoring moment, and adds no stiffness
  ForcePlan jack = pendulum.hook();
  jack.turns_with_body = true;
  model = apply(pendulum.model, with({jack}));
  sum_loads(model, settings, state.schedule, state.bodies, state.contacts, state.supports, state.loads);
  EXPECT_FALSE(std::isfinite(estimate_time_step(model, settings, {.viscous_ratio = 0}, state.bodies, state.loads,
                                                state.contacts, state.time_step)
                                 .limit));
}

double period_of(const std::vector<double>& time, const std::vector<double>& lean) {
  std::vector<double> upright;
  for (std::size_t i = 1; i < lean.size(); ++i)
    if (lean[i - 1] * lean[i] < 0)
      upright.push_back(time[i - 1] + (time[i] - time[i - 1]) * lean[i - 1] / (lean[i - 1] - lean[i]));
  return 2 * (upright.back() - upright.front()) / static_cast<double>(upright.size() - 1);
}

// Small swings have leapfrog's period, sin(ω' dt/2) = ω dt/2, and do not grow up to the stability limit; large ones,
// which would be chaotic near the limit, differ from the integral by the second-order error.
TEST(AppliedForces, SwingABlockLikeAPendulum) {
  for (const double lean : {1e-3, 1.0, 2.5})
    for (const double fraction : {1.0, 0.2, 0.02}) {
      const bool small = lean < 0.1;
      if (!small && fraction > 0.5) continue;
      const Pendulum pendulum(lean);
      const double swings = fraction < 0.1 ? 20 : 200,
                   period = 4 * std::comp_ellint_1(std::sin(lean / 2)) / pendulum.frequency();
      Prepared<2> scene = scene_of(pendulum.model, pendulum.state, {run_of(swings * period, {pendulum.hook()})});
      scene.settings.time.fraction = fraction;
      std::vector<double> time, angle;
      Watcher<2> watcher;
      watcher.pause = [&](const Progress<2>& p) {
        time.push_back(p.state.schedule.time);
        angle.push_back(p.state.bodies.motions[0].rotation.angle);
        return false;
      };
      Progress<2> progress = initial_progress(scene);
      ASSERT_TRUE(simulate(scene, progress, watcher));
      ASSERT_EQ(progress.results.outcome, Outcome::done) << progress.results.message;
      const double largest = std::abs(*std::ranges::max_element(angle, {}, [](double a) { return std::abs(a); }));
      const double step = pendulum.frequency() * progress.state.time_step.length;
      EXPECT_LE(step, 2 * fraction);
      EXPECT_GE(step, 1.5 * fraction) << "and no shorter than it must be";
      EXPECT_LT(largest, pi) << lean << ", " << fraction;
      const double found = period_of(time, angle) / period;
      if (small) {
        const double between_steps = 0.5 * step / (2 * pi) / swings;  // accuracy of a swing's end
        EXPECT_NEAR(found, 0.5 * step / std::asin(0.5 * step), between_steps) << fraction;
        EXPECT_LT(largest, lean / std::sqrt(1 - 0.25 * step * step) * (1 + 1e-6)) << fraction;
      } else {
        EXPECT_NEAR(found, 1, 0.1 * step * step) << lean << ", " << fraction;
      }
      EXPECT_LT(progress.state.bodies.motions[0].displacement.norm(), rounding) << "its centroid stays";
      EXPECT_LT(progress.state.ledger.energy.relative_error(), rounding);
    }
}

// ---- interruption and threads ---------------------------------------------------------------------------------------

// a block shaken on a plate by a sine at its top, by two forces together: identical bits from any checkpoint and for
// any number of threads
Prepared<3> shaken() {
  const Model<3> model = block_on_plate<3>(0, 35 * degree);
  const Vector<3> top = model.bodies[index_of(model, "block")].reference + Vector<3>(0.2, 0.1, 0.25);
  ForcePlan sine = force_on<3>("block", {4e3, 1e3, 0}, numbers<3>(top)),
            jack = force_on<3>("block", {0, 0, -5e3}, numbers<3>(top));
  sine.factor = {.times = {0, 4e-3}, .factors = {0, 1}, .frequency = 120, .phase = 0.3};
  jack.name = "jack";
  jack.turns_with_body = true;
  return scene_of(model, initial_state(model), {run_of(12e-3, {sine, jack}), run_of(4e-3, {})});
}

TEST(AppliedForces, ContinueFromACheckpoint) {
  const Prepared<3> scene = shaken();
  Progress<3> whole = initial_progress(scene);
  ASSERT_TRUE(simulate(scene, whole, {}));
  ASSERT_EQ(whole.results.outcome, Outcome::done) << whole.results.message;
  EXPECT_NE(whole.state.ledger.energy.flows[Source::applied_forces], 0);
  const long long steps = whole.state.counters.steps;
  ASSERT_GT(steps, 50);
  const std::string expected = end_of(whole);
  for (long long k = 1; k < steps; k += std::max(1LL, steps / 20)) {
    ASSERT_TRUE(end_of(continued(scene, k)) == expected) << "interrupted after step " << k << " of " << steps;
  }
}

TEST(AppliedForces, AreTheSameBitsForAnyNumberOfThreads) {
  // a hundred blocks side by side, so that threads share the work
  const Prepared<3> one = shaken();
  std::vector<Body<3>> bodies;
  for (int copy = 0; copy < 100; ++copy)
    for (Body<3> body : one.model.bodies) {
      body.reference[0] += 10 * copy;
      bodies.push_back(body);
    }
  Prepared<3> scene = scene_of(model_of<3>(bodies), {}, {one.stages[0]});
  scene.state = initial_state(scene.model);
  for (ForcePlan& plan : scene.stages[0].change.force)
    plan.point.clear();
  std::get<RunPlan>(scene.stages[0].plan).duration = 5e-4;
  std::string expected;
  for (const int threads : {1, 2, 3}) {
    scene.settings.threads = threads;
    Progress<3> progress = initial_progress(scene);
    ASSERT_TRUE(simulate(scene, progress, {}));
    if (threads == 1) expected = end_of(progress);
    EXPECT_TRUE(end_of(progress) == expected) << threads;
  }
  EXPECT_EQ(apply(scene.model, scene.stages[0].change).applied.size(), 200u);
}

}  // namespace
}  // namespace voussoir::loads_test
