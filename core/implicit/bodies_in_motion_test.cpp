// Bodies moved by implicit steps: free rotation, two bodies that stick to each other in space, a plank that tips under
// a block, a float held by friction, a column of thick and thin blocks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/testing/implicit_runs.hpp"
#include "core/testing/models.hpp"
#include "text/angle.hpp"

namespace voussoir::bodies_in_motion_test {
namespace {

constexpr double g = 9.81;

// ---- free rotation --------------------------------------------------------------------------------------------------

// moments of inertia of 1, 2 and 3 kg m², tumbling about the middle axis, for 20 s
const Spin<3> inertia(1, 2, 3), spin_at_start(0.02, 1, 0.01);

Prepared<3> tumbling(double h) {
  Prepared<3> scene = scene_of<3>(fmt::format(R"(
dimension = 3
density = 2000
blocks = [{{ name = "box", box = {{ min = [-1.5, -1, -0.5], max = [1.5, 1, 0.5] }} }}]
[[stage]]
name = "tumble"
kind = "run"
duration_s = 20
damping = {{ local = 0 }}
time = {{ integration = "implicit", step_s = {} }}
)",
                                              h));
  Body<3>& body = scene.model.bodies.front();
  body.inertia = inertia;
  body.principal_axes.setIdentity();
  scene.state.bodies.motions.front().angular_momentum = inertia.cwiseProduct(spin_at_start);
  return scene;
}

// the attitude after 20 s by Runge and Kutta's steps of fourth order, which share no code with the program
Matrix<3> attitude_by_small_steps() {
  using Attitude = Eigen::Matrix<double, 3, 4>;  // momentum in the body, then its axes
  const auto rate = [](const Attitude& y) {
    const Vector<3> momentum = y.col(0), spin = momentum.cwiseQuotient(inertia);
    Attitude change;
    change.col(0) = momentum.cross(spin);
    for (int k = 0; k < 3; ++k)
      change.col(1 + k) = y.rightCols<3>() * spin.cross(Vector<3>(Vector<3>::Unit(k)));
    return change;
  };
  Attitude y;
  y << inertia.cwiseProduct(spin_at_start), Matrix<3>::Identity();
  constexpr int steps = 4000;
  constexpr double h = 20.0 / steps;
  for (int i = 0; i < steps; ++i) {
    const Attitude a = rate(y), b = rate(y + 0.5 * h * a), c = rate(y + 0.5 * h * b), d = rate(y + h * c);
    y += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return y.rightCols<3>();
}

TEST(BodiesInMotion, FreeRotationKeepsEnergyAndMomentumAndIsOfSecondOrder) {
  const Matrix<3> exact = attitude_by_small_steps();
  double last = 0;
  for (const double h : {0.8, 0.1, 0.05, 0.025}) {
    SCOPED_TRACE(h);
    const Prepared<3> scene = tumbling(h);
    const Body<3>& body = scene.model.bodies.front();
    const Motion<3> start = scene.state.bodies.motions.front(), end = whole_run(scene).state.bodies.motions.front();
    EXPECT_NEAR(kinetic_energy(body, end), kinetic_energy(body, start), 1e-13 * kinetic_energy(body, start));
    const Matrix<3> turned = matrix(end.rotation);
    EXPECT_LT((turned * end.angular_momentum - start.angular_momentum).norm(), 1e-13 * start.angular_momentum.norm());
    const double off = Eigen::AngleAxisd(Matrix<3>(turned * exact.transpose())).angle();
    if (last > 0) EXPECT_NEAR(std::log2(last / off), 2, 0.05);
    if (h == 0.05) EXPECT_NEAR(off, 4.9e-3, 0.1e-3);
    last = h > 0.1 ? 0 : off;
  }
}

// ---- two bodies that stick to each other in space -------------------------------------------------------------------

// A cube between the jaws of a larger body, pressed by 0.1 mm on either side, without gravity; both turn and move on
// as if they were one body.
Prepared<3> cube_in_jaws(double h, double duration) {
  constexpr double pressed = 1e-4;
  Prepared<3> scene = scene_of<3>(fmt::format(R"(
dimension = 3
density = 2600
blocks = [{{ name = "cube", box = {{ min = [0, 0, 0], max = [1, 1, 1] }} }},
          {{ name = "jaws", box = {{ min = [-0.5, -0.6, {0}], max = [1.5, 1.4, 1.5] }} }},
          {{ name = "lower", part_of = "jaws", box = {{ min = [-0.5, -0.6, -0.7], max = [1.5, 1.4, {1}] }} }},
          {{ name = "back", part_of = "jaws", box = {{ min = [1.5, -0.6, -0.7], max = [1.8, 1.4, 1.5] }} }}]
joint_properties = [{{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 60 }}]
[[stage]]
name = "turn"
kind = "run"
duration_s = {2}
damping = {{ local = 0 }}
time = {{ integration = "implicit", step_s = {3:.17g} }}
)",
                                              1 - pressed, pressed, duration, h));
  const Spin<3> spin(0.2, 0.9, -0.4);
  const Vector<3> velocity(0.3, -0.2, 0.1);
  for (std::size_t b = 0; b < 2; ++b) {
    const Body<3>& body = scene.model.bodies[b];
    Motion<3>& m = scene.state.bodies.motions[b];
    m.velocity = velocity + spin.cross(body.reference);
    m.angular_momentum = angular_momentum(body, m.rotation, spin);
  }
  return scene;
}

struct Momenta {
  Vector<3> momentum = Vector<3>::Zero(), moment = Vector<3>::Zero();  // N s, N m s about the origin
};
Momenta momenta_of(const Model<3>& model, const State<3>& state) {
  Momenta sum;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<3>& body = model.bodies[b];
    const Motion<3>& m = state.bodies.motions[b];
    const Vector<3> momentum = body.mass * m.velocity;
    sum.momentum += momentum;
    sum.moment += Vector<3>(body.reference + m.displacement).cross(momentum) +
                  matrix(m.rotation) * body.principal_axes * m.angular_momentum;
  }
  return sum;
}

// 200 steps of 4 explicit limits. Overlaps are counted from the geometry, so that energy errs by relative_error().
TEST(BodiesInMotion, TwoBodiesThatStickKeepTheirMomenta) {
  const double limit = 2 / std::sqrt(2 * 1e9 * (1 / 2600.0 + 1 / 14000.0)), h = 4 * limit;
  const Prepared<3> scene = cube_in_jaws(h, 200 * h);
  const Momenta start = momenta_of(scene.model, scene.state);
  const Followed<3> run = followed(scene);
  const State<3>& state = run.end.state;
  EXPECT_EQ(state.counters.steps, 200);
  const Momenta end = momenta_of(scene.model, state);
  EXPECT_LT((end.momentum - start.momentum).norm(), 1e-12 * start.momentum.norm());
  EXPECT_LT((end.moment - start.moment).norm(), 1e-12 * start.moment.norm());
  const EnergyBalance& energy = state.ledger.energy;
  EXPECT_NEAR(energy.flows[Source::friction], 0, 1e-12 * run.energy.start);
  const double lost = energy.flows[Source::unresolved_springs] + energy.flows[Source::unresolved_motion];
  EXPECT_LE(std::abs(run.energy.end - run.energy.start + lost),
            1e-12 * run.energy.start + 1.001 * energy.relative_error() * energy.largest_energy);
  EXPECT_LT(energy.relative_error(), 1e-6);
}

// ---- a plank that tips ----------------------------------------------------------------------------------------------

// A body of these parts in the frame of its stated centroid, with stated mass and moment of inertia.
void replace_parts(Body<2>& body, const Vector<2>& reference, double mass, double moment_of_inertia) {
  const Vector<2> shift = body.reference - reference;
  body.radius = 0;
  for (Polytope<2>& part : body.parts) {
    HalfSpaces<2> faces = part.faces;
    for (HalfSpace<2>& face : faces)
      face.offset += face.normal.dot(shift);
    part = shapes::block<2>(faces);
    for (const Vector<2>& v : part.vertices)
      body.radius = std::max(body.radius, v.norm());
  }
  body.reference = reference;
  body.mass = mass;
  body.inertia[0] = moment_of_inertia;
}

// A plank of 4 m on two feet, 1 m apart; a block of 4 t on it, also on two feet, beyond the right one: the plank tips
// and the block slides down it. Feet are edges that press on faces at points of 1e9 N/m.
Prepared<2> plank(double friction, const std::string& normal, const std::string& time) {
  constexpr double foot = 0.1;  // m high
  Prepared<2> scene =
      scene_of<2>(fmt::format(R"(
dimension = 2
gravity = [0, -9.81]
density = 2600
blocks = [{{ name = "ground", box = {{ min = [-0.6, -1], max = [0.6, 0] }}, fixed = true }},
          {{ name = "plank", box = {{ min = [-3, {0}], max = [3, 0.4] }} }},
          {{ name = "left", part_of = "plank", vertices = [[-0.5, 0], [-0.55, {0}], [-0.45, {0}]] }},
          {{ name = "right", part_of = "plank", vertices = [[0.5, 0], [0.45, {0}], [0.55, {0}]] }},
          {{ name = "block", box = {{ min = [0.9, {1}], max = [1.5, 1] }} }},
          {{ name = "rear", part_of = "block", vertices = [[0.9, 0.4], [0.9, {1}], [1, {1}]] }},
          {{ name = "front", part_of = "block", vertices = [[1.5, 0.4], [1.4, {1}], [1.5, {1}]] }}]
joint_properties = [{{ name = "foot", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = {2:.17g}, constant_stiffness = true }},
                    {{ name = "plank", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = {3:.17g}, constant_stiffness = true }}]
contact = {{ face = "point", normal = "{4}" }}
[[stage]]
name = "tip"
kind = "run"
duration_s = 0.9
damping = {{ local = 0 }}
time = {{ {5} }}
)",
                              foot, 0.4 + foot, std::atan(0.8) / degree, std::atan(friction) / degree, normal, time));
  Model<2>& model = scene.model;
  const int of_plank = shapes::index_of(model, "plank"), of_block = shapes::index_of(model, "block");
  replace_parts(model.bodies[of_plank], {0, 0.2}, 4160, 4160 * (16 + 0.16) / 12);
  replace_parts(model.bodies[of_block], {1.2, 0.7}, 4000, 4000 * 0.72 / 12);
  // the joint of the block's faces, with the plank's friction
  model.joints.push_back({.name = "block", .plane = {Vector<2>(0, 1), 0}, .properties = 1});
  for (Polytope<2>& part : model.bodies[of_block].parts)
    part.joints.assign(part.faces.size(), static_cast<int>(model.joints.size()) - 1);
  return scene;
}

std::string implicit_steps_of(double h) {
  return fmt::format("integration = \"implicit\", step_s = {}", h);
}

// Of steps of 20 ms energy is exact but for what edges that turn leave of it, which relative_error() has.
TEST(BodiesInMotion, APlankThatTipsNeverGainsEnergy) {
  for (const double friction : {0.3, 0.0})
    for (const double h : {1e-3, 5e-3, 20e-3}) {
      SCOPED_TRACE(fmt::format("friction {} h {}", friction, h));
      const Prepared<2> scene = plank(friction, "multipliers", implicit_steps_of(h));
      const Followed<2> run = followed(scene);
      EXPECT_EQ(run.end.results.outcome, Outcome::done) << run.end.results.message;
      const double scale = 4000 * g * 0.5;  // J: of the motion
      const EnergyBalance& energy = run.end.state.ledger.energy;
      const double geometry = h > 5e-3 ? energy.relative_error() * energy.largest_energy : 0;
      EXPECT_LE(run.energy.growth, 1e-12 * scale + geometry);
      const Counters& cost = run.end.state.counters;
      EXPECT_LE(cost.implicit_iterations, 7 * cost.implicit_solutions);
      const Motion<2>& m = run.end.state.bodies.motions[shapes::index_of(scene.model, "plank")];
      EXPECT_LT(m.rotation.angle, -15 * degree);
    }
}

// Where the plank is depends on the law of an edge on a face, by which the two normals differ by a degree, but not on
// the kind of steps: implicit ones of 1 ms err by 0.03 degrees.
TEST(BodiesInMotion, APlankThatTipsIsWhereExplicitStepsLeaveIt) {
  for (const char* normal : {"multipliers", "potential"})
    for (const double friction : {0.3, 0.0}) {
      SCOPED_TRACE(fmt::format("normal {} friction {}", normal, friction));
      const auto angle = [&](const std::string& time) {
        const Prepared<2> scene = plank(friction, normal, time);
        const State<2> end = whole_run(scene).state;
        return end.bodies.motions[shapes::index_of(scene.model, "plank")].rotation.angle / degree;
      };
      const double expected = angle("step_s = 2e-5");
      EXPECT_NEAR(angle(implicit_steps_of(1e-3)), expected, 0.04);
      EXPECT_NEAR(angle(implicit_steps_of(1e-4)), expected, 0.002);
    }
}

// ---- a mass on a spring with friction -------------------------------------------------------------------------------

// A float between two walls that press on it, 75.5 mm above its draught: water is a spring of 9810 N/m, friction takes
// 2 d = 9.81 mm of its amplitude in each half swing, and it rests after eight of them at -2.98 mm.
double rests_at(double h) {
  constexpr double width = 1, draught = 0.0981, start = 0.0755, water = 1000 * g, mass = 1000 * draught;
  constexpr double friction = 0.5, normal_stiffness = 1e8, shear_stiffness = 4.905e8;
  const double normal = 4.905e-3 * water / (2 * friction), pressed = normal / normal_stiffness;
  const Prepared<2> scene =
      scene_of<2>(fmt::format(R"(
dimension = 2
gravity = [0, -9.81]
density = {0}
blocks = [{{ name = "float", box = {{ min = [0, {1:.17g}], max = [{2}, {3:.17g}] }} }},
          {{ name = "left", box = {{ min = [-1, -1], max = [{4:.17g}, 2] }}, fixed = true }},
          {{ name = "right", box = {{ min = [{5:.17g}, -1], max = [2, 2] }}, fixed = true }}]
joint_properties = [{{ name = "wall", normal_stiffness = {6}, shear_stiffness = {7}, friction_deg = {8:.17g}, constant_stiffness = true }}]
restrain = [{{ bodies = ["float"], rotation = true, translation = ["x"] }}]
contact = {{ face = "point" }}
water = [{{ name = "lake", level = 0 }}]
[[stage]]
name = "heave"
kind = "run"
duration_s = 5
damping = {{ local = 0 }}
time = {{ integration = "implicit", step_s = {9:.17g} }}
)",
                              mass, start - draught, width, start - draught + 1, pressed, width - pressed,
                              normal_stiffness, shear_stiffness, std::atan(friction) / degree, h));
  const Progress<2> end = whole_run(scene);
  const Motion<2>& m = end.state.bodies.motions[shapes::index_of(scene.model, "float")];
  EXPECT_LT(m.velocity.norm(), 1e-6);
  return start + m.displacement[1];
}

// A reversal that falls within a step, at τ, has one force of friction for all of it. The acceleration jumps by j = 2
// μN/m = 0.981 m/s² there: the block is displaced by up to j h²/8, and its speed is off by up to j τ when it has (h -
// τ) A ω², which changes the amplitude by j τ (h - τ) <= j h²/4. Eight reversals: whether 2 or 40 micrometres at 6.3 ms
// depends on where in their steps they fall.
TEST(BodiesInMotion, AFloatHeldByFrictionRestsWhereItShould) {
  const double limit = 2 / std::sqrt(1e7), jump = 2 * 4.905e-3 * 100, elastic = 4.905e-3 * 100 / 1e7;
  for (const double limits : {10.0, 4.0, 1.0}) {
    const double h = limits * limit;
    EXPECT_NEAR(rests_at(h), -2.98e-3, 8 * jump * h * h * (0.25 + 0.125) + elastic) << limits;
  }
}

// ---- a column of thick and thin blocks ------------------------------------------------------------------------------

// 1, 0.03 and 0.001 m high, on a base that is shaken up and down so that no joint opens
Prepared<2> column(const std::string& time, double duration) {
  std::string blocks;
  double height = 0;
  for (const double size : {0.001, 1.0, 1.0, 1.0, 0.001, 0.001, 0.03, 1.0, 0.03, 0.001}) {
    blocks += fmt::format(", {{ name = \"h{0}\", box = {{ min = [0, {1:.17g}], max = [1, {2:.17g}] }} }}",
                          blocks.size(), height, height + size);
    height += size;
  }
  blocks +=
      fmt::format(", {{ name = \"top\", box = {{ min = [0, {0:.17g}], max = [1, {1:.17g}] }} }}", height, height + 1);
  return scene_of<2>(fmt::format(R"(
dimension = 2
gravity = [0, -9.81]
density = 2600
blocks = [{{ name = "base", box = {{ min = [-2, -1], max = [3, 0] }}, fixed = true }}{0}]
joint_properties = [{{ name = "rock", normal_stiffness = 1e10, shear_stiffness = 1e10, friction_deg = 30 }}]
[[stage]]
name = "settle"
kind = "settle"
gravity_ramp_s = 0.1
[[stage]]
name = "shake"
kind = "run"
duration_s = {1}
damping = {{ local = 0, viscous_ratio = 0.1 }}
time = {{ {2} }}
[[stage.move]]
bodies = ["base"]
velocity = [0, 0.4684]
frequency_hz = 2
times_s = [0, 0.5, 2]
factors = [0, 1, 1]
)",
                                 blocks, duration, time));
}

// m: of the top against the base; evaluations of the contacts in the shaking
struct Shaken {
  double sinking = 0;
  long long evaluations = 0;
};
Shaken shaken(const std::string& time, double duration) {
  const Prepared<2> scene = column(time, duration);
  long long settled = 0;
  Watcher<2> watcher;
  watcher.pause = [&](const Progress<2>& now) {
    if (now.stage == 0) settled = now.state.counters.contact_evaluations;
    return false;
  };
  const Progress<2> end = simulated(scene, watcher);
  EXPECT_EQ(end.results.outcome, Outcome::done) << end.results.message;
  const std::vector<Motion<2>>& m = end.state.bodies.motions;
  return {m[shapes::index_of(scene.model, "top")].displacement[1] -
              m[shapes::index_of(scene.model, "base")].displacement[1],
          end.state.counters.contact_evaluations - settled};
}

TEST(BodiesInMotion, ThinBlocksCostNoSteps) {
  const double duration = 1.2, briefly = 2e-3, fraction = 0.9;
  const Shaken large = shaken("integration = \"implicit\", step_s = 5e-3", duration),
               small = shaken("integration = \"implicit\", step_s = 1e-3", duration),
               explicit_steps = shaken(fmt::format("fraction = {}", fraction), briefly);
  EXPECT_NEAR(large.sinking, small.sinking, 0.05 * std::abs(small.sinking));
  // at the limit of the explicit step
  const double at_limit = fraction * static_cast<double>(explicit_steps.evaluations) * duration / briefly;
  EXPECT_GT(at_limit, 100 * static_cast<double>(large.evaluations));
}

}  // namespace
}  // namespace voussoir::bodies_in_motion_test
