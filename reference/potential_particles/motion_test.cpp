#include "reference/potential_particles/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/ode.hpp"
#include "reference/small/small.hpp"

namespace voussoir::reference::motion_test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(BallPeriod, IsFlightAndAnImpactOfTheBounce) {
  const BouncingBall ball{4200, 1e8, 9.81};
  for (const double height : {1e-4, 0.05, 3.0}) {
    const double speed = std::sqrt(2 * ball.gravity * height);
    const double contact = bounce({ball.mass, ball.stiffness, 0, speed, ball.gravity}).duration;
    EXPECT_NEAR(ball_period(ball, height), 2 * speed / ball.gravity + contact, 1e-12);
  }
}

TEST(BallPeriod, IsAFullSwingFromFirstContactAndHalfOfOneFromAGreatHeight) {
  const BouncingBall ball{1, 4, 10};
  EXPECT_NEAR(ball_period(ball, 0), pi, 1e-14);  // 2 π/ω
  const double speed = std::sqrt(2e9);
  // π/ω and the next term, 2 g/(ω² v); the remainder falls with the cube of g/(ω v)
  EXPECT_NEAR(ball_period(ball, 1e8) - 2 * speed / 10, pi / 2 + 20 / (4 * speed), 1e-10);
  EXPECT_NEAR(ball_period({1, 4, 1e-3}, 1e-4) / ball_period({100, 400, 1e-3}, 1e-4), 1, 1e-14);  // depends on k/m only
}

TEST(RollingCorner, WithoutARadiusIsAPendulumFromAbove) {
  const RollingCorner body{3, 0.7, 0.6, 0, 0.14, 9.81};
  const FallOver sharp{3, 0.7 + 3 * 0.36, 0.6, 0.14, 9.81};
  for (const double lean : {0.14, 0.2, 0.7, 1.5})
    EXPECT_NEAR(rolling_time(body, lean), fall_over_time(sharp, lean), 1e-11 * (1 + rolling_time(body, lean)));
}

// Lagrange's equation (I + m d²) φ'' - m r L sin φ φ'² = m g L sin φ instead of the energy
TEST(RollingCorner, SatisfiesLagrangesEquation) {
  const RollingCorner body{2500, 350, 0.5, 0.15, 0.1, 9.81};
  const OdeRight right = [&](double, const double* y, double* slope) {
    const double m = body.mass, L = body.arm, r = body.corner_radius;
    slope[0] = y[1];
    slope[1] = m * L * std::sin(y[0]) * (body.gravity + r * y[1] * y[1]) /
               (body.inertia + m * (L * L + r * r + 2 * r * L * std::cos(y[0])));
  };
  for (const double lean : {0.12, 0.3, 0.8}) {
    const std::vector<double> end = integrate_ode(right, {body.start, 0}, 0, rolling_time(body, lean));
    EXPECT_NEAR(end[0], lean, 1e-10);
    EXPECT_NEAR(end[1], rolling_speed(body, lean), 1e-10);
  }
}

// a small lean grows as exp(κ t), κ² = m g L/(I + m (L + r)²)
TEST(RollingCorner, LeavesBalanceAsALinearBodyDoes) {
  const RollingCorner body{1, 0.2, 0.5, 0.3, 1e-4, 9.81};
  const double rate = std::sqrt(9.81 * 0.5 / (0.2 + 0.64));
  EXPECT_NEAR(rolling_time(body, 1e-3), std::acosh(10) / rate, 1e-6);
  EXPECT_NEAR(centroid_height(body, 0), 0.8, 1e-15);
}

// mass and length scale out: time is proportional to the root of length
TEST(RollingCorner, ScalesWithLengthAndMass) {
  const RollingCorner one{1, 0.2, 0.5, 0.3, 0.1, 9.81}, large{7, 7 * 4 * 0.2, 1.0, 0.6, 0.1, 9.81};
  EXPECT_NEAR(rolling_time(large, 0.7) / rolling_time(one, 0.7), std::sqrt(2), 1e-11);
}

TEST(RoundedSquare, IsASquareAndADiscAtItsEnds) {
  const RoundedSquare sharp = rounded_square(0.5, 0), disc = rounded_square(1 + 1e-9, 1);
  EXPECT_NEAR(sharp.area, 1, 1e-15);
  EXPECT_NEAR(sharp.inertia, 1.0 / 6, 1e-15);
  EXPECT_NEAR(sharp.arm, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(disc.area, pi, 1e-7);
  EXPECT_NEAR(disc.inertia, pi / 2, 1e-7);
}

// against sums over thin slices
TEST(RoundedSquare, IsTheSumOfItsSlices) {
  const double half = 0.5, r = 0.2, a = half - r;
  constexpr int slices = 200000;
  double area = 0, inertia = 0;
  for (int i = 0; i < slices; ++i) {
    const double x = half * (i + 0.5) / slices, over = std::max(x - a, 0.0);
    const double height = a + std::sqrt(r * r - over * over), dx = half / slices;
    area += 4 * height * dx;
    inertia += 4 * (x * x * height + std::pow(height, 3) / 3) * dx;
  }
  EXPECT_NEAR(rounded_square(half, r).area, area, 1e-7);
  EXPECT_NEAR(rounded_square(half, r).inertia, inertia, 1e-7);
}

TEST(RollingCorner, RefusesInvalidBodies) {
  EXPECT_THROW(rolling_time({1, 1, 1, -0.1, 0.1, 9.81}, 0.5), std::invalid_argument);
  EXPECT_THROW(rolling_time({1, 1, 1, 0, 0.1, 9.81}, 0.05), std::invalid_argument);
  EXPECT_THROW(rounded_square(0.5, 0.5), std::invalid_argument);
  EXPECT_THROW(ball_period({0, 1, 1}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::motion_test
