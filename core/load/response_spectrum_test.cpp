// The response of an oscillator against closed forms: a constant acceleration, a linear one, a sine in steady state.
#include "core/load/response_spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/load/ground_motion.hpp"

namespace voussoir::response_spectrum_test {
namespace {

constexpr double pi = std::numbers::pi;

// An acceleration A from rest on: the displacement overshoots A/ω² by exp(-πζ/√(1-ζ²)), whatever the interval
TEST(ResponseSpectrum, OfAConstantAccelerationOvershoots) {
  const GroundMotion motion =
      make_ground_motion(MotionQuantity::acceleration, 0.05, std::vector<double>(401, 2.0), {});  // 20 s
  for (const double damping : {0.0, 0.05, 0.2})
    for (const ResponseOrdinate& r : response_spectrum(motion, {0.03, 0.1, 0.7, 1, 2.3, 8}, damping)) {
      SCOPED_TRACE(r.period);
      const double omega = 2 * pi / r.period;
      const double overshoot = damping > 0 ? std::exp(-pi * damping / std::sqrt(1 - damping * damping)) : 1;
      EXPECT_NEAR(r.pseudo_acceleration, 2 * (1 + overshoot), 1e-9);
      EXPECT_NEAR(r.displacement * omega, r.pseudo_velocity, 1e-15);
    }
}

// a pulse far shorter than the period leaves a free vibration of velocity ∫a, whose peak comes after its end
TEST(ResponseSpectrum, FollowsTheFreeVibrationAfterTheEnd) {
  const double h = 1e-4, damping = 0.05, period = 5;
  const GroundMotion motion = make_ground_motion(MotionQuantity::acceleration, h, {0, 10, 0}, {});
  const double omega = 2 * pi / period, root = std::sqrt(1 - damping * damping);
  const double peak = 10 * h / omega * std::exp(-damping / root * std::acos(damping));
  EXPECT_NEAR(response_spectrum(motion, {period}).front().displacement, peak, 2 * omega * h * peak);
}

// Steps of an acceleration that rises linearly against the particular solution and free vibration in one go
TEST(ResponseSpectrum, StepsOfALinearAccelerationAreExact) {
  const double omega = 7, damping = 0.05, rise = 3, first = -1, damped = omega * std::sqrt(1 - damping * damping);
  OscillatorState state{0.01, -0.2};
  const double slope = -rise / (omega * omega);
  const double at_begin = -first / (omega * omega) + 2 * damping * rise / (omega * omega * omega);
  const double a = state.displacement - at_begin, b = (state.velocity - slope + damping * omega * a) / damped;
  double time = 0;
  for (int k = 0; k < 100; ++k) {
    const double h = 0.001 * (1 + k % 7);
    state = oscillator_after({h, first + rise * time, first + rise * (time + h)}, h, omega, damping, state);
    time += h;
    const double exact =
        at_begin + slope * time +
        std::exp(-damping * omega * time) * (a * std::cos(damped * time) + b * std::sin(damped * time));
    ASSERT_NEAR(state.displacement, exact, 1e-13);
  }
}

// A sine in steady state: amplitude A/ω² D with D = 1/√((1-r²)² + (2ζr)²). Values at equal intervals make straight
// lines, whose first harmonic is (sinc(θ/2))² of the sine's; its images, at 1/h and beyond, are left as 1/(2π/θ)².
TEST(ResponseSpectrum, OfASineIsThatOfTheSteadyState) {
  const double h = 0.001, forcing = 4 * pi, damping = 0.05;
  std::vector<double> values;
  for (int i = 0; i <= 60'000; ++i)
    values.push_back(std::sin(forcing * h * i));
  const GroundMotion motion = make_ground_motion(MotionQuantity::acceleration, h, values, {});
  for (const double period : {0.4, 0.5, 0.6}) {  // near resonance the start's transients are smaller than what follows
    const double omega = 2 * pi / period, ratio = forcing / omega;
    const double amplification = 1 / std::sqrt(std::pow(1 - ratio * ratio, 2) + std::pow(2 * damping * ratio, 2));
    const double half = forcing * h / 2, lines = std::pow(std::sin(half) / half, 2);
    const double found = response_spectrum(motion, {period}, damping).front().pseudo_acceleration;
    if (period == 0.5)
      EXPECT_NEAR(found, amplification * lines, 1e-8 * amplification);
    else
      EXPECT_GE(found, amplification * lines * (1 - 1e-8));  // beats of the start may exceed it
  }
}

TEST(ResponseSpectrum, HasNoOrdinatesOfRecordedDisplacements) {
  EXPECT_TRUE(response_spectrum(make_ground_motion(MotionQuantity::displacement, 1, {0, 1}, {}), {1}).empty());
  EXPECT_EQ(usual_periods(0.004).size(), 61u);
  EXPECT_GE(usual_periods(0.02).front(), 0.04);
}

}  // namespace
}  // namespace voussoir::response_spectrum_test
