// Steps at their extremes: very different masses and stiffnesses, any damping, positions far away, long equilibrium,
// NaN. Suites named …Long contain the long versions of the tests before them (`make test-long`).
#include <gtest/gtest.h>

#include <limits>

#include "core/base/floating_point_traps.hpp"
#include "core/run/run.hpp"
#include "core/step.hpp"
#include "core/testing/models.hpp"

namespace voussoir::step_extremes_test {
namespace {

using shapes::block_on_plate;
using shapes::gravity;
using shapes::index_of;

// ---- a pebble and a mountain ----------------------------------------------------------------------------------------

// one block on another on a fixed floor, translation only; lower and upper contact have stiffnesses of their own, N/m
template <int Dim>
struct Stack {
  Model<Dim> model;
  State<Dim> state;
  int lower, upper;
  double k_lower, k_upper;

  Stack(double half_lower, double half_upper, double mass_ratio, double stiffness_lower, double stiffness_upper)
      : k_lower(stiffness_lower), k_upper(stiffness_upper) {
    const auto block = [](double half, double foot, double density, const char* name) {
      Vector<Dim> low = Vector<Dim>::Constant(-half), high = Vector<Dim>::Constant(half);
      low[Dim - 1] = foot;
      high[Dim - 1] = foot + 2 * half;
      Body<Dim> body = make_body<Dim>({shapes::block<Dim>(shapes::box<Dim>(low, high))}, density);
      body.name = name;
      body.free_rotation.fill(false);
      return body;
    };
    const double volumes = std::pow(half_upper / half_lower, Dim);
    std::vector<Body<Dim>> bodies{block(20, -40, 2600, "floor"), block(half_lower, 0, 2600, "lower"),
                                  block(half_upper, 2 * half_lower, 2600 * mass_ratio / volumes, "upper")};
    bodies[0].fixed = true;
    // the upper block's faces belong to the model's joint, the others to none
    for (int& joint : bodies[2].parts[0].joints)
      joint = 0;
    model = shapes::model_of<Dim>(std::move(bodies));
    model.properties = {{"lower", k_lower, k_lower, 0.5, true}, {"upper", k_upper, k_upper, 0.5, true}};
    model.joints[0].properties = 1;
    lower = index_of(model, "lower");
    upper = index_of(model, "upper");
    state = initial_state(model);
    // its equilibrium position
    state.bodies.motions[lower].displacement[Dim - 1] = -(mass(lower) + mass(upper)) * gravity / k_lower;
    state.bodies.motions[upper].displacement[Dim - 1] = height(lower) - mass(upper) * gravity / k_upper;
  }
  double mass(int b) const { return model.bodies[b].mass; }
  double height(int b) const { return state.bodies.motions[b].displacement[Dim - 1]; }

  // the two masses' angular frequencies, rad/s: roots of ω⁴ - t ω² + d
  std::pair<double, double> frequencies() const {
    const double m1 = mass(lower), m2 = mass(upper);
    const double t = (k_lower + k_upper) / m1 + k_upper / m2, d = k_lower / m1 * (k_upper / m2);
    const double fast = 0.5 * (t + std::sqrt(t * t - 4 * d));
    return {std::sqrt(d / fast), std::sqrt(fast)};
  }
};

Settings undamped(double fraction) {
  Settings settings;
  settings.damping.local = 0;
  settings.time.fraction = fraction;
  return settings;
}

// angular frequency of a body's height about its start, from whole swings, rad/s
template <int Dim>
double measured_frequency(Stack<Dim> stack, int body, double speed, int swings) {
  const Settings settings = undamped(0.05);  // (ω dt)²/24 at most 4e-4 of the frequency
  const double start = stack.height(body);
  stack.state.bodies.motions[body].velocity[Dim - 1] = speed;
  double first = -1, last = 0, before = 0;
  for (int counted = 0; counted <= swings;) {
    step(stack.model, settings, stack.state);
    const double now = stack.height(body) - start;
    if (before < 0 && now >= 0) {
      last = stack.state.schedule.time - stack.state.time_step.length * now / (now - before);
      if (first < 0) first = last;
      ++counted;
    }
    before = now;
  }
  return 2 * std::numbers::pi * swings / (last - first);
}

// far below the overlap due to weight, so that no contact opens
template <int Dim>
void expect_light_frequency(const Stack<Dim>& stack, int light) {
  const double frequency = stack.frequencies().second;
  const double overlap = gravity * std::min((stack.mass(stack.lower) + stack.mass(stack.upper)) / stack.k_lower,
                                            stack.mass(stack.upper) / stack.k_upper);
  EXPECT_NEAR(measured_frequency(stack, light, 0.3 * overlap * frequency, 50), frequency, 1e-3 * frequency);
}

// in equilibrium nothing moves except by rounding: the heavy one stays
template <int Dim>
void expect_no_drift(Stack<Dim> stack, int heavy, int steps) {
  const Settings settings = undamped(0.1);
  const double start = stack.height(heavy);
  double farthest = 0;
  for (int i = 0; i < steps; ++i) {
    step(stack.model, settings, stack.state);
    farthest = std::max(farthest, std::abs(stack.height(heavy) - start));
  }
  EXPECT_LT(farthest, 1e-12 * stack.model.bodies[heavy].size);
  EXPECT_EQ(stack.state.counters.unconverged, 0);
}

// the mountain has 1e9 times the pebble's mass and, where they differ, 1e6 times the stiffness
template <int Dim>
Stack<Dim> mountain_on_pebble(double k_lower, double k_upper) {
  return {0.01, 10, 1e9, k_lower, k_upper};
}
template <int Dim>
Stack<Dim> pebble_on_mountain(double k_lower, double k_upper) {
  return {10, 0.01, 1e-9, k_lower, k_upper};
}

template <int Dim>
void expect_pebble_and_mountain(int steps) {
  for (const auto& [k_lower, k_upper] : {std::pair{4e13, 4e13}, {4e19, 4e13}, {4e13, 4e19}}) {
    const Stack<Dim> stack = mountain_on_pebble<Dim>(k_lower, k_upper);
    expect_light_frequency(stack, stack.lower);
    expect_no_drift(stack, stack.upper, steps);
  }
  for (const auto& [k_lower, k_upper] : {std::pair{4e13, 4e7}, {4e13, 4e6}}) {
    const Stack<Dim> stack = pebble_on_mountain<Dim>(k_lower, k_upper);
    expect_light_frequency(stack, stack.upper);
    expect_no_drift(stack, stack.lower, steps);
  }
}

TEST(StepExtremes, APebbleAndAMountain) {
  expect_pebble_and_mountain<2>(20'000);
  expect_pebble_and_mountain<3>(20'000);
}
TEST(StepExtremesLong, APebbleAndAMountainFor1e6Steps) {
  expect_pebble_and_mountain<2>(1'000'000);
  expect_pebble_and_mountain<3>(1'000'000);
}

// the mountain's own oscillation takes 1e5 times as many steps as the pebble's
TEST(StepExtremesLong, AMountainOscillatesOnAPebble) {
  const Stack<2> stack = mountain_on_pebble<2>(4e13, 4e13);
  const double frequency = stack.frequencies().first, overlap = stack.mass(stack.upper) * gravity / stack.k_upper;
  EXPECT_NEAR(measured_frequency(stack, stack.upper, 0.3 * overlap * frequency, 2), frequency, 1e-3 * frequency);
}

// ---- damping --------------------------------------------------------------------------------------------------------

// At the estimated step the block neither gains energy nor sticks to the plate, whatever the dashpot. Undamped, only
// while the contact stays closed: one that opens may gain energy from a fifth of the limit on (settings.hpp).
template <int Dim>
void expect_bounded() {
  for (const double ratio : {0.0, 1e-6, 0.1, 1.0, 10.0, 1000.0})
    for (const double speed : {0.005, 1.0}) {  // m/s: half of the speed that opens the contact, and far more
      if (ratio < 0.1 && speed > 0.1) continue;
      const Model<Dim> model = block_on_plate<Dim>(0, 35 * degree);
      const int block = index_of(model, "block");
      const double overlap = shapes::density * 0.5 * gravity / 1e9;  // in equilibrium
      State<Dim> state = initial_state(model);
      state.bodies.motions[block].displacement[Dim - 1] = -overlap;
      state.bodies.motions[block].velocity[Dim - 1] = speed;
      Settings settings;
      settings.damping = {.local = 0, .viscous_ratio = ratio};
      const double mass = model.bodies[block].mass, swing = speed * std::sqrt(mass / 1e9);
      const double highest = std::max(1.1 * swing, speed * speed / (2 * gravity)) + overlap;
      int opened = 0;
      for (int i = 0; i < 5'000; ++i) {
        step(model, settings, state);
        const double height = state.bodies.motions[block].displacement[Dim - 1];
        bool touching = false;
        for (const Contact<Dim>& c : state.contacts.list) {
          if (!c.touching()) continue;
          touching = true;
          ASSERT_GE(c.force.dot(c.geometry.normal), 0) << ratio;
        }
        opened += !touching;
        ASSERT_LE(height, highest) << ratio << ' ' << speed;
        ASSERT_GE(height, -1.1 * (overlap + std::hypot(swing, overlap))) << ratio << ' ' << speed;
      }
      EXPECT_EQ(opened > 0, speed > 0.1) << ratio << ' ' << speed;
    }
}

TEST(StepExtremes, AnyDashpotIsBoundedAndNeverPulls) {
  expect_bounded<2>();
  expect_bounded<3>();
}

// ---- far away and slow ----------------------------------------------------------------------------------------------

template <int Dim>
Model<Dim> moved(Model<Dim> model, double shift) {
  for (Body<Dim>& b : model.bodies)
    b.reference += Vector<Dim>::Constant(shift);
  return model;
}

// a sliding, tilting block far from the origin moves as it does at the origin, to the bit if coordinates are exact
template <int Dim>
void expect_same_motion_far_away() {
  State<Dim> expected;
  for (const double shift : {0.0, 1e3, 1e6, 1e9}) {
    const Model<Dim> model = moved(block_on_plate<Dim>(0, 20 * degree), shift);
    const int block = index_of(model, "block");
    State<Dim> state = initial_state(model);
    state.bodies.motions[block].velocity[0] = 0.5;
    state.bodies.motions[block].displacement[Dim - 1] = -1e-5;
    for (int i = 0; i < 2'000; ++i)
      step(model, {}, state);
    if (shift == 0) {
      expected = state;
      ASSERT_GT(state.bodies.motions[block].displacement[0], 1e-2);
      continue;
    }
    EXPECT_EQ(state.bodies.motions[block].displacement, expected.bodies.motions[block].displacement) << shift;
    EXPECT_EQ(state.bodies.motions[block].angular_momentum, expected.bodies.motions[block].angular_momentum) << shift;
  }
}

TEST(StepExtremes, FarFromTheOriginTheMotionIsTheSame) {
  expect_same_motion_far_away<2>();
  expect_same_motion_far_away<3>();
}

// a block too heavy to be stopped creeps into a plate, 1e4 m from the origin by less than the resolution of coordinates
template <int Dim>
void expect_overlap_of_creep() {
  Model<Dim> model = moved(block_on_plate<Dim>(0, 20 * degree), 1e4);
  const int block = index_of(model, "block");
  model.gravity.setZero();
  model.bodies[block].mass *= 1e21;
  model.bodies[block].free_rotation.fill(false);
  Settings settings;
  settings.damping.local = 0;
  settings.time.step = 1e-3;  // s
  const double increment = 1e-12;
  const int steps = 100'000;
  State<Dim> state = initial_state(model);
  state.bodies.motions[block].velocity[Dim - 1] = -increment / 1e-3;
  for (int i = 0; i <= steps; ++i)
    step(model, settings, state);
  const ContactGeometry<Dim>& g = state.contacts.list.front().geometry;
  EXPECT_NEAR(g.overlap, increment * steps, 1e-6 * increment * steps);
}

TEST(StepExtremes, CreepFarFromTheOriginClosesAContact) {
  expect_overlap_of_creep<2>();
  expect_overlap_of_creep<3>();
}

// ---- rest -----------------------------------------------------------------------------------------------------------

// on a slope a hundredth of a degree below its friction angle the block comes to equilibrium, and stays there
template <int Dim>
void expect_rest(double local_damping, int steps) {
  const double slope = 30 * degree;
  const Model<Dim> model = block_on_plate<Dim>(slope, slope + 0.01 * degree);
  const int block = index_of(model, "block");
  State<Dim> state = initial_state(model);
  RunSchedule ramp;
  ramp.gravity.ramp = 0.5;  // s: slow compared with an oscillation, or inertia exceeds the block's friction
  Settings settings;
  settings.equilibrium.unbalanced = 1e-9;
  ASSERT_EQ(run<Dim>(model, settings, {.rest = true, .step_limit = 100'000}, ramp, state).reason,
            StopReason::equilibrium);
  const Motion<Dim> settled = state.bodies.motions[block];
  const double slipped = state.contacts.list.front().history.plastic_slip;
  settings.damping.local = local_damping;
  double farthest = 0, fastest = 0;
  for (int i = 0; i < steps; ++i) {
    step(model, settings, state);
    farthest = std::max(farthest, (state.bodies.motions[block].displacement - settled.displacement).norm());
    fastest = std::max(fastest, state.bodies.motions[block].velocity.norm());
  }
  EXPECT_LT(farthest, 1e-9) << local_damping;
  // the unbalanced fraction of the weight, as an oscillation of the shear spring; ten times that
  const double left = settings.equilibrium.unbalanced * model.bodies[block].mass * gravity;
  EXPECT_LT(model.bodies[block].mass * fastest * fastest, 10 * left * left / 5e8) << local_damping;
  EXPECT_EQ(state.contacts.list.front().history.plastic_slip, slipped) << local_damping;
}

TEST(StepExtremes, ABlockInEquilibriumOnASlopeStays) {
  for (const double local_damping : {0.7, 0.0}) {
    expect_rest<2>(local_damping, 100'000);
    expect_rest<3>(local_damping, 100'000);
  }
}
TEST(StepExtremesLong, ABlockInEquilibriumOnASlopeStaysFor1e7Steps) {
  for (const double local_damping : {0.7, 0.0}) {
    expect_rest<2>(local_damping, 10'000'000);
    expect_rest<3>(local_damping, 10'000'000);
  }
}

// ---- NaN ------------------------------------------------------------------------------------------------------------

// a velocity that is not a number stops the run in its first step, and the message names the body
template <int Dim>
void expect_stop_at_nan(double height) {
  const WithoutTraps without_traps;
  const Model<Dim> model = block_on_plate<Dim>(0, 35 * degree);
  const int block = index_of(model, "block");
  State<Dim> state = initial_state(model);
  for (int i = 0; i < 100; ++i)
    step(model, {}, state);
  state.bodies.motions[block].displacement[Dim - 1] += height;
  state.bodies.motions[block].velocity[0] = std::numeric_limits<double>::quiet_NaN();
  const RunReport report = run<Dim>(model, {}, {.step_limit = 10}, {}, state);
  EXPECT_EQ(report.reason, StopReason::not_finite);
  EXPECT_EQ(report.steps, 1);
  EXPECT_NE(report.detail.find("block"), std::string::npos) << report.detail;
}

TEST(StepExtremes, ANaNStopsTheRunImmediatelyAndNamesTheBody) {
  for (const double height : {0.0, 1.0}) {  // m: in contact, and in flight
    expect_stop_at_nan<2>(height);
    expect_stop_at_nan<3>(height);
  }
}

}  // namespace
}  // namespace voussoir::step_extremes_test
