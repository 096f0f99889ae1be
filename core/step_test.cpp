// Step and run on small models made by hand: determinism to the bit, conservation, closed forms, endings.
#include "core/step.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/floating_point_traps.hpp"
#include "core/model/state_hash.hpp"
#include "core/run/run.hpp"
#include "core/slicing/slice.hpp"
#include "core/step/relaxation.hpp"
#include "core/testing/end_bytes.hpp"
#include "core/testing/models.hpp"

namespace voussoir::step_test {
namespace {

using shapes::block_on_plate;
using shapes::body_of;
using shapes::density;
using shapes::gravity;
using shapes::index_of;
using shapes::jointed_box;
using shapes::model_of;
using shapes::Random;

// momentum is a sum of forces that cancel to rounding, over some thousand steps
constexpr double conserved = 1e-10;

// equilibrium within 1e-6 of the contact forces (EquilibriumSettings), with a margin for sums over contacts
constexpr double rest_tolerance = 1e-5;

// the instant of yield is between two steps, of which there are about a hundred in an oscillation of the shear spring
constexpr double slide_tolerance = 1e-3;

// the force acts for a full step at both ends of the contact: up to 0.04² of the energy at 0.02 of the limit
constexpr double rebound_tolerance = 2e-3;

template <int Dim>
void steps(const Model<Dim>& model, const Settings& settings, int count, State<Dim>& state) {
  for (int i = 0; i < count; ++i)
    step(model, settings, state);
}

// ---- determinism ----------------------------------------------------------------------------------------------------

TEST(Determinism, EveryThreadCountGivesTheSameBits) {
  const Model<3> model = model_of<3>(jointed_box());
  EXPECT_GT(model.bodies.size(), 45u);
  EXPECT_LT(model.bodies.size(), 80u);
  std::string expected;
  for (const int threads : {1, 2, 4, 8}) {
    Settings settings;
    settings.threads = threads;
    State<3> state = initial_state(model);
    steps(model, settings, 200, state);
    if (threads == 1) {
      expected = bits_of(state);
      // something must have happened: contacts, slip, rotation
      int touching = 0;
      double slip = 0;
      for (const Contact<3>& c : state.contacts.list) {
        touching += c.touching();
        slip += c.history.plastic_slip;
      }
      EXPECT_GT(touching, 50);
      EXPECT_GT(slip, 0);
      EXPECT_EQ(state.counters.unconverged, 0);
    }
    EXPECT_TRUE(bits_of(state) == expected) << threads << " threads";
  }
}

// enough bodies and contacts for every loop to be divided
TEST(Determinism, EveryThreadCountGivesTheSameBitsForManyBlocks) {
  std::vector<Body<3>> bodies;
  for (int copy = 0; copy < 25; ++copy)
    for (Body<3> body : jointed_box()) {
      body.reference[0] += 100 * copy;
      bodies.push_back(body);
    }
  const Model<3> model = model_of<3>(bodies);
  EXPECT_GT(model.bodies.size(), 1000u);
  for (const bool relaxing : {false, true}) {
    std::string expected;
    for (const int threads : {1, 3}) {
      Settings settings;
      settings.threads = threads;
      settings.contact.skin = 0.001;
      State<3> state = initial_state(model);
      if (relaxing) begin_relaxation(state);
      for (std::size_t b = 0; b < model.bodies.size() && !relaxing; ++b)
        if (!model.bodies[b].fixed)
          state.bodies.motions[b].velocity = {0.5, 0.2 * static_cast<double>(b % 5), 0.3};  // m/s
      steps(model, settings, 25, state);
      if (threads == 1) expected = bits_of(state);
      EXPECT_GT(state.counters.neighbour_builds, relaxing ? 0 : 1);
      EXPECT_TRUE(bits_of(state) == expected) << threads << " threads";
    }
  }
}

TEST(Determinism, TheSkinChangesOnlyTheCost) {
  const Model<3> model = model_of<3>(jointed_box());
  std::string expected;
  long long evaluations = 0, builds = 0;
  for (const double skin : {0.001, 0.5, 3.0}) {
    Settings settings;
    settings.contact.skin = skin;
    State<3> state = initial_state(model);
    for (std::size_t b = 0; b < model.bodies.size(); ++b)
      if (!model.bodies[b].fixed)
        state.bodies.motions[b].velocity = {0.5, 0.2 * static_cast<double>(b % 5), 0.3};  // m/s
    steps(model, settings, 400, state);
    if (expected.empty()) {
      expected = state_hash(model, state);
      evaluations = state.counters.contact_evaluations;
      builds = state.counters.neighbour_builds;
      continue;
    }
    EXPECT_TRUE(state_hash(model, state) == expected);
    EXPECT_EQ(state.counters.contact_evaluations, evaluations);
    EXPECT_LT(state.counters.neighbour_builds, builds);
  }
}

TEST(Determinism, TheOrderOfInputDoesNotMatter) {
  Random random(81);
  std::vector<Body<3>> bodies = jointed_box();
  std::string expected;
  for (int order = 0; order < 3; ++order) {
    const Model<3> model = model_of<3>(bodies);
    State<3> state = initial_state(model);
    steps(model, {}, 200, state);
    if (order == 0) expected = bits_of(state);
    EXPECT_TRUE(bits_of(state) == expected);
    shapes::shuffle(bodies, random);
  }
}

TEST(Determinism, ARunMayBeInterrupted) {
  const Model<3> model = model_of<3>(jointed_box());
  State<3> whole = initial_state(model), parts = initial_state(model);
  steps(model, {}, 200, whole);
  steps(model, {}, 77, parts);
  State<3> copy = parts;
  steps(model, {}, 123, copy);
  EXPECT_TRUE(bits_of(copy) == bits_of(whole));
}

template <int Dim>
void expect_no_origin() {
  // coordinates that survive a shift by 2^20 m exactly must give the same bits there
  const Vector<Dim> shift = Vector<Dim>::Constant(0x1p20);
  std::string expected;
  for (const double far : {0.0, 1.0}) {
    Model<Dim> model = block_on_plate<Dim>(0, 35 * degree);
    for (Body<Dim>& b : model.bodies)
      b.reference += far * shift;
    State<Dim> state = initial_state(model);
    steps(model, {}, 300, state);
    if (expected.empty()) expected = state_hash(model, state);
    EXPECT_TRUE(state_hash(model, state) == expected);
  }
}

TEST(Determinism, NothingDependsOnTheOrigin) {
  expect_no_origin<3>();
  expect_no_origin<2>();
}

// ---- conservation ---------------------------------------------------------------------------------------------------

template <int Dim>
struct Totals {
  Vector<Dim> momentum = Vector<Dim>::Zero();
  Spin<Dim> angular = Spin<Dim>::Zero();
  double energy = 0;
};

template <int Dim>
Totals<Dim> totals(const Model<Dim>& model, const State<Dim>& state) {
  Totals<Dim> t;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    const Motion<Dim>& m = state.bodies.motions[b];
    const Vector<Dim> place = body.reference + m.displacement, p = body.mass * m.velocity;
    t.momentum += p;
    t.angular += moment(place, p);
    t.energy += 0.5 * p.dot(m.velocity);
    if constexpr (Dim == 3) {
      t.angular += matrix(m.rotation) * body.principal_axes * m.angular_momentum;
      t.energy += 0.5 * m.angular_momentum.cwiseAbs2().cwiseQuotient(body.inertia).sum();
    } else {
      t.angular += m.angular_momentum;
      t.energy += 0.5 * m.angular_momentum[0] * m.angular_momentum[0] / body.inertia[0];
    }
  }
  return t;
}

template <int Dim>
void expect_collision(std::uint64_t seed) {
  Random random(seed);
  for (int trial = 0; trial < 4; ++trial) {
    Vector<Dim> beside = Vector<Dim>::Constant(0.2);
    beside[0] = 1.4;
    Model<Dim> model = model_of<Dim>(
        {body_of<Dim>(shapes::placed<Dim>(shapes::cube<Dim>(0.5), matrix(shapes::orientation<Dim>(random)),
                                          Vector<Dim>::Zero())),
         body_of<Dim>(shapes::placed<Dim>(shapes::cube<Dim>(0.4), matrix(shapes::orientation<Dim>(random)), beside))},
        trial % 2 ? 0.0 : 30 * degree);
    model.gravity.setZero();
    Settings settings;
    settings.damping.local = 0;
    settings.time.fraction = 0.02;
    State<Dim> state = initial_state(model);
    state.bodies.motions[0].velocity[0] = 2;
    state.bodies.motions[1].velocity[0] = -1;
    const Totals<Dim> before = totals(model, state);
    const double speed = model.bodies[0].mass * 2;
    int touched = 0;
    while (state.schedule.time < 0.3) {
      step(model, settings, state);
      for (const Contact<Dim>& c : state.contacts.list)
        touched += c.touching();
    }
    const Totals<Dim> after = totals(model, state);
    EXPECT_GT(touched, 10);
    EXPECT_LT((after.momentum - before.momentum).norm(), conserved * speed);
    EXPECT_LT((after.angular - before.angular).norm(), conserved * speed);
  }
}

TEST(Conservation, ACollisionKeepsLinearAndAngularMomentum3D) {
  expect_collision<3>(82);
}
TEST(Conservation, ACollisionKeepsLinearAndAngularMomentum2D) {
  expect_collision<2>(83);
}

// Between faces with a constant stiffness the force has a potential. (An oblique impact's has none: the normal rotates
// and the area grows with the overlap.)
template <int Dim>
void expect_rebound() {
  for (const double speed : {1e-3, 1.0}) {
    Vector<Dim> beside = Vector<Dim>::Zero();
    beside[0] = 1.01;
    Model<Dim> model =
        model_of<Dim>({body_of<Dim>(shapes::cube<Dim>(0.5)),
                       body_of<Dim>(shapes::placed<Dim>(shapes::cube<Dim>(0.5), Matrix<Dim>::Identity(), beside))});
    model.gravity.setZero();
    model.properties[0].constant_stiffness = true;
    Settings settings;
    settings.damping.local = 0;
    settings.time.fraction = 0.02;
    State<Dim> state = initial_state(model);
    state.bodies.motions[0].velocity[0] = speed;
    while (state.schedule.time < 0.02 / speed)
      step(model, settings, state);
    // equal masses exchange their velocities
    EXPECT_NEAR(state.bodies.motions[0].velocity[0], 0, rebound_tolerance * speed);
    EXPECT_NEAR(state.bodies.motions[1].velocity[0], speed, rebound_tolerance * speed);
    EXPECT_LT(state.bodies.motions[1].angular_momentum.norm(), conserved * speed * model.bodies[0].mass);
  }
}

TEST(Conservation, EqualCubesExchangeTheirVelocities) {
  expect_rebound<3>();
  expect_rebound<2>();
}

// ---- closed forms ---------------------------------------------------------------------------------------------------

template <int Dim>
void expect_settlement() {
  const Model<Dim> model = block_on_plate<Dim>(0, 35 * degree);
  const int block = index_of(model, "block");
  State<Dim> state = initial_state(model);
  RunGoal goal;
  goal.rest = true;
  goal.step_limit = 100'000;
  const RunReport report = run<Dim>(model, {}, goal, {}, state);
  EXPECT_EQ(report.reason, StopReason::equilibrium);
  // weight over stiffness per area times the area 1
  const double settlement = density * 0.5 * gravity / 1e9;
  EXPECT_NEAR(-state.bodies.motions[block].displacement[Dim - 1], settlement, rest_tolerance * settlement);
  ASSERT_EQ(state.contacts.list.size(), 1u);
  EXPECT_NEAR(state.contacts.list[0].force.norm(), density * 0.5 * gravity, rest_tolerance * density * gravity);
}

TEST(ClosedForm, ABlockSettlesByItsWeight) {
  expect_settlement<3>();
  expect_settlement<2>();
}

template <int Dim>
void expect_slide() {
  const double slope = 30 * degree;
  for (const double friction : {0.0, 20 * degree, 40 * degree}) {
    Model<Dim> model = block_on_plate<Dim>(slope, friction);
    const int block = index_of(model, "block");
    model.bodies[block].free_rotation.fill(false);  // translation only: no rocking
    // starts with its static overlap, so that it slides from the first step
    State<Dim> state = initial_state(model);
    Vector<Dim> up = Vector<Dim>::Zero();
    up[0] = -std::sin(slope);
    up[Dim - 1] = std::cos(slope);
    state.bodies.motions[block].displacement = -density * 0.5 * gravity * std::cos(slope) / 1e9 * up;
    Settings settings;
    settings.damping.local = 0;
    RunGoal goal;
    goal.end_time = 0.2;
    const RunReport report = run<Dim>(model, settings, goal, {}, state);
    EXPECT_EQ(report.reason, StopReason::end_time);
    const double slid = state.bodies.motions[block].displacement.norm();
    if (friction > slope) {
      EXPECT_LT(slid, 1e-4);  // shear settlement, oscillating without damping
      continue;
    }
    // the shear spring oscillates up to the frictional strength, then the block slides under the excess force
    const double mass = density * 0.5, drive = mass * gravity * std::sin(slope);
    const double resistance = std::tan(friction) * mass * gravity * std::cos(slope), spring = 5e8;
    const double slip = resistance / spring, start = std::acos(1 - resistance / drive) / std::sqrt(spring / mass);
    const double speed = std::sqrt(2 * slip * (drive - resistance / 2) / mass), sliding = state.schedule.time - start;
    const double expected = slip + speed * sliding + 0.5 * (drive - resistance) / mass * sliding * sliding;
    EXPECT_NEAR(slid, expected, slide_tolerance * expected);
  }
}

TEST(ClosedForm, ABlockSlidesDownASlope) {
  expect_slide<3>();
  expect_slide<2>();
}

// ---- endings --------------------------------------------------------------------------------------------------------

TEST(Run, ReportsWhyItStopped) {
  const Model<3> model = block_on_plate<3>(30 * degree, 10 * degree);
  const auto ending = [&](const RunGoal& goal) {
    State<3> state = initial_state(model);
    return run<3>(model, {}, goal, {}, state).reason;
  };
  EXPECT_EQ(ending({.end_time = 1e-3}), StopReason::end_time);
  EXPECT_EQ(ending({.rest = true, .time_limit = 1e-3}), StopReason::time_limit);
  EXPECT_EQ(ending({.rest = true, .step_limit = 5}), StopReason::step_limit);
  EXPECT_EQ(ending({.rest = true, .moved_away = 1e-3}), StopReason::moved_away);
  for (const StopReason r :
       {StopReason::equilibrium, StopReason::end_time, StopReason::moved_away, StopReason::step_limit,
        StopReason::time_limit, StopReason::no_contact_answer, StopReason::not_finite})
    EXPECT_NE(describe(r), "unknown");
}

CentreResult<3> no_centre(const HalfSpaces<3>&, const CentreRequest<3>&) {
  return {};
}

TEST(Run, StopsAtAContactWithoutASolution) {
  Model<3> model = block_on_plate<3>(0, 35 * degree);
  model.solvers.centre = &no_centre;
  State<3> state = initial_state(model);
  state.bodies.motions[index_of(model, "block")].displacement[2] = -1e-4;
  const RunReport report = run<3>(model, {}, {.rest = true}, {}, state);
  EXPECT_EQ(report.reason, StopReason::no_contact_answer);
  EXPECT_EQ(report.steps, 1);
  EXPECT_EQ(state.counters.unconverged, 1);
  EXPECT_NE(report.detail.find("analytic centre"), std::string::npos) << report.detail;
}

TEST(Run, StopsAtAForceThatIsNotFinite) {
  Model<3> model = block_on_plate<3>(0, 35 * degree);
  State<3> state = initial_state(model);
  state.schedule.gravity_factor = std::numeric_limits<double>::infinity();
  const WithoutTraps without_traps;
  EXPECT_EQ(run<3>(model, {}, {.rest = true}, {}, state).reason, StopReason::not_finite);
}

TEST(Run, HasNoEquilibriumWhileGravityGrows) {
  const Model<2> model = block_on_plate<2>(0, 35 * degree);
  State<2> state = initial_state(model);
  RunSchedule schedule;
  schedule.gravity.ramp = 0.2;
  const RunReport report = run<2>(model, {}, {.rest = true, .step_limit = 200'000}, schedule, state);
  EXPECT_EQ(report.reason, StopReason::equilibrium);
  EXPECT_GE(state.schedule.time, 0.2);
  EXPECT_EQ(state.schedule.gravity_factor, 1);
}

TEST(Run, TakesGravityFromOneMultipleToAnother) {
  const Model<2> model = block_on_plate<2>(0, 35 * degree);
  State<2> state = initial_state(model);
  const RunGoal goal{.rest = true, .step_limit = 200'000};
  run<2>(model, {}, goal, {.gravity = {.ramp = 0.1, .from = 0, .to = 3}, .properties = {}}, state);
  EXPECT_EQ(state.schedule.gravity_factor, 3);
  const double overlap = state.contacts.list.front().geometry.overlap;
  state.schedule.started = state.schedule.time;
  run<2>(model, {}, goal, {.gravity = {.ramp = 0.1, .from = 3, .to = 6}, .properties = {}}, state);
  EXPECT_NEAR(state.contacts.list.front().geometry.overlap / overlap, 2, 1e-5);
  run<2>(model, {}, goal, {.properties = {}}, state);  // nothing stated: nothing changes
  EXPECT_EQ(state.schedule.gravity_factor, 6);
  run<2>(model, {}, goal, {.gravity = {.to = 1}, .properties = {}}, state);
  EXPECT_NEAR(state.contacts.list.front().geometry.overlap / overlap, 1.0 / 3, 1e-5);
}

TEST(Run, EndsARampWithItsLastStep) {
  const Model<2> model = block_on_plate<2>(0, 35 * degree);
  constexpr double time_step = 1.0 / 4096;
  Settings settings;
  settings.time.step = time_step;
  State<2> state = initial_state(model);
  const RunReport report = run<2>(model, settings, {.end_time = 4 * time_step},
                                  {.gravity = {.ramp = 4 * time_step}, .properties = {}}, state);
  EXPECT_EQ(report.steps, 4);
  EXPECT_EQ(state.schedule.gravity_factor, 1);
  // the same when friction is reduced
  state.schedule.started = state.schedule.time;
  run<2>(model, settings, {.end_time = state.schedule.time + 4 * time_step},
         {.strength_rate = 0.1 / time_step, .strength_from = 0.6, .strength_to = 0.2, .properties = {0}}, state);
  EXPECT_EQ(state.schedule.friction[0], 0.2);
}

TEST(Model, RemovedBodiesTouchNothingAndIdsStay) {
  Model<3> model = block_on_plate<3>(0, 35 * degree);
  const int block = index_of(model, "block"), plate = index_of(model, "plate");
  Change change;
  change.remove = {{.names = {"plate"}, .above = {}, .below = {}, .inside = {}}};
  model = apply(std::move(model), change);
  EXPECT_EQ(model.bodies.size(), 2u);
  EXPECT_FALSE(model.bodies[plate].present);
  State<3> state = initial_state(model);
  step<3>(model, {}, state);
  EXPECT_TRUE(state.contacts.list.empty());
  EXPECT_NEAR(state.loads.total[block].force[2], -density * 0.5 * gravity, 1e-6);
  EXPECT_THROW(index_of(model, "nobody"), std::out_of_range);
}

TEST(Model, SelectsBySideAndByPoint) {
  Model<3> model = block_on_plate<3>(0, 35 * degree);
  model.joints = {{"floor", {Vector<3>::UnitZ(), 0}, 0}};
  const int block = index_of(model, "block"), plate = index_of(model, "plate");
  EXPECT_EQ(select(model, {.names = {}, .above = {"floor"}, .below = {}, .inside = {}}), std::vector<int>{block});
  EXPECT_EQ(select(model, {.names = {}, .above = {}, .below = {"floor"}, .inside = {}}), std::vector<int>{plate});
  EXPECT_EQ(select(model, {.names = {}, .above = {}, .below = {}, .inside = {{0.1, 0.1, 0.1}}}),
            std::vector<int>{block});
  EXPECT_TRUE(select(model, Selector{}).empty());
}

}  // namespace
}  // namespace voussoir::step_test
