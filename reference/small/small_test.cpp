#include "reference/small/small.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "reference/ode.hpp"
#include "text/angle.hpp"

using voussoir::degree;

namespace voussoir::reference::small_test {
namespace {

constexpr double pi = std::numbers::pi;

// --- incline

TEST(Incline, WorkedValues) {
  const Incline slides{30 * degree, 20 * degree, 9.81, 0};
  const double acceleration = 9.81 * (0.5 - std::cos(30 * degree) * std::tan(20 * degree));
  EXPECT_NEAR(incline_critical_friction(slides) / degree, 30, 1e-12);
  EXPECT_NEAR(incline_distance(slides, 2), 2 * acceleration, 1e-12);
  EXPECT_NEAR(incline_velocity(slides, 2), 2 * acceleration, 1e-12);
  EXPECT_EQ(incline_distance({30 * degree, 31 * degree, 9.81, 0}, 100), 0);
  EXPECT_NEAR(incline_distance({pi / 2, 0.5, 9.81, 0}, 1), 9.81 / 2, 1e-12);  // a wall: free fall
  EXPECT_EQ(incline_distance({0, 0, 9.81, 0}, 1), 0);
}

TEST(Incline, StopsByEnergy) {
  // Moving and above the critical friction: work of friction less gravity takes off the kinetic energy.
  const Incline stops{20 * degree, 35 * degree, 9.81, 3};
  const double distance = incline_distance(stops, 1e6);
  const double resistance = 9.81 * (std::cos(20 * degree) * std::tan(35 * degree) - std::sin(20 * degree));
  EXPECT_NEAR(resistance * distance, 4.5, 1e-12);
  EXPECT_EQ(incline_velocity(stops, 1e6), 0);
  EXPECT_NEAR(incline_velocity(stops, 0.1), 3 - 0.1 * resistance, 1e-12);
}

TEST(Incline, NumericalIntegrationAndScaling) {
  const Incline slides{50 * degree, 33 * degree, 9.81, 1.5};
  const auto right = [](double, const double* y, double* slope) {
    slope[0] = y[1];
    slope[1] = 9.81 * std::sin(50 * degree) - 9.81 * std::cos(50 * degree) * std::tan(33 * degree);
  };
  EXPECT_NEAR(incline_distance(slides, 3), integrate_ode(right, {0, 1.5}, 0, 3)[0], 1e-10);
  EXPECT_NEAR(incline_distance({1, 0.5, 20, 0}, 3), 2 * incline_distance({1, 0.5, 10, 0}, 3), 1e-10);
  EXPECT_THROW(incline_distance({2, 0.5, 9.81, 0}, 3), std::invalid_argument);
  EXPECT_THROW(incline_distance(slides, -1), std::invalid_argument);
}

// Friction that falls while the block slides, integrated until it has slid the distance: the leading term and the next.
TEST(Incline, TheBiasOfARateIsTheLeadingTerm) {
  const double angle = 30 * degree, distance = 0.1, damping = 0.7;
  for (const double rate : {0.025 * degree, 0.1 * degree, 1 * degree}) {
    const double bias = incline_rate_bias({angle, 0, 9.81, 0}, distance, rate, damping);
    const auto right = [&](double time, const double* y, double* slope) {
      slope[0] = y[1];
      slope[1] = (1 - damping) * 9.81 * (std::sin(angle) - std::cos(angle) * std::tan(angle - rate * time));
    };
    // the angle at which the distance is reached, by bisection in time
    double low = 0.5 * bias / rate, high = 2 * bias / rate;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (integrate_ode(right, {0, 0}, 0, middle)[0] < distance ? low : high) = middle;
    }
    const double next = 1 + std::tan(angle) * bias / 6;
    EXPECT_NEAR(low * rate, bias * next, bias * bias * bias);
  }
  EXPECT_NEAR(incline_rate_bias({0, 0, 6, 0}, 1, 1, 0), 1, 1e-15);
  EXPECT_THROW(incline_rate_bias({angle, 0, 9.81, 0}, 0, 1, 0), std::invalid_argument);
  EXPECT_THROW(incline_rate_bias({angle, 0, 9.81, 0}, 1, 1, 1), std::invalid_argument);
}

// --- bounce

// Small exact steps of the equation of motion until the force turns negative, then bisection of the last step.
BounceResult bounce_by_integration(const Bounce& b, double longest) {
  const double damper = 2 * b.damping_ratio * std::sqrt(b.stiffness * b.mass);
  const auto right = [&](double, const double* y, double* slope) {
    slope[0] = y[1];
    slope[1] = b.gravity - (b.stiffness * y[0] + damper * y[1]) / b.mass;
  };
  auto force = [&](const std::vector<double>& y) { return b.stiffness * y[0] + damper * y[1]; };
  std::vector<double> y{0, b.impact_speed};
  const double step = longest / 4000;
  BounceResult result;
  for (double t = 0; t < longest; t += step) {
    auto next = integrate_ode(right, y, t, t + step);
    result.maximum_overlap = std::max(result.maximum_overlap, next[0]);
    if (force(next) < 0) {
      double low = t, high = t + step;
      for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (force(integrate_ode(right, y, t, middle)) > 0 ? low : high) = middle;
      }
      const auto end = integrate_ode(right, y, t, low);
      result.duration = low;
      result.end_overlap = end[0];
      result.restitution = -end[1] / b.impact_speed;
      return result;
    }
    y = next;
  }
  result.rebounds = false;
  return result;
}

TEST(Bounce, LimitsWithoutGravity) {
  const Bounce elastic{2, 800, 0, 3, 0};
  EXPECT_NEAR(bounce(elastic).restitution, 1, 1e-15);
  EXPECT_NEAR(bounce(elastic).duration, pi / 20, 1e-14);
  EXPECT_NEAR(bounce(elastic).maximum_overlap, 3.0 / 20, 1e-14);
  EXPECT_NEAR(bounce({1, 1, 1, 1, 0}).restitution, std::exp(-2), 1e-14);  // critical
  EXPECT_NEAR(bounce({1, 1, 1 - 1e-5, 1, 0}).restitution, bounce({1, 1, 1 + 1e-5, 1, 0}).restitution, 1e-5);
  EXPECT_NEAR(bounce({1, 1, 1e-6, 1, 0}).restitution, 1 - pi * 1e-6, 1e-10);  // e = 1 - pi z
  EXPECT_LT(bounce({1, 1, 50, 1, 0}).restitution, 2e-4);
  // the naive formula, which lets the contact pull, is lower
  EXPECT_GT(bounce({1, 1, 0.5, 1, 0}).restitution, std::exp(-pi * 0.5 / std::sqrt(0.75)));
}

TEST(Bounce, NumericalIntegration) {
  for (const double damping : {0.0, 0.1, 0.5, 0.9, 1.0, 1.3, 3.0})
    for (const double gravity : {0.0, 0.05, 0.5, 3.0}) {
      const Bounce b{2, 50, damping, 0.7, gravity};
      const BounceResult closed = bounce(b), numeric = bounce_by_integration(b, 4);
      ASSERT_EQ(closed.rebounds, numeric.rebounds) << damping << " " << gravity;
      // sampling misses the top of the overlap by (step/2)^2 w^2/2; a block that stays creeps, so its time is longer
      const double top = closed.rebounds ? numeric.maximum_overlap : bounce_by_integration(b, 20).maximum_overlap;
      EXPECT_NEAR(closed.maximum_overlap, top, (closed.rebounds ? 1e-5 : 1e-4) * closed.maximum_overlap);
      if (!closed.rebounds) continue;
      EXPECT_NEAR(closed.duration, numeric.duration, 1e-8) << damping << " " << gravity;
      EXPECT_NEAR(closed.restitution, numeric.restitution, 1e-8);
      EXPECT_NEAR(closed.end_overlap, numeric.end_overlap, 1e-8);
    }
}

TEST(Bounce, Gravity) {
  // Without damping the energy is returned: e = 1; the contact lasts longer, w t = 2 (pi/2 + atan(g/(v w))).
  const Bounce heavy{2, 50, 0, 0.7, 9.81};
  const BounceResult result = bounce(heavy);
  EXPECT_NEAR(result.restitution, 1, 1e-12);
  EXPECT_NEAR(result.duration, (pi + 2 * std::atan(9.81 / (0.7 * 5))) / 5, 1e-12);
  EXPECT_NEAR(result.end_overlap, 0, 1e-12);
  // Small gravity has no effect; large gravity with damping keeps the block in contact.
  EXPECT_NEAR(bounce({2, 50, 0.3, 0.7, 1e-9}).restitution, bounce({2, 50, 0.3, 0.7, 0}).restitution, 1e-8);
  EXPECT_FALSE(bounce({2, 50, 0.3, 0.01, 9.81}).rebounds);
}

TEST(Bounce, Scaling) {
  const BounceResult base = bounce({2, 50, 0.3, 0.7, 0.2});
  const BounceResult heavy = bounce({20, 500, 0.3, 0.7, 0.2});  // mass and stiffness
  const BounceResult quick = bounce({2, 5000, 0.3, 0.7, 2});    // ten times the frequency, gravity with v w
  EXPECT_NEAR(heavy.restitution, base.restitution, 1e-12);
  EXPECT_NEAR(heavy.duration, base.duration, 1e-12);
  EXPECT_NEAR(quick.restitution, base.restitution, 1e-12);
  EXPECT_NEAR(quick.duration, base.duration / 10, 1e-12);
  EXPECT_THROW(bounce({0, 1, 0, 1, 0}), std::invalid_argument);
  EXPECT_THROW(bounce({1, 1, -0.1, 1, 0}), std::invalid_argument);
}

// --- column

TEST(Column, OverlapsAndFrequenciesAgainstTheStiffnessMatrix) {
  for (const int blocks : {1, 2, 5, 30}) {
    const Column column{blocks, 3, 700, 9.81};
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(blocks, blocks);
    for (int i = 0; i < blocks; ++i) {
      stiffness(i, i) += 700;
      if (i + 1 < blocks) {
        stiffness(i, i) += 700;
        stiffness(i, i + 1) = stiffness(i + 1, i) = -700;
      }
    }
    const Eigen::VectorXd down = stiffness.ldlt().solve(Eigen::VectorXd::Constant(blocks, 3 * 9.81));
    const auto overlaps = column_overlaps(column);
    ASSERT_EQ(overlaps.size(), static_cast<std::size_t>(blocks));
    for (int i = 0; i < blocks; ++i)
      EXPECT_NEAR(overlaps[i], down(i) - (i > 0 ? down(i - 1) : 0), 1e-10 * down(blocks - 1));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness / 3);
    for (int mode = 1; mode <= blocks; ++mode)
      EXPECT_NEAR(column_frequency(column, mode), std::sqrt(modes.eigenvalues()(mode - 1)), 1e-10);
  }
}

TEST(Column, LimitsAndScaling) {
  EXPECT_NEAR(column_frequency({1, 2, 50, 9.81}), 5, 1e-14);
  // many blocks: an elastic bar, pi/2 sqrt(k/m)/N
  EXPECT_NEAR(column_frequency({10000, 1, 1, 9.81}) * 10000, pi / 2, 1e-4);
  EXPECT_NEAR(column_frequency({7, 4, 1, 0}), 0.5 * column_frequency({7, 1, 1, 0}), 1e-15);
  EXPECT_NEAR(column_overlaps({4, 1, 10, 9.81})[0], 4 * 0.981, 1e-14);
  EXPECT_THROW(column_overlaps({0, 1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(column_frequency({3, 1, 1, 1}, 4), std::invalid_argument);
}

// --- free rotation

std::vector<double> euler(const FreeRotation& body, double time) {
  const auto& i = body.inertia;
  const auto right = [&i](double, const double* w, double* slope) {
    for (int k = 0; k < 3; ++k) {
      const int p = (k + 1) % 3, q = (k + 2) % 3;
      slope[k] = (i[p] - i[q]) * w[p] * w[q] / i[k];
    }
  };
  return integrate_ode(right, {body.angular_velocity.begin(), body.angular_velocity.end()}, 0, time, 1e-13);
}

TEST(FreeRotation, EulerEquationsIntegrated) {
  boost::random::mt19937_64 engine(37);
  auto uniform = [&](double low, double high) { return boost::random::uniform_real_distribution<>(low, high)(engine); };
  for (int trial = 0; trial < 300; ++trial) {
    FreeRotation body;
    body.inertia = box_inertia(2, {uniform(0.2, 2), uniform(0.2, 2), uniform(0.2, 2)});
    for (double& w : body.angular_velocity)
      w = uniform(-2, 2);
    const double time = uniform(0, 10);
    const auto closed = free_rotation(body, time);
    const auto numeric = euler(body, time);
    const auto start = free_rotation(body, 0);
    // near the separatrix a rounding at the start grows like exp(rate t)
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(start[k], body.angular_velocity[k], 1e-9) << trial;
      EXPECT_NEAR(closed[k], numeric[k], 1e-7) << trial;
    }
    const double period = free_rotation_period(body);
    const auto later = free_rotation(body, period);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(later[k], body.angular_velocity[k], 1e-7) << trial;
  }
}

TEST(FreeRotation, EnergyAndAngularMomentumAreConserved) {
  const FreeRotation body{box_inertia(1, {1, 0.6, 0.3}), {0.01, 2, 0.01}};  // close to the middle axis: it tumbles
  auto invariants = [&](const std::array<double, 3>& w) {
    double energy = 0, momentum = 0;
    for (int k = 0; k < 3; ++k) {
      energy += body.inertia[k] * w[k] * w[k] / 2;
      momentum += body.inertia[k] * body.inertia[k] * w[k] * w[k];
    }
    return std::array<double, 2>{energy, momentum};
  };
  double lowest = 2;
  for (double t = 0; t < 60; t += 0.1) {
    const auto now = free_rotation(body, t);
    EXPECT_NEAR(invariants(now)[0], invariants(body.angular_velocity)[0], 1e-13);
    EXPECT_NEAR(invariants(now)[1], invariants(body.angular_velocity)[1], 1e-13);
    lowest = std::min(lowest, now[1]);
  }
  EXPECT_LT(lowest, -1.99);
}

TEST(FreeRotation, SymmetricBodyAndSteadyRotation) {
  // Symmetric about the third axis: the transverse part turns at (I3 - I1)/I1 w3.
  const FreeRotation disc{{1, 1, 1.8}, {0.3, 0, 2}}, rod{{1, 1, 0.2}, {0.3, 0, 2}};
  for (const FreeRotation& body : {disc, rod}) {
    const double rate = (body.inertia[2] - 1) * 2;
    for (const double t : {0.1, 1.0, 7.0}) {
      const auto w = free_rotation(body, t);
      EXPECT_NEAR(w[0], 0.3 * std::cos(rate * t), 1e-13);
      EXPECT_NEAR(w[1], 0.3 * std::sin(rate * t), 1e-13);
      EXPECT_NEAR(w[2], 2, 1e-13);
    }
    EXPECT_NEAR(free_rotation_period(body), 2 * pi / std::abs(rate), 1e-12);
  }
  // Small wobble about the largest moment: 2 pi/(w sqrt((I3-I1)(I3-I2)/(I1 I2))).
  const FreeRotation wobble{{1, 1.3, 2}, {1e-5, 0, 4}};
  EXPECT_NEAR(free_rotation_period(wobble), 2 * pi / (4 * std::sqrt(1 * 0.7 / 1.3)), 1e-9);
  for (int axis = 0; axis < 3; ++axis) {
    FreeRotation steady{{1, 1.3, 2}, {0, 0, 0}};
    steady.angular_velocity[axis] = -3;
    EXPECT_EQ(free_rotation(steady, 5), steady.angular_velocity);
    EXPECT_TRUE(std::isinf(free_rotation_period(steady)));
  }
  const FreeRotation ball{{1, 1, 1}, {1, 2, 3}};
  EXPECT_EQ(free_rotation(ball, 5), ball.angular_velocity);
}

TEST(FreeRotation, CirclesAboutTheMomentumInSpace) {
  // A symmetric body: the spin, which is in the plane of momentum and axis, turns with it about the momentum, L/I1.
  const FreeRotation disc{{1, 1, 1.8}, {0.3, 0, 2}};
  const double momentum = std::hypot(0.3, 3.6);
  const std::array<double, 3> along{0.3 / momentum, 0, 3.6 / momentum};
  const double fraction = 0.3 * along[0] + 2 * along[2];
  const std::array<double, 3> across{0.3 - fraction * along[0], 0, 2 - fraction * along[2]};
  for (const double t : {0.0, 1.0, 20.0}) {
    const double angle = momentum * t;
    const auto w = free_rotation_in_space(disc, t);
    // along x (y) the momentum's cross product with its transverse part: in the y direction only
    const double sideways = along[2] * across[0] - along[0] * across[2];
    EXPECT_NEAR(w[0], fraction * along[0] + std::cos(angle) * across[0], 1e-9);
    EXPECT_NEAR(w[1], std::sin(angle) * sideways, 1e-9);
    EXPECT_NEAR(w[2], fraction * along[2] + std::cos(angle) * across[2], 1e-9);
  }
  // any body conserves its energy, which is the spin times the momentum
  const FreeRotation box{{1, 1.3, 2}, {0.1, 2, 0.1}};
  for (const double t : {3.0, 45.0}) {
    const auto w = free_rotation_in_space(box, t);
    const double twice_energy = 1 * 0.01 + 1.3 * 4 + 2 * 0.01;
    EXPECT_NEAR(0.1 * w[0] + 2.6 * w[1] + 0.2 * w[2], twice_energy, 1e-8);
  }
}

TEST(FreeRotation, ScalingAndErrors) {
  const FreeRotation body{{1, 1.3, 2}, {1, 2, 3}};
  const FreeRotation heavy{{10, 13, 20}, {1, 2, 3}}, fast{{1, 1.3, 2}, {10, 20, 30}};
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(free_rotation(heavy, 2)[k], free_rotation(body, 2)[k], 1e-12);
    EXPECT_NEAR(free_rotation(fast, 0.2)[k], 10 * free_rotation(body, 2)[k], 1e-11);
  }
  EXPECT_NEAR(box_inertia(12, {1, 2, 3})[0], 13, 1e-14);
  EXPECT_THROW(free_rotation({{1, 1, 3}, {1, 0, 0}}, 1), std::invalid_argument);
  EXPECT_THROW(free_rotation({{1, 0, 1}, {1, 0, 0}}, 1), std::invalid_argument);
}

// --- falling over an edge

TEST(FallOver, NumericalIntegration) {
  for (const double start : {1e-3, 0.1, 1.0, 2.5})
    for (const double lean : {start, 1.5 * start, 0.5 * (start + pi), pi}) {
      if (lean > pi) continue;
      const FallOver block{1200, 800, 0.7, start, 9.81};
      const double rate = 1200 * 9.81 * 0.7 / 800;
      // to the time the closed form gives, and back to the lean it started from
      const auto end = integrate_ode(
          [&](double, const double* y, double* slope) {
            slope[0] = y[1];
            slope[1] = rate * std::sin(y[0]);
          },
          {start, 0}, 0, fall_over_time(block, lean));
      EXPECT_NEAR(end[0], lean, 1e-8) << start << " " << lean;
    }
}

TEST(FallOver, Limits) {
  // a small lean grows like cosh; a hanging body takes a quarter of a pendulum's period of small amplitude
  const FallOver block{3, 6, 2, 1e-4, 10};
  const double rate = std::sqrt(3 * 10 * 2 / 6.0);
  EXPECT_NEAR(fall_over_time(block, 5e-4), std::acosh(5.0) / rate, 1e-6);
  EXPECT_NEAR(fall_over_time({3, 6, 2, pi - 1e-3, 10}, pi), pi / 2 / rate, 1e-6);
  // the mass does not matter
  EXPECT_NEAR(fall_over_time({6, 12, 2, 1e-4, 10}, 1), fall_over_time(block, 1), 1e-12);
  EXPECT_THROW(fall_over_time(block, 1e-5), std::invalid_argument);
  EXPECT_THROW(fall_over_time({3, 6, 2, 0, 10}, 1), std::invalid_argument);
  EXPECT_THROW(fall_over_time({3, 0, 2, 1, 10}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::small_test
