#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reference/small/small.hpp"
#include "text/angle.hpp"

using voussoir::degree;

namespace voussoir::reference::shaken_test {
namespace {

constexpr double pi = std::numbers::pi;

const ShakenIncline example{{10 * degree, 30 * degree, 9.81, 0}, 0.4, 2};

// Second derivation: step by step, Coulomb friction as a force that either keeps the block or drags it.
ShakenPosition stepped(const ShakenIncline& s, double time, int steps) {
  const double dt = time / steps, w = 2 * pi * s.frequency;
  const double limit =
      s.incline.gravity * (std::tan(s.incline.friction_angle) * std::cos(s.incline.angle) - std::sin(s.incline.angle));
  double distance = 0, velocity = 0;
  for (int k = 0; k < steps; ++k) {
    const double gain = s.speed * (std::sin(w * (k + 1) * dt) - std::sin(w * k * dt)) - limit * dt;
    const double next = std::max(0.0, velocity + gain);
    distance += 0.5 * (velocity + next) * dt;
    velocity = next;
  }
  return {distance, velocity};
}

TEST(ShakenBlock, AgreesWithSmallSteps) {
  for (const double speed : {0.31, 0.35, 0.4, 0.5, 0.57})
    for (const double time : {0.03, 0.1, 0.37, 0.8, 2.0}) {
      ShakenIncline s = example;
      s.speed = speed;
      const ShakenPosition exact = shaken_block(s, time), steps = stepped(s, time, 400000);
      EXPECT_NEAR(exact.distance, steps.distance, 2e-6) << speed << ' ' << time;
      EXPECT_NEAR(exact.velocity, steps.velocity, 2e-5) << speed << ' ' << time;
    }
}

// begun at full acceleration: the first slip is v (1 - cos wt)/w - a t²/2
TEST(ShakenBlock, FirstSlipIsTheDifferenceOfTwoDisplacements) {
  const double t = 0.05, w = 4 * pi,
               limit = 9.81 * (std::tan(30 * degree) * std::cos(10 * degree) - std::sin(10 * degree));
  EXPECT_NEAR(shaken_block(example, t).distance, 0.4 / w * (1 - std::cos(w * t)) - 0.5 * limit * t * t, 1e-15);
  EXPECT_EQ(shaken_block(example, 0).distance, 0);
}

// Newmark's rectangular pulse of 0.5 m/s at half of gravity, and step by step
TEST(ShakenBlock, SlipOfARectangularPulse) {
  const double g = 9.81, speed = 0.5, a = 0.5 * g;
  EXPECT_NEAR(slip_of_pulse(speed, a, 0.1 * g), 0.10193679918451, 1e-14);
  EXPECT_NEAR(slip_of_pulse(speed, a, 0.4 * g), 0.0063710499490316, 1e-14);
  EXPECT_EQ(slip_of_pulse(speed, a, 0.6 * g), 0);
  constexpr int steps = 400000;
  const double dt = 0.2 / steps, held = 0.3 * g;
  double distance = 0, ground = 0, block = 0;
  for (int k = 0; k < steps; ++k) {
    const double next = std::min(speed, ground + a * dt), follows = std::min(next, block + held * dt);
    distance += 0.5 * (ground + next - block - follows) * dt;
    ground = next;
    block = follows;
  }
  EXPECT_NEAR(slip_of_pulse(speed, a, held), distance, 1e-7);
  EXPECT_THROW(slip_of_pulse(speed, a, 0), std::invalid_argument);
}

// from the second cycle on each is like the one before
TEST(ShakenBlock, CyclesRepeat) {
  const double second = shaken_block(example, 1.2).distance - shaken_block(example, 0.7).distance;
  const double third = shaken_block(example, 1.7).distance - shaken_block(example, 1.2).distance;
  EXPECT_GT(second, 0);
  EXPECT_NEAR(second, third, 1e-14);
}

TEST(ShakenBlock, StaysBelowTheLimitAndRefusesWhatItDoesNotModel) {
  ShakenIncline s = example;
  s.speed = 0.3;  // 3.77 m/s² of 3.87
  EXPECT_EQ(shaken_block(s, 5).distance, 0);
  s.speed = 0.6;  // 7.54 m/s² of 7.28 for an upward slip
  EXPECT_THROW(shaken_block(s, 1), std::invalid_argument);
  s.incline.friction_angle = 9 * degree;
  EXPECT_THROW(shaken_block(s, 1), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::shaken_test
