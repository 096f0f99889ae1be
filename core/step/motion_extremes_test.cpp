// Rotation, energy, creep and the time step at their extremes. Suites named …Long contain the long versions of the
// tests before them (`make test-long`).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/joint_laws/elastic_coulomb.hpp"
#include "core/step/integrate.hpp"
#include "core/step/time_step.hpp"
#include "core/testing/assemblies.hpp"

namespace voussoir::motion_extremes_test {
namespace {

using shapes::Random;
using shapes::RandomAssembly;

constexpr double pi = std::numbers::pi;

// each step rounds a quaternion a few times; a random walk of 1e7 rounding errors, with a margin
constexpr double turned_tolerance = 1e-10;  // rad

// ---- rotation -------------------------------------------------------------------------------------------------------

// angle between two orientations
double apart(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return 2 * std::asin(std::min(1.0, (a.conjugate() * b).vec().norm()));
}

// turning by `angle` about an axis, the angle reduced in long double
Eigen::Quaterniond turn(const Vector<3>& axis, long double angle) {
  const long double half = std::fmod(angle, 4 * std::numbers::pi_v<long double>) / 2;
  const Vector<3> v = static_cast<double>(std::sin(half)) * axis;
  return {static_cast<double>(std::cos(half)), v[0], v[1], v[2]};
}

void expect_constant_spin(std::uint64_t seed, long long steps) {
  Random random(seed);
  for (int axis = 0; axis < 3; ++axis) {
    Body<3> body = shapes::random_body<3>(random, {});
    Motion<3> motion;
    const double spin = 1.7, dt = 0.01;  // rad/s, s
    motion.angular_momentum[axis] = spin * body.inertia[axis];
    for (long long i = 0; i < steps; ++i)
      advance<3>(body, {}, {}, {dt, dt}, motion);
    const long double step_angle = dt * (motion.angular_momentum[axis] / body.inertia[axis]);
    const Eigen::Quaterniond expected = turn(body.principal_axes.col(axis), step_angle * steps);
    EXPECT_LT(apart(motion.rotation.quaternion, expected), turned_tolerance) << "axis " << axis;
  }
  // about any axis, as a body with restrained rotations rotates
  const Vector<3> axis = shapes::direction<3>(random);
  const Spin<3> step_turn = 0.017 * axis;
  Rotation<3> rotation;
  for (long long i = 0; i < steps; ++i)
    rotation = turned(rotation, step_turn);
  const long double step_angle = step_turn.cast<long double>().norm();
  EXPECT_LT(apart(rotation.quaternion, turn(step_turn.normalized(), step_angle * steps)), turned_tolerance);
}

TEST(MotionExtremes, AConstantSpinEndsAtItsAngle) {
  expect_constant_spin(81, 200'000);
}
TEST(MotionExtremesLong, AConstantSpinEndsAtItsAngleAfter1e7Steps) {
  expect_constant_spin(81, 10'000'000);
}

// In 2-D the angle is a sum: each of N additions rounds by at most half an ulp of the angle, in the same direction
// while the angle stays in one binade.
TEST(MotionExtremes, InThePlaneASpinLosesHalfAnUlpPerStepAtMost) {
  Random random(82);
  const Body<2> body = shapes::random_body<2>(random, {});
  Motion<2> motion;
  const double dt = 1e-3;
  const long long steps = 10'000'000;
  motion.angular_momentum[0] = 1e-3 * body.inertia[0];
  for (long long i = 0; i < steps; ++i)
    advance<2>(body, {}, {}, {dt, dt}, motion);
  const long double expected = static_cast<long double>(dt * motion.angular_momentum[0] / body.inertia[0]) * steps;
  const double ulp_of_angle = std::nextafter(motion.rotation.angle, 1e9) - motion.rotation.angle;
  EXPECT_NEAR(motion.rotation.angle, static_cast<double>(expected), 0.5 * ulp_of_angle * static_cast<double>(steps));
  EXPECT_NEAR(motion.rotation.angle, 10, 1e-8);
}

TEST(MotionExtremes, TumblingAboutTheUnstableAxisKeepsMomentumAndEnergy) {
  Random random(83);
  for (const double off : {1e-2, 1e-8, 0.0}) {
    Body<3> body = shapes::random_body<3>(random, {});
    body.inertia = {1, 2, 2.5};
    Motion<3> motion;
    motion.angular_momentum = body.inertia.cwiseProduct(Vector<3>(off, 3, off));
    const auto energy_of = [&] { return 0.5 * motion.angular_momentum.cwiseAbs2().cwiseQuotient(body.inertia).sum(); };
    const auto momentum_of = [&]() -> Vector<3> {
      return matrix(motion.rotation) * body.principal_axes * motion.angular_momentum;
    };
    const Vector<3> momentum = momentum_of();
    const double energy = energy_of(), dt = 0.01;
    const int steps = 500'000;
    double first = 0, last = 0, turned = 0, flips = 0;  // largest energy error in each half; rad
    bool up = true;
    for (int i = 0; i < steps; ++i) {
      advance<3>(body, {}, {}, {dt, dt}, motion);
      double& largest = i < steps / 2 ? first : last;
      largest = std::max(largest, std::abs(energy_of() / energy - 1));
      turned += 2 * dt * motion.angular_momentum.cwiseQuotient(body.inertia).lpNorm<1>();
      flips += up != (motion.angular_momentum[1] > 0);
      up = motion.angular_momentum[1] > 0;
    }
    EXPECT_NEAR(motion.angular_momentum.norm(), momentum.norm(), 1e-12 * momentum.norm()) << off;
    // the principal axes are orthonormal to rounding: the direction error per radian is of the same size
    EXPECT_LT((momentum_of() - momentum).norm(), (1e-12 + 2e-16 * turned) * momentum.norm()) << off;
    EXPECT_LE(std::max(first, last), std::pow(3 * dt, 2)) << off;  // (ω dt)²: the order of the method
    EXPECT_LE(last, 1.01 * first + 1e-12) << off;                  // bounded: no growth from half to half
    // it turns over again and again; exactly on the axis it does not
    if (off > 0) {
      EXPECT_GT(flips, 100);
    } else {
      EXPECT_EQ(flips, 0);
    }
  }
}

// ---- rotations of any size
// ----------------------------------------------------------------------------------------------

TEST(MotionExtremes, RotationsOfAnySizeAreRightAndFinite) {
  Random random(84);
  for (const double angle : {0.0, 1e-300, 1e-160, 1e-20, 1e-9, 9.9e-5, 1.01e-4, pi - 1e-15, pi, pi + 1e-15, 2 * pi,
                             2 * pi + 1e-9, 7.0, 1e3}) {
    const Vector<3> axis = shapes::direction<3>(random);
    const Rotation<3> start = shapes::orientation<3>(random);
    const Rotation<3> end = turned(start, angle * axis);
    const Matrix<3> expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix() * matrix(start);
    // the angle itself has an error of half an ulp
    EXPECT_LT((matrix(end) - expected).norm(), 1e-14 * (1 + angle)) << angle;
    EXPECT_NEAR(end.quaternion.norm(), 1, 1e-15);

    // back to a rotation vector: never longer than half a turn, and the same orientation
    const Spin<3> vector = rotation_vector(turned(Rotation<3>{}, angle * axis));
    EXPECT_LE(vector.norm(), pi * (1 + 1e-15));
    EXPECT_LT((matrix(turned(Rotation<3>{}, vector)) - expected * matrix(start).transpose()).norm(),
              1e-14 * (1 + angle));
    if (angle < 3) {
      EXPECT_LE((vector - angle * axis).norm(), 1e-14 * angle) << angle;
    }
  }
}

TEST(MotionExtremes, AStepMayRotateABodyMoreThanOnce) {
  // about a principal axis one step is exact for any angle; in 2-D full turns are counted
  Random random(85);
  for (const double angle : {0.0, 1e-300, pi - 1e-15, 2 * pi, 50.0}) {
    const Body<3> solid = shapes::random_body<3>(random, {});
    Motion<3> motion;
    motion.angular_momentum[2] = angle * solid.inertia[2];
    advance<3>(solid, {}, {}, {1, 1}, motion);
    const Vector<3> axis = solid.principal_axes.col(2);
    EXPECT_LT(apart(motion.rotation.quaternion, turn(axis, angle)), 1e-14 * (1 + angle)) << angle;
    const Body<2> flat = shapes::random_body<2>(random, {});
    Motion<2> flat_motion;
    flat_motion.angular_momentum[0] = angle * flat.inertia[0];
    advance<2>(flat, {}, {}, {1, 1}, flat_motion);
    EXPECT_NEAR(flat_motion.rotation.angle, angle, 1e-15 * angle);
  }
}

// ---- energy ---------------------------------------------------------------------------------------------------------

// mean over a window that fades in and out, so that a broken period at its ends does not count
struct FadedMean {
  double sum = 0, weights = 0;
  void add(double x, double place) {
    const double weight = 1 - std::cos(2 * pi * place);
    sum += weight * x;
    weights += weight;
  }
  double mean() const { return sum / weights; }
};

struct EnergyError {
  double largest = 0, drift = 0;  // relative to the energy at the start
};

// One degree of freedom under a force with a potential, undamped, at a fraction of the stable step. Energy is taken
// with velocity and position at the same time.
template <class Force, class Potential>
EnergyError energy_error(double start, double dt, long long steps, Force force, Potential potential) {
  Body<2> body;
  body.mass = 1;
  body.inertia[0] = 1;
  body.free_translation = {false, true};
  body.free_rotation.fill(false);
  Motion<2> motion;
  motion.displacement[1] = start;
  const double energy = potential(start);
  EnergyError error;
  FadedMean first, last;
  const double tenth = static_cast<double>(steps) / 10;
  for (long long i = 0; i < steps; ++i) {
    Load<2> load;
    load.force[1] = force(motion.displacement[1]);
    const double speed = motion.velocity[1] + (i > 0 ? 0.5 * dt * load.force[1] : 0);
    const double now = (0.5 * speed * speed + potential(motion.displacement[1])) / energy - 1;
    error.largest = std::max(error.largest, std::abs(now));
    const double place = static_cast<double>(i) / tenth;
    if (place < 1) first.add(now, place);
    if (place >= 9) last.add(now, place - 9);
    advance<2>(body, load, {}, {i == 0 ? 0.5 * dt : dt, dt}, motion);
  }
  error.drift = last.mean() - first.mean();
  return error;
}

// mass 1 on a spring of stiffness 1: the stable step is 2
EnergyError harmonic(double fraction, long long steps) {
  return energy_error(
      1, 2 * fraction, steps, [](double x) { return -x; }, [](double x) { return 0.5 * x * x; });
}

// the same mass under gravity 1 on the joint law's one-sided contact, whose static overlap is 1
const JointProperties one_sided{"joint", 1, 1, 0.5, true};

double weight_and_contact(double y) {
  if (y >= 0) return -1;
  JointKinematics<2> k{.normal = Vector<2>::UnitY(), .overlap = -y, .area = 1, .slip = Vector<2>::Zero()};
  Vector<2> shear = Vector<2>::Zero();
  return elastic_coulomb<2>(one_sided, std::tan(0.5), 0, k, shear).force[1] - 1;
}

EnergyError bouncing(double height, double fraction, long long steps) {
  return energy_error(height, 2 * fraction, steps, weight_and_contact,
                      [](double y) { return y + (y < 0 ? 0.5 * y * y : 0); });
}

// A spring conserves energy at any stable step. A contact that opens does so only if the times of impact repeat: a low
// bounce, here from a height of 2 static overlaps.
void expect_energy(long long steps) {
  for (const double fraction : {0.01, 0.05, 0.1}) {
    const EnergyError swing = harmonic(fraction, steps);
    EXPECT_LE(swing.largest, 1.1 * fraction * fraction) << fraction;  // (ω dt / 2)² is the method's error
    EXPECT_LE(std::abs(swing.drift), 1e-6) << fraction;
    EXPECT_LE(std::abs(bouncing(2, fraction, steps).drift), fraction <= 0.05 ? 1e-6 : 1e-2) << fraction;
  }
}

TEST(MotionExtremes, EnergyDoesNotDriftAtASmallStep) {
  expect_energy(1'000'000);
}

TEST(MotionExtremesLong, EnergyOver1e7StepsAtEachFractionOfTheLimit) {
  const long long steps = 10'000'000;
  expect_energy(steps);
  fmt::print("largest relative error and drift of the energy in 1e7 steps\n{:>8} {:>20} {:>20} {:>20}\n", "dt/limit",
             "spring", "bounce from 2", "bounce from 10");
  for (const double fraction : {0.01, 0.05, 0.1, 0.2, 0.5, 0.8}) {
    fmt::print("{:8}", fraction);
    for (const auto& [name, error] : {std::pair{"spring", harmonic(fraction, steps)},
                                      {"bounce_from_2", bouncing(2, fraction, steps)},
                                      {"bounce_from_10", bouncing(10, fraction, steps)}}) {
      fmt::print("   {:8.1e} {:8.0e}", error.largest, error.drift);
      RecordProperty(fmt::format("{}_at_{}", name, fraction), fmt::format("{:.3g} {:.3g}", error.largest, error.drift));
    }
    fmt::print("\n");
    EXPECT_LE(std::abs(harmonic(fraction, steps).drift), 1e-6) << fraction;
  }
}

// At any height, one bounce changes the energy by at most the fraction (ω dt)²/4, depending on the phase of the steps
// at contact. From a large height that phase is random from bounce to bounce: the changes have zero mean, but add up
// like a random walk. Bodies that fly far therefore conserve energy only while the number of bounces is small compared
// with 1 / (ω dt)⁴.
TEST(MotionExtremes, ABounceChangesTheEnergyByASquareOfTheStep) {
  Random random(91);
  Body<2> body;
  body.mass = 1;
  body.free_translation = {false, true};
  body.free_rotation.fill(false);
  for (const double height : {1.0, 2.0, 10.0, 100.0, 1000.0})
    for (const double fraction : {0.01, 0.05, 0.1, 0.2}) {
      const double dt = 2 * fraction, speed = std::sqrt(2 * height);
      const int bounces = 2000;
      double largest = 0, sum = 0, squares = 0;
      for (int i = 0; i < bounces; ++i) {
        Motion<2> motion;
        motion.displacement[1] = shapes::uniform(random, 0, speed * dt);
        motion.velocity[1] = -speed;
        const double energy = 0.5 * speed * speed + motion.displacement[1];
        Load<2> load;
        double leaving = -speed;
        for (bool first = true; motion.displacement[1] < 0 || leaving < 0; first = false) {
          load.force[1] = weight_and_contact(motion.displacement[1]);
          advance<2>(body, load, {}, {first ? 0.5 * dt : dt, dt}, motion);
          leaving = motion.velocity[1] + 0.5 * dt * weight_and_contact(motion.displacement[1]);
        }
        const double change = (0.5 * leaving * leaving + motion.displacement[1]) / energy - 1;
        largest = std::max(largest, std::abs(change));
        sum += change;
        squares += change * change;
      }
      EXPECT_LE(largest, 1.01 * fraction * fraction) << "height " << height << ", share " << fraction;
      EXPECT_GE(largest, 0.01 * fraction * fraction);  // it is of that order: the bound is not idle
      if (height >= 100) {
        EXPECT_LE(std::abs(sum), 5 * std::sqrt(squares)) << "height " << height << ", share " << fraction;
      }
    }
}

// ---- creep ----------------------------------------------------------------------------------------------------------

template <int Dim>
void expect_creep() {
  Random random(86);
  Body<Dim> body = shapes::random_body<Dim>(random, {});
  body.reference.setConstant(1e4);
  Motion<Dim> motion;
  const double dt = 1e-4, increment = 1e-12;  // s, m: below the spacing of doubles at 1e4 m
  ASSERT_LT(increment, std::nextafter(1e4, 2e4) - 1e4);
  motion.velocity.setConstant(increment / dt);
  const int steps = 1'000'000;
  for (int i = 0; i < steps; ++i)
    advance<Dim>(body, {}, {}, {dt, dt}, motion);
  for (int k = 0; k < Dim; ++k)
    EXPECT_NEAR(motion.displacement[k], increment * steps, 1e-6 * increment * steps);
}

TEST(MotionExtremes, CreepBelowTheSpacingOfCoordinatesIsNotLost) {
  expect_creep<2>();
  expect_creep<3>();
}

// ---- time step ------------------------------------------------------------------------------------------------------

// every aspect from 1 to 1e3, stiffness ratio from 1 to 1e6, mass ratio up to 1e9
template <int Dim>
void expect_safe_and_useful_step(std::uint64_t seed, int sets) {
  Random random(seed);
  double lowest = 1, highest = 0, heaviest = 1;
  for (int set = 0; set < sets; ++set) {
    const shapes::Spread spread{shapes::uniform(random, 0, 3), shapes::uniform(random, 0, 9),
                                shapes::uniform(random, 1e-9, 6)};
    const int free = shapes::integer(random, 1, 3);
    RandomAssembly<Dim> assembly(random, free, 1, free + shapes::integer(random, 0, 6), spread);
    const auto mass = [&](int b) { return assembly.model.bodies[b].mass; };
    for (int b = 1; b < free; ++b)
      heaviest = std::max({heaviest, mass(b) / mass(0), mass(0) / mass(b)});
    const double limit = 2 / std::sqrt(assembly.largest_eigenvalue());
    const double fraction = estimate_time_step(assembly.model, {}, {}, assembly.state.bodies, assembly.state.loads,
                                               assembly.state.contacts, assembly.state.time_step)
                                .limit /
                            limit;
    lowest = std::min(lowest, fraction);
    highest = std::max(highest, fraction);
  }
  // two eigenvalue solvers, and moments of inertia that differ by 1e6: 1e6 rounding errors
  EXPECT_LE(highest, 1 + 1e-9);
  EXPECT_GT(highest, 0.999);
  EXPECT_GE(lowest, 0.68);  // 0.97/√2 by theory (time_step.hpp)
  EXPECT_GT(heaviest, 1e9);
}

TEST(MotionExtremes, TheEstimatedStepIsSafeAndUseful) {
  expect_safe_and_useful_step<2>(87, 10'000);
  expect_safe_and_useful_step<3>(88, 10'000);
}
TEST(MotionExtremesLong, TheEstimatedStepIsSafeAndUsefulIn1e5Sets) {
  expect_safe_and_useful_step<2>(89, 100'000);
  expect_safe_and_useful_step<3>(90, 100'000);
}

}  // namespace
}  // namespace voussoir::motion_extremes_test
