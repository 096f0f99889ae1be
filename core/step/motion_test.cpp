// Motion of one body against closed forms, and the stable time step against the full system's eigenvalues.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <set>

#include "core/base/floating_point_traps.hpp"
#include "core/step/integrate.hpp"
#include "core/step/time_step.hpp"
#include "core/testing/assemblies.hpp"

namespace voussoir::motion_test {
namespace {

using shapes::Random;
using shapes::RandomAssembly;

// rounding errors of 1e5 steps add up like a random walk: 1e5^(1/2) ulp, with a margin
constexpr double conserved = 1e-12;

// results of a few steps: some ulp
constexpr double rounding = 1e-13;

template <int Dim>
Body<Dim> body_of(const HalfSpaces<Dim>& planes, double density = 2500) {
  return make_body<Dim>({shapes::block<Dim>(planes)}, density);
}

// moments of inertia all different, principal axes oblique
Body<3> askew_brick(Random& random) {
  return body_of<3>(shapes::placed<3>(shapes::box<3>({-1, -0.6, -0.3}, {1, 0.6, 0.3}),
                                      matrix(shapes::orientation<3>(random)), {0.3, -0.2, 0.1}));
}

Vector<3> world_momentum(const Body<3>& body, const Motion<3>& m) {
  return matrix(m.rotation) * body.principal_axes * m.angular_momentum;
}

double spin_energy(const Body<3>& body, const Motion<3>& m) {
  return 0.5 * m.angular_momentum.cwiseAbs2().cwiseQuotient(body.inertia).sum();
}

// ---- translation ----------------------------------------------------------------------------------------------------

template <int Dim>
void expect_exact_projectile() {
  const Body<Dim> body = body_of<Dim>(shapes::cube<Dim>(0.5));
  Load<Dim> load;
  Vector<Dim> g = Vector<Dim>::Zero();
  g[Dim - 1] = -9.81;
  load.force = body.mass * g;
  Motion<Dim> motion;
  const Vector<Dim> v0 = Vector<Dim>::Constant(3);
  motion.velocity = v0;
  // steps of changing length: the first half kick starts from velocities given at t = 0
  double time = 0, last = 0;
  for (int i = 0; i < 100; ++i) {
    const double dt = 0.01 * (1 + i % 3);
    advance<Dim>(body, load, {}, {0.5 * (last + dt), dt}, motion);
    time += dt;
    last = dt;
    EXPECT_LT((motion.displacement - (v0 * time + 0.5 * g * time * time)).norm(), rounding * 20);
  }
}

TEST(Advance, AProjectileIsExact) {
  expect_exact_projectile<3>();
  expect_exact_projectile<2>();
}

TEST(Advance, ASpringIsOfSecondOrder) {
  const Body<2> body = body_of<2>(shapes::cube<2>(0.5), 1);
  double error[2];
  for (int refined = 0; refined < 2; ++refined) {
    const int steps = refined ? 400 : 200;
    const double dt = 2.0 / steps;
    Motion<2> motion;
    motion.displacement = {1, 0};
    for (int i = 0; i < steps; ++i) {
      Load<2> load;
      load.force = -body.mass * motion.displacement;
      advance<2>(body, load, {}, {i == 0 ? 0.5 * dt : dt, dt}, motion);
    }
    error[refined] = std::abs(motion.displacement[0] - std::cos(2.0));
  }
  EXPECT_NEAR(error[0] / error[1], 4, 0.1);
}

TEST(Advance, RestrainedDirectionsDoNotMove) {
  Random random(41);
  Body<3> body = askew_brick(random);
  body.free_translation = {true, false, true};
  body.free_rotation.fill(false);
  Motion<3> motion;
  Load<3> load{{1, 2, 3}, {4, 5, 6}};
  advance<3>(body, load, {0.7}, {0.1, 0.1}, motion);
  EXPECT_EQ(motion.displacement[1], 0);
  EXPECT_NEAR(motion.displacement[0], 0.01 / body.mass, rounding);
  EXPECT_EQ(motion.angular_momentum, Vector<3>::Zero());
  EXPECT_EQ(motion.rotation.quaternion.w(), 1);
}

TEST(Damped, ReducesDrivingForcesAndIncreasesBrakingOnes) {
  EXPECT_EQ(damped(10, 0, 0.7), 10);
  EXPECT_NEAR(damped(10, 1e-300, 0.7), 3, rounding);
  EXPECT_NEAR(damped(10, -5, 0.7), 17, rounding);
  EXPECT_NEAR(damped(-10, 5, 0.7), -17, rounding);
  EXPECT_NEAR(damped(-10, -5, 0.7), -3, rounding);
  EXPECT_EQ(damped(-10, 5, 0), -10);
  // creates no energy: the power of the damping force is not positive
  for (const double f : {-2.0, 0.0, 2.0})
    for (const double v : {-3.0, 3.0})
      EXPECT_LE((damped(f, v, 0.7) - f) * v, 0);
}

// ---- rotation -------------------------------------------------------------------------------------------------------

TEST(Rotation, TorqueFreeMomentumIsConservedAndEnergyBounded) {
  Random random(42);
  const Body<3> body = askew_brick(random);
  Motion<3> motion;
  // close to the unstable middle axis: it tumbles
  motion.angular_momentum = body.inertia.cwiseProduct(Vector<3>(0.02, 3, 0.01));
  const Vector<3> momentum = world_momentum(body, motion);
  const double energy = spin_energy(body, motion), dt = 0.01;
  double lowest = energy, highest = energy, swing = 0;
  for (int i = 0; i < 100'000; ++i) {
    advance<3>(body, {}, {}, {dt, dt}, motion);
    lowest = std::min(lowest, spin_energy(body, motion));
    highest = std::max(highest, spin_energy(body, motion));
    swing = std::max(swing, std::abs(motion.angular_momentum[0]) / momentum.norm());
  }
  EXPECT_GT(swing, 0.3);
  EXPECT_LT((world_momentum(body, motion) - momentum).norm(), conserved * momentum.norm());
  EXPECT_NEAR(motion.rotation.quaternion.norm(), 1, 1e-15);
  // (ω dt)² = 9e-4 is the order of the method's own energy error; without drift it never exceeds it
  EXPECT_LT(highest - lowest, 9e-4 * energy);
}

// Euler's equations by the classical Runge-Kutta method with small steps
Rotation<3> tumbled(const Body<3>& body, const Motion<3>& start, double time, int steps) {
  Matrix<3> axes = matrix(start.rotation) * body.principal_axes;
  const Vector<3> momentum = axes * start.angular_momentum;
  const auto rate = [&](const Matrix<3>& a) {
    const Vector<3> w = a * (a.transpose() * momentum).cwiseQuotient(body.inertia);
    Matrix<3> k;
    k << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
    return Matrix<3>(k * a);
  };
  const double h = time / steps;
  for (int i = 0; i < steps; ++i) {
    const Matrix<3> k1 = rate(axes), k2 = rate(axes + h / 2 * k1), k3 = rate(axes + h / 2 * k2),
                    k4 = rate(axes + h * k3);
    axes += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return {Eigen::Quaterniond(Matrix<3>(axes * body.principal_axes.transpose()))};
}

TEST(Rotation, TumblingIsOfSecondOrder) {
  Random random(43);
  for (int trial = 0; trial < 5; ++trial) {
    const Body<3> body = askew_brick(random);
    Motion<3> start;
    start.rotation = shapes::orientation<3>(random);
    start.angular_momentum = body.inertia.cwiseProduct(shapes::normal_vector<3>(random));
    const Matrix<3> expected = matrix(tumbled(body, start, 2, 20'000));
    double error[2];
    for (int refined = 0; refined < 2; ++refined) {
      const int steps = refined ? 400 : 200;
      Motion<3> motion = start;
      for (int i = 0; i < steps; ++i)
        advance<3>(body, {}, {}, {2.0 / steps, 2.0 / steps}, motion);
      error[refined] = (matrix(motion.rotation) - expected).norm();
    }
    EXPECT_LT(error[0], 0.01);
    EXPECT_NEAR(error[0] / error[1], 4, 0.2);
  }
}

TEST(Rotation, ASymmetricTopPrecessesExactly) {
  // symmetric about the body's z axis; momentum oblique: the axis precesses about the momentum at |L| / I
  const Body<3> body = body_of<3>(shapes::box<3>({-0.5, -0.5, -1}, {0.5, 0.5, 1}), 1000);
  Motion<3> motion;
  const Vector<3> momentum = body.inertia[0] * Vector<3>(1, 0, 2);
  motion.angular_momentum = momentum;
  const double dt = 1e-3;
  for (int i = 0; i < 1000; ++i)
    advance<3>(body, {}, {}, {dt, dt}, motion);
  const Eigen::AngleAxisd precession(momentum.norm() / body.inertia[0], momentum.normalized());
  const Vector<3> axis = matrix(motion.rotation).col(2);
  EXPECT_LT((axis - precession * Vector<3>::UnitZ()).norm(), 1e-6);  // (|ω| dt)²/4 with |ω| about 2
}

TEST(Rotation, InThePlaneAConstantMomentIsExact) {
  const Body<2> body = body_of<2>(shapes::cube<2>(0.5));
  Motion<2> motion;
  Load<2> load;
  load.moment = Spin<2>(3);
  const double dt = 0.01;
  for (int i = 0; i < 100; ++i)
    advance<2>(body, load, {}, {i == 0 ? 0.5 * dt : dt, dt}, motion);
  EXPECT_NEAR(motion.rotation.angle, 0.5 * 3 / body.inertia[0], rounding);
  EXPECT_NEAR(body.inertia[0], 2500.0 / 6, 1e-9);
}

TEST(Rotation, AboutOneFreeAxisOnlyThatMomentCounts) {
  Random random(44);
  for (int axis = 0; axis < 3; ++axis) {
    Body<3> body = askew_brick(random);
    body.free_rotation.fill(false);
    body.free_rotation[axis] = true;
    const Matrix<3> tensor = body.principal_axes * body.inertia.asDiagonal() * body.principal_axes.transpose();
    Motion<3> motion;
    const Load<3> load{Vector<3>::Zero(), {300, 200, 100}};
    const double dt = 0.01;
    for (int i = 0; i < 100; ++i)
      advance<3>(body, load, {}, {i == 0 ? 0.5 * dt : dt, dt}, motion);
    // rotation about an axis does not change the moment of inertia about it
    const Vector<3> expected = 0.5 * load.moment[axis] / tensor(axis, axis) * Vector<3>::Unit(axis);
    EXPECT_LT((rotation_vector(motion.rotation) - expected).norm(), 10 * rounding);
    // the velocity is half a step behind
    EXPECT_LT((angular_velocity(body, motion) - 2 * (1 - dt / 2) * expected).norm(), 10 * rounding);
  }
}

TEST(Rotation, AboutTwoFreeAxesTheFreeBlockDecides) {
  Random random(45);
  Body<3> body = askew_brick(random);
  body.free_rotation = {true, true, false};
  const Matrix<3> tensor = body.principal_axes * body.inertia.asDiagonal() * body.principal_axes.transpose();
  Motion<3> motion;
  const Load<3> load{Vector<3>::Zero(), {300, 200, 100}};
  advance<3>(body, load, {}, {0.01, 0.01}, motion);
  const Vector<2> spin = 0.01 * tensor.topLeftCorner<2, 2>().ldlt().solve(load.moment.head<2>());
  EXPECT_LT((rotation_vector(motion.rotation) - 0.01 * Vector<3>(spin[0], spin[1], 0)).norm(), rounding);
}

// ---- equilibrium -------
// ----------------------------------------------------------------------------------------------------

TEST(Unbalanced, ComparesForceAndMomentumWithTheContacts) {
  Model<2> model;
  model.bodies = {body_of<2>(shapes::cube<2>(0.5)), body_of<2>(shapes::cube<2>(0.5))};
  model.bodies[0].fixed = true;
  list_parts(model);
  State<2> state = initial_state(model);
  EXPECT_EQ(unbalanced_ratio(model, 1, state), 0);
  state.loads.total[0].force = {1e9, 0};  // on the fixed one: no effect
  EXPECT_EQ(unbalanced_ratio(model, 1, state), 0);
  state.loads.total[1].force = {3, 4};
  EXPECT_EQ(unbalanced_ratio(model, 1, state), std::numeric_limits<double>::infinity());
  state.contacts.loads = {{}, {.second = 1, .force = {0, 50}}};
  EXPECT_NEAR(unbalanced_ratio(model, 1, state), 0.1, rounding);
  // momentum times frequency counts as force
  state.loads.total[1].force.setZero();
  state.bodies.motions[1].velocity = {2 / model.bodies[1].mass, 0};
  state.time_step.frequency = {0, 10};
  EXPECT_NEAR(unbalanced_ratio(model, 1, state), 0.4, rounding);
}

// ---- time step ------------------------------------------------------------------------------------------------------

// the 64th root of 1/6: six equally stiff modes
const double least_of_limit = std::pow(6, -1.0 / 64);

template <int Dim>
void expect_safe_time_step(std::uint64_t seed) {
  Random random(seed);
  double lowest = 1, highest = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const int free = shapes::integer(random, 1, 6), fixed = shapes::integer(random, 1, 3);
    RandomAssembly<Dim> assembly(random, free, fixed, free + shapes::integer(random, 0, 10));
    const double limit = 2 / std::sqrt(assembly.largest_eigenvalue());
    const double estimate = estimate_time_step(assembly.model, {}, {}, assembly.state.bodies, assembly.state.loads,
                                               assembly.state.contacts, assembly.state.time_step)
                                .limit;
    lowest = std::min(lowest, estimate / limit);
    highest = std::max(highest, estimate / limit);
  }
  EXPECT_LE(highest, 1 + rounding);
  EXPECT_GT(highest, 0.9);
  EXPECT_GE(lowest, least_of_limit / std::sqrt(2.0));
}

TEST(TimeStep, IsNeverAboveTheFullSystemsLimit3D) {
  expect_safe_time_step<3>(46);
}
TEST(TimeStep, IsNeverAboveTheFullSystemsLimit2D) {
  expect_safe_time_step<2>(47);
}

template <int Dim>
void expect_close_for_one_free_body(std::uint64_t seed) {
  Random random(seed);
  double mean = 0;
  for (int trial = 0; trial < 50; ++trial) {
    RandomAssembly<Dim> assembly(random, 1, 4, 6);
    for (Contact<Dim>& c : assembly.state.contacts.list)
      c.properties = 0;
    const double limit = 2 / std::sqrt(assembly.largest_eigenvalue());
    const TimeStepEstimate estimate =
        estimate_time_step(assembly.model, {}, {}, assembly.state.bodies, assembly.state.loads, assembly.state.contacts,
                           assembly.state.time_step);
    EXPECT_LE(estimate.limit / limit, 1 + 1e-9);
    EXPECT_GE(estimate.limit / limit, least_of_limit);
    mean += estimate.limit / limit / 50;
    EXPECT_NEAR(estimate.step, Settings{}.time.fraction * estimate.limit / std::sqrt(area_margin),
                1e-15 * estimate.limit);
    EXPECT_NEAR(assembly.state.time_step.frequency[0], 2 / estimate.limit,
                1e-9 * assembly.state.time_step.frequency[0]);
    for (const Contact<Dim>& c : assembly.state.contacts.list)
      EXPECT_NEAR(c.area_rated, area_margin * c.geometry.area, 1e-15);
  }
  EXPECT_GT(mean, 0.998);
}

TEST(TimeStep, IsABoundCloseToTheLimitWhenOneBodyIsFree) {
  expect_close_for_one_free_body<3>(48);
  expect_close_for_one_free_body<2>(49);
}

TEST(TimeStep, OnlyBodiesOfGrownContactsAreUpdated) {
  Random random(51);
  RandomAssembly<3> assembly(random, 6, 1, 12);
  const Model<3>& model = assembly.model;
  State<3>& state = assembly.state;
  estimate_time_step(model, {}, {}, state.bodies, state.loads, state.contacts, state.time_step);
  const std::vector<double> before = state.time_step.frequency;
  EXPECT_FALSE(renew_time_step(model, {}, {}, state.bodies, state.loads, state.contacts, state.time_step).has_value());

  // one contact outgrows its rating; all others grow too, but stay within theirs
  std::vector<double> rated;
  for (Contact<3>& c : state.contacts.list) {
    rated.push_back(c.area_rated);
    c.geometry.area *= &c == &state.contacts.list.front() ? 1.2 : 1.05;
  }
  State<3> whole = state;
  estimate_time_step(model, {}, {}, whole.bodies, whole.loads, whole.contacts, whole.time_step);
  ASSERT_TRUE(renew_time_step(model, {}, {}, state.bodies, state.loads, state.contacts, state.time_step).has_value());
  const std::set<int> asked{model.parts[state.contacts.list[0].part_a].body,
                            model.parts[state.contacts.list[0].part_b].body};
  int kept = 0;
  for (int b = 0; b < static_cast<int>(before.size()); ++b) {
    EXPECT_EQ(state.time_step.frequency[b], asked.contains(b) ? whole.time_step.frequency[b] : before[b]);
    kept += !asked.contains(b);
  }
  EXPECT_GE(kept, 5);
  // the rating on which a body relies that was not updated is unchanged
  for (std::size_t i = 0; i < rated.size(); ++i) {
    const Contact<3>& c = state.contacts.list[i];
    const auto counted = [&](int part) {
      const int body = model.parts[part].body;
      return asked.contains(body) || model.bodies[body].fixed;
    };
    EXPECT_EQ(c.area_rated, counted(c.part_a) && counted(c.part_b) ? whole.contacts.list[i].area_rated : rated[i]);
  }
}

TEST(TimeStep, TakesSettingsOrNothing) {
  Random random(50);
  RandomAssembly<3> assembly(random, 1, 1, 1);
  Settings settings;
  settings.time.step = 0.125;
  EXPECT_EQ(estimate_time_step(assembly.model, settings, {}, assembly.state.bodies, assembly.state.loads,
                               assembly.state.contacts, assembly.state.time_step)
                .step,
            0.125);
  // nothing free, nothing to rate
  assembly.model.bodies[0].fixed = true;
  const TimeStepEstimate still = estimate_time_step(assembly.model, {}, {}, assembly.state.bodies, assembly.state.loads,
                                                    assembly.state.contacts, assembly.state.time_step);
  EXPECT_EQ(still.limit, std::numeric_limits<double>::infinity());
  EXPECT_EQ(still.step, 0);
}

TEST(TimeStep, ACandidateOrAFlightHasAtMostTheStepOfItsContact) {
  // a cube above a plate: the estimate before the impact must not exceed the limit once the face is in contact
  for (const bool candidate : {true, false}) {
    Model<3> model;
    model.bodies = {body_of<3>(shapes::box<3>({-2, -2, -1}, {2, 2, 0})),
                    body_of<3>(shapes::box<3>({-0.5, -0.5, 0.1}, {0.5, 0.5, 1.1}))};
    model.bodies[0].fixed = true;
    list_parts(model);
    model.properties = {{"joint", 1e9, 2e9, 0.5, false}};
    State<3> state = initial_state(model);
    Contact<3> c;
    c.part_b = 1;
    c.status = ContactStatus::separated;
    if (candidate) shapes::set_contacts(model, {c}, state);
    const double before =
        estimate_time_step(model, {}, {}, state.bodies, state.loads, state.contacts, state.time_step).limit;
    c.status = ContactStatus::touching;
    c.geometry.point = {0, 0, 0.5};
    c.geometry.normal = {0, 0, 1};
    c.geometry.area = 1;
    shapes::set_contacts(model, {c}, state);
    EXPECT_LT(before,
              estimate_time_step(model, {}, {}, state.bodies, state.loads, state.contacts, state.time_step).limit);
  }
}

TEST(TimeStep, WithADashpotTheLimitIsThatOfStability) {
  // one degree of freedom, spring and dashpot at the lagged velocity: bounded below 2 (sqrt(1 + ξ²) - ξ)/ω, unbounded
  // above
  const WithoutTraps without_traps;
  Model<2> model;
  model.bodies = {body_of<2>(shapes::cube<2>(0.5)), body_of<2>(shapes::cube<2>(0.5))};
  model.bodies[1].fixed = true;
  model.bodies[0].free_rotation.fill(false);
  list_parts(model);
  model.properties = {{"joint", 1e9, 0, 0.5, true}};
  State<2> state = initial_state(model);
  Contact<2> c;
  c.part_b = 1;
  c.status = ContactStatus::touching;
  c.geometry.normal = {1, 0};
  shapes::set_contacts(model, {c}, state);
  const Body<2>& body = model.bodies[0];
  for (const double xi : {0.0, 0.1, 0.5, 1.0, 3.0}) {
    const double limit = estimate_time_step(model, {}, {.local = 0, .viscous_ratio = xi}, state.bodies, state.loads,
                                            state.contacts, state.time_step)
                             .limit;
    const double dashpot = 2 * xi * std::sqrt(1e9 * body.mass);
    for (const double fraction : {0.99, 1.01}) {
      Motion<2> motion;
      motion.displacement = {1e-3, 0};
      double largest = 0;
      for (int i = 0; i < 3000; ++i) {
        Load<2> load;
        load.force[0] = -1e9 * motion.displacement[0] - dashpot * motion.velocity[0];
        advance<2>(body, load, {}, {fraction * limit, fraction * limit}, motion);
        largest = std::max(largest, std::abs(motion.displacement[0]));
      }
      EXPECT_EQ(largest < 1, fraction < 1) << "damping ratio " << xi << ", fraction of the limit " << fraction;
    }
  }
}

}  // namespace
}  // namespace voussoir::motion_test
