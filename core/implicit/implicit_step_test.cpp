// Motions by implicit steps against closed forms: energy at any step, friction of second order, impacts.
#include "core/implicit/implicit_step.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/load/ground_motion.hpp"
#include "core/testing/implicit_runs.hpp"

namespace voussoir::implicit_step_test {
namespace {

constexpr double g = 9.81;

// ---- a block that bounces -------------------------------------------------------------------------------------------

// 1 m, 1000 kg, falls by 0.1 m; ω = (k/m)^½ = 316 rad/s, or for steps beyond 20 ms a stiffer joint
Prepared<2> bounce(double limits, double viscous_ratio, double duration = 0.35) {
  const double omega = std::max(std::sqrt(1e5), 2 * limits / 0.02), h = 2 * limits / omega;
  return scene_of<2>(fmt::format(R"(
dimension = 2
gravity = [0, -9.81]
density = 1000
blocks = [{{ name = "base", box = {{ min = [-2, -1], max = [3, 0] }}, fixed = true }},
          {{ name = "block", box = {{ min = [0, 0.1], max = [1, 1.1] }} }}]
joint_properties = [{{ name = "rock", normal_stiffness = {3}, shear_stiffness = 1e7, friction_deg = 30 }}]
restrain = [{{ bodies = ["block"], rotation = true }}]
contact = {{ face = "point" }}
damping = {{ local = 0, viscous_ratio = {0} }}
[[stage]]
name = "bounce"
kind = "run"
duration_s = {1}
time = {{ integration = "implicit", step_s = {2:.17g} }}
)",
                                 viscous_ratio, duration, h, 1000 * omega * omega));
}

TEST(ImplicitStep, ABouncingBlockNeverGainsEnergy) {
  for (const double limits : {0.01, 0.1, 0.5, 0.9, 3.0, 10.0, 100.0, 1e3, 1e4}) {
    SCOPED_TRACE(limits);
    const Followed<2> run = followed(bounce(limits, 0));
    expect_sound(run.end);
    EXPECT_LE(run.energy.most, run.energy.start + 1e-12 * 1000 * g * 0.1);
  }
}

// speed after the impact over that before it, from the height that is left: the energy above rest
double restitution(double limits, double viscous_ratio) {
  const Prepared<2> scene = bounce(limits, viscous_ratio, 0.16);  // the impact is at 0.143 s
  const Progress<2> end = whole_run(scene);
  const Motion<2>& m = end.state.bodies.motions[1];
  const double height = m.displacement[1] + 0.1;
  return std::sqrt(std::max(m.velocity.squaredNorm() + 2 * g * height, 0.0) / (2 * g * 0.1));
}

// By small steps that of the joint: with springs alone 1, with dashpots 0.8545626 (fall of 0.1 m under gravity, by
// integration in time with the event); by large ones none.
TEST(ImplicitStep, AnImpactIsTheJointsWhereItIsResolvedAndPlasticElsewhere) {
  EXPECT_GE(restitution(0.1, 0), 0.997);
  EXPECT_NEAR(restitution(0.01, 0.05), 0.8545626, 3e-4);
  for (const double limits : {3.0, 30.0, 1e3})
    EXPECT_LT(restitution(limits, 0), 0.3) << limits;
}

// ---- a block on ground that moves -----------------------------------------------------------------------------------

// 1 m, 2000 kg, at rest on ground that carries it, without rotation. `more`: further keys.
std::string settled_block(const Vector<2>& gravity, double stiffness, double friction_deg,
                          const std::string& more = {}) {
  return fmt::format(R"(
dimension = 2
gravity = [{0:.17g}, {1:.17g}]
density = 2000
blocks = [{{ name = "base", box = {{ min = [-5, -1], max = [5, 0] }}, fixed = true }},
          {{ name = "block", box = {{ min = [0, 0], max = [1, 1] }} }}]
joint_properties = [{{ name = "rock", normal_stiffness = {2:g}, shear_stiffness = {2:g}, friction_deg = {3:.17g} }}]
restrain = [{{ bodies = ["block"], rotation = true }}]
{4}
[[stage]]
name = "settle"
kind = "settle"
gravity_ramp_s = 0.2
)",
                     gravity[0], gravity[1], stiffness, friction_deg, more);
}

// ---- a block on a shaken incline
// -------------------------------------------------------------------------------------

// 10 degrees, friction 30 degrees, 2 Hz and 0.4 m/s, first down the slope: in three cycles of 0.5 s a slip of 7.905576
// mm each
std::string shaken_text(double stiffness, const std::string& time) {
  return settled_block({-1.7034885, -9.6609640}, stiffness, 30, "contact = { face = \"point\" }") + fmt::format(R"(
[[stage]]
name = "shake"
kind = "run"
duration_s = 1.5
damping = {{ local = 0 }}
time = {{ integration = "implicit", {} }}
[[stage.move]]
bodies = ["base"]
velocity = [-0.4, 0]
frequency_hz = 2
)",
                                                                                                                time);
}

Prepared<2> shaken(double stiffness, const std::string& time) {
  return scene_of<2>(shaken_text(stiffness, time));
}

double slip_of(const Progress<2>& end) {
  return end.state.bodies.motions[0].displacement[0] - end.state.bodies.motions[1].displacement[0];
}

// Newmark's rigid block slips by 7.905576236152 mm a cycle: closed form
TEST(ImplicitStep, AShakenBlockSlipsByNewmarksDistance) {
  const double slip = 3 * 7.905576236152e-3;
  // a slip that begins within a step has up to j h²/8 too much or too little speed, j how fast the acceleration passes
  // what friction holds, and keeps it while it lasts
  constexpr double jerk = 40.3, lasts = 0.168;
  for (const double h : {4.3e-3, 14e-3})
    for (const double stiffness : {1e10, 1e12, 1e14}) {
      const double tolerance = 3 * jerk * h * h / 8 * lasts / slip;
      SCOPED_TRACE(fmt::format("h {} k {:g}", h, stiffness));
      const Progress<2> end = whole_run(shaken(stiffness, fmt::format("step_s = {}", h)));
      expect_sound(end, stiffness);
      EXPECT_NEAR(slip_of(end), slip, tolerance * slip);
      const Counters& cost = end.state.counters;
      EXPECT_LT(cost.implicit_iterations, 2.5 * cost.implicit_solutions);
    }
}

// by its own error: the load holds the step, and the cost does not follow the stiffness
TEST(ImplicitStep, TheStepFollowsTheMotion) {
  const double slip = 3 * 7.905576236152e-3;
  for (const double stiffness : {1e10, 1e12, 1e14}) {
    SCOPED_TRACE(stiffness);
    const Progress<2> end = whole_run(shaken(stiffness, "error_m = 1e-5"));
    EXPECT_NEAR(slip_of(end), slip, 5e-3 * slip);
    EXPECT_LT(end.state.counters.implicit_solutions, 1500);
    EXPECT_GT(end.state.counters.implicit_by_load, end.state.counters.implicit_by_error);
  }
}

// ---- a block on ground that is pushed -------------------------------------------------------------------------------

// friction 0.1, horizontal ground that is given 0.5 m/s within 0.1019 s at 0.5 g and keeps it
TEST(ImplicitStep, ARectangularPulseIsExact) {
  const double speed = 0.5, acceleration = 0.5 * g, ramp = speed / acceleration;
  const double slip = speed * speed / (2 * g) * (1 / 0.1 - 1 / 0.5);
  for (const double h : {ramp / 10, ramp / 40}) {
    const double duration = 14 * ramp;
    const Prepared<2> scene =
        scene_of<2>(settled_block({0, -g}, 1e12, 5.710593137499643) + fmt::format(R"(
[[stage]]
name = "shake"
kind = "run"
duration_s = {0:.17g}
time = {{ integration = "implicit", step_s = {1:.17g} }}
[[stage.move]]
bodies = ["base"]
velocity = [{2}, 0]
times_s = [0, {3:.17g}]
factors = [0, 1]
)",
                                                                                  duration, h, speed, ramp));
    const Progress<2> end = whole_run(scene);
    expect_sound(end);
    EXPECT_NEAR(slip_of(end), slip, 4e-6 * slip) << h;
  }
}

// 30 degrees, friction 25 degrees, shaken across the plane with half of gravity: it slides all the time, and as far as
// without shaking
TEST(ImplicitStep, SlipUnderAGrowingNormalForceIsCoulombs) {
  const double angle = std::numbers::pi / 6, mu = std::tan(25 * std::numbers::pi / 180), time = 2;
  const double expected = (std::sin(angle) - mu * std::cos(angle)) * g * time * time / 2;
  for (const double h : {2e-3, 10e-3, 20e-3}) {
    const Vector<2> up(std::sin(angle), std::cos(angle));
    const double speed = 0.5 * g / (2 * std::numbers::pi);
    const Prepared<2> scene =
        scene_of<2>(settled_block(-g * up, 1e12, 40) + fmt::format(R"(
[[stage]]
name = "slide"
friction_deg = 25
kind = "run"
duration_s = {0}
time = {{ integration = "implicit", step_s = {1} }}
[[stage.move]]
bodies = ["base"]
velocity = [{2:.17g}, {3:.17g}]
frequency_hz = 1
)",
                                                                   time, h, speed * up[0], speed * up[1]));
    const Progress<2> end = whole_run(scene);
    expect_sound(end);
    EXPECT_NEAR(slip_of(end), expected, 2e-6 * expected) << h;
  }
}

// ---- a circle -------------------------------------------------------------------------------------------------------

// A level plane in a circle of 2 Hz with A = 4 m/s², friction 0.3: relative to it the block comes to run on a circle of
// √(A² - μ² g²)/ω². m: over the last of ten turns, with so many steps each.
double radius_of_circle(int steps) {
  const double omega = 4 * std::numbers::pi, speed = 4 / omega, turns = 10;
  const std::string text = fmt::format(R"(
dimension = 3
gravity = [0, 0, -9.81]
density = 2600
blocks = [{{ name = "base", box = {{ min = [-9, -9, -1], max = [9, 9, 0] }}, fixed = true }},
          {{ name = "block", box = {{ min = [-1, -1, 0], max = [1, 1, 2] }} }}]
joint_properties = [{{ name = "rock", normal_stiffness = 1e12, shear_stiffness = 1e12, friction_deg = 16.69924423399362 }}]
restrain = [{{ bodies = ["block"], rotation = true }}]
[[stage]]
name = "settle"
kind = "settle"
gravity_ramp_s = 0.2
[[stage]]
name = "shake"
kind = "run"
duration_s = {0}
time = {{ integration = "implicit", step_s = {1:.17g} }}
)",
                                       turns / 2, 0.5 / steps);
  Prepared<3> scene = scene_of<3>(text);
  // two records make the circle: a factor has one phase for all directions
  std::vector<double> east, north;
  constexpr int samples = 4000;
  for (int i = 0; i <= samples * turns; ++i) {
    const double angle = 2 * std::numbers::pi * i / samples;
    east.push_back(speed * std::cos(angle));
    north.push_back(speed * std::sin(angle));
  }
  const double interval = 0.5 / samples;
  MovePlan circle;
  circle.bodies.names = {"base"};
  circle.velocity = {0, 0, 0};
  const auto record = [&](const std::vector<double>& values) {
    return std::make_shared<const GroundMotion>(make_ground_motion(MotionQuantity::velocity, interval, values, {}));
  };
  circle.records = {{{1, 0, 0}, record(east)}, {{0, 1, 0}, record(north)}};
  scene.stages[1].change.move = {circle};
  std::vector<Vector<2>> places;  // of the last turn
  double started = 0;
  Watcher<3> watcher;
  watcher.pause = [&](const Progress<3>& now) {
    if (now.stage == 0) started = now.state.schedule.time;
    if (now.state.schedule.time < started + (turns - 1) / 2 - 1e-9) return false;
    const Vector<2> apart =
        (now.state.bodies.motions[1].displacement - now.state.bodies.motions[0].displacement).head<2>();
    places.push_back(apart);
    return false;
  };
  expect_sound(simulated(scene, watcher));
  Vector<2> centre = Vector<2>::Zero();
  for (const Vector<2>& p : places)
    centre += p / static_cast<double>(places.size());
  double radius = 0;
  for (const Vector<2>& p : places)
    radius += (p - centre).norm() / static_cast<double>(places.size());
  EXPECT_EQ(places.size(), static_cast<std::size_t>(steps));
  return radius;
}

TEST(ImplicitStep, ABlockOnAPlaneThatCirclesIsOfSecondOrder) {
  const double a = 4, mu = 0.3, omega = 4 * std::numbers::pi;
  const double radius = std::sqrt(a * a - mu * mu * g * g) / (omega * omega);
  double last = 0;
  for (const int steps : {20, 40, 80}) {
    const double error = radius_of_circle(steps) / radius - 1;
    if (last > 0) EXPECT_NEAR(std::log2(last / error), 2, 0.1) << steps;
    if (steps == 40) EXPECT_NEAR(error, 0, 1.3e-3);
    last = error;
  }
}

// ---- blocks of three sizes ------------------------------------------------------------------------------------------

// 1, 0.03 and 0.001 m high, dropped together by 20 mm; the explicit limit is 16 µs
TEST(ImplicitStep, AColumnThatDropsNeverGainsEnergy) {
  std::string blocks;
  double height = 0.02, mass = 0;
  for (const double size : {1.0, 0.001, 0.03, 0.001, 1.0, 0.03}) {
    blocks += fmt::format(", {{ name = \"h{0}\", box = {{ min = [0, {1:.17g}], max = [1, {2:.17g}] }} }}",
                          blocks.size(), height, height + size);
    height += size;
    mass += 2600 * size;
  }
  for (const double h : {0.1e-3, 2e-3, 10e-3, 20e-3}) {
    const Prepared<2> scene = scene_of<2>(fmt::format(R"(
dimension = 2
gravity = [0, -9.81]
density = 2600
blocks = [{{ name = "base", box = {{ min = [-2, -1], max = [3, 0] }}, fixed = true }}{0}]
joint_properties = [{{ name = "rock", normal_stiffness = 1e10, shear_stiffness = 1e10, friction_deg = 30 }}]
[[stage]]
name = "drop"
kind = "run"
duration_s = 0.12
damping = {{ local = 0, viscous_ratio = 0.1 }}
time = {{ integration = "implicit", step_s = {1} }}
)",
                                                      blocks, h));
    const Followed<2> run = followed(scene);
    EXPECT_EQ(run.end.results.outcome, Outcome::done) << run.end.results.message;
    EXPECT_LE(run.energy.most, run.energy.start + 1e-12 * mass * g * 0.02) << h;
    EXPECT_LE(run.energy.growth, 1e-12 * mass * g * 0.02) << h;
    if (h > 1e-3) EXPECT_LT(run.energy.end, run.energy.start - 0.9 * mass * g * 0.02) << h;
    EXPECT_LT(run.end.state.ledger.energy.relative_error(), 1e-10) << h;
  }
}

// ---- a turntable ----------------------------------------------------------------------------------------------------

// A block held by friction on a plate that turns once in four seconds: its joint's shear turns with it, so that the
// block stays as far out as the joint's elasticity lets it, turn after turn.
TEST(ImplicitStep, ShearTurnsWithTheBodies) {
  const double rate = std::numbers::pi / 2, out = 2, stiffness = 2e6, mass = 520;
  const Prepared<3> scene = scene_of<3>(fmt::format(R"(
dimension = 3
gravity = [0, 0, -9.81]
density = 2600
blocks = [{{ name = "plate", box = {{ min = [-5, -5, -1], max = [5, 5, 0] }}, fixed = true }},
          {{ name = "block", box = {{ min = [1.5, -0.5, 0], max = [2.5, 0.5, 0.2] }} }}]
joint_properties = [{{ name = "rock", normal_stiffness = 1e10, shear_stiffness = {0}, friction_deg = 60 }}]
[[stage]]
name = "settle"
kind = "settle"
gravity_ramp_s = 0.2
[[stage]]
name = "turn"
kind = "run"
duration_s = 17
damping = {{ local = 0, joint_ratio = 0.1, joint_frequency_hz = 5 }}
time = {{ integration = "implicit", step_s = 0.025 }}
[[stage.move]]
bodies = ["plate"]
velocity = [0, 0, 0]
angular_velocity = [0, 0, {1:.17g}]
times_s = [0, 2, 17]
factors = [0, 1, 1]
)",
                                                    stiffness, rate));
  const Progress<3> end = whole_run(scene);
  const Vector<3> moved = end.state.bodies.motions[1].displacement;
  const double radius = std::hypot(out + moved[0], moved[1]);
  // k (r - 2 m) = m ω² r on 1 m²
  const double expected = out / (1 - mass * rate * rate / stiffness);
  EXPECT_NEAR(radius - out, expected - out, 0.02 * (expected - out));
}

// ---- what every run keeps -------------------------------------------------------------------------------------------

TEST(ImplicitStep, AResumedRunHasTheSameBits) {
  const Prepared<2> scene = shaken(1e12, "error_m = 1e-5");
  const Progress<2> whole = whole_run(scene), resumed = continued(scene, 90);
  EXPECT_EQ(whole.results.state_hash, resumed.results.state_hash);
  EXPECT_EQ(whole.state.counters.contact_evaluations, resumed.state.counters.contact_evaluations);
}

TEST(ImplicitStep, RefusesWhatItDoesNotFollow) {
  const auto message = [](const std::vector<std::string>& overrides) {
    return simulated(prepare<2>(parse_scene(shaken_text(1e12, "error_m = 1e-5"), "scene.toml", overrides)))
        .results.message;
  };
  EXPECT_NE(message({"joint_properties.rock.sub_contacts=4"}).find("leave it out"), std::string::npos);
  EXPECT_NE(message({"joint_properties.rock.cohesion=1e5"}).find("law beyond elastic springs"), std::string::npos);
  EXPECT_NE(message({"stage.shake.damping.local=0.5"}).find("damping.local = 0"), std::string::npos);
}

}  // namespace
}  // namespace voussoir::implicit_step_test
