// Ground motions against closed forms: integration, measures of a sampled sine, corrections, paths within steps.
#include "core/load/ground_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/load/record_measures.hpp"

namespace voussoir::ground_motion_test {
namespace {

using enum MotionQuantity;
constexpr double pi = std::numbers::pi;

std::vector<double> sampled(const std::function<double(double)>& f, double interval, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
    values.push_back(f(i * interval));
  return values;
}

// A sin ωt over ten whole cycles: 3 m/s², 2 Hz
constexpr double amplitude = 3, omega = 4 * pi, length = 5;

GroundMotion sine(double interval, const RecordTreatment& treatment = {}) {
  const int count = static_cast<int>(std::lround(length / interval)) + 1;
  return make_ground_motion(acceleration, interval,
                            sampled([](double t) { return amplitude * std::sin(omega * t); }, interval, count),
                            treatment);
}

// numbers that look like a record, from a generator of our own
std::vector<double> noise(int count) {
  std::vector<double> values;
  unsigned state = 12345;
  for (int i = 0; i < count; ++i) {
    state = state * 1664525u + 1013904223u;
    values.push_back(4.0 * (state / 4294967296.0) - 1.7);
  }
  return values;
}

// Of values linear in between every measure has a closed form in θ = ωh: v of the trapezoid is (A h/2) cot(θ/2)
// (1 - cos ωt) at the values, and ∫a² is A² D/2 (2 + cos θ)/3.
TEST(RecordMeasures, OfASampledSineAreThoseOfItsStraightLines) {
  for (const double h : {0.001, 0.002, 0.005, 0.01, 0.02}) {
    SCOPED_TRACE(h);
    const GroundMotion motion = sine(h);
    const RecordMeasures m = measures_of(motion);
    const double theta = omega * h, cotangent = 1 / std::tan(theta / 2);
    double peak = 0, largest_velocity = 0;
    for (std::size_t i = 0; i < m.count; ++i) {
      peak = std::max(peak, std::abs(amplitude * std::sin(omega * h * static_cast<double>(i))));
      largest_velocity = std::max(largest_velocity,
                                  amplitude * h / 2 * cotangent * (1 - std::cos(omega * h * static_cast<double>(i))));
    }
    const double arias = pi / (2 * 9.80665) * amplitude * amplitude * length / 2 * (2 + std::cos(theta)) / 3;
    EXPECT_NEAR(m.acceleration->peak, peak, 1e-9 * peak);
    EXPECT_NEAR(*m.peak_velocity, largest_velocity, 1e-9 * largest_velocity);
    // the mean velocity is that of 1 - cos: the straight lines between sum to the same over whole cycles
    EXPECT_NEAR(m.peak_displacement, amplitude * h / 2 * cotangent * length, 1e-9);
    EXPECT_NEAR(m.acceleration->arias, arias, 1e-9 * arias);
    EXPECT_NEAR(m.end_velocity, 0, 1e-12);
    EXPECT_EQ(m.count, static_cast<std::size_t>(std::lround(length / h)) + 1);
  }
}

// the same numbers, computed by another program and printed with ten digits
TEST(RecordMeasures, AreThoseOfTheTable) {
  struct Row {
    double interval, pga, pgv, pgd, arias, cav;
  };
  const Row table[] = {{0.001, 3, 0.4774585461, 1.193646365, 3.603879732, 9.549170921},
                       {0.005, 3, 0.4773077393, 1.193269348, 3.601604044, 9.546154786},
                       {0.01, 2.994080185, 0.4768363453, 1.192090863, 3.594501779, 9.536726906},
                       {0.02, 2.994080185, 0.4730763483, 1.187372263, 3.566232754, 9.499126936}};
  for (const Row& row : table) {
    SCOPED_TRACE(row.interval);
    const RecordMeasures m = measures_of(sine(row.interval));
    EXPECT_NEAR(m.acceleration->peak, row.pga, 1e-9 * row.pga);
    EXPECT_NEAR(*m.peak_velocity, row.pgv, 1e-9 * row.pgv);
    EXPECT_NEAR(m.peak_displacement, row.pgd, 1e-9 * row.pgd);
    EXPECT_NEAR(m.acceleration->arias, row.arias, 1e-9 * row.arias);
    EXPECT_NEAR(m.acceleration->cav, row.cav, 1e-9 * row.cav);
  }
}

// ∫ sin² from the start has its 5 and 95 % at places symmetric about the middle
TEST(RecordMeasures, FindTheSignificantDurationAndTheFrequency) {
  const RecordMeasures m = measures_of(sine(0.001));
  const auto share = [](double t) { return (t - std::sin(2 * omega * t) / (2 * omega)) / length; };
  EXPECT_NEAR(share(m.acceleration->significant_from), 0.05, 1e-5);  // of lines instead of the sine: (ωh)²/12
  EXPECT_NEAR(share(m.acceleration->significant_from + m.acceleration->significant), 0.95, 1e-5);
  // zeros behind make bins of 1/(4 D) or less, and the peak of the window's leakage moves by less than one
  EXPECT_NEAR(m.acceleration->peak_frequency, 2, 0.25 / length);
}

// a sum of two sines: the energy above a frequency between is that of the higher one
TEST(RecordMeasures, ShareOfEnergyIsThatOfItsParts) {
  const double h = 0.005;
  const auto both = [](double t) { return 2 * std::sin(2 * pi * 1 * t) + std::sin(2 * pi * 20 * t); };
  const GroundMotion motion = make_ground_motion(acceleration, h, sampled(both, h, 8001), {});  // 40 s
  const FourierSpectrum spectrum = fourier_spectrum(motion);
  EXPECT_NEAR(share_above(spectrum, 5), 0.2, 2e-3);  // what leaks of 40 periods: 1/(π² n) of the lower one
  EXPECT_EQ(share_above(spectrum, 1e3), 0);
  EXPECT_NEAR(share_above(spectrum, -1), 1, 1e-12);
}

TEST(GroundMotion, EndCorrectionLeavesNoMotionAtTheEnd) {
  const std::vector<double> values = noise(2000);
  const double h = 0.01;
  const GroundMotion as_recorded = make_ground_motion(acceleration, h, values, {});
  const GroundMotion end = make_ground_motion(acceleration, h, values, {.baseline = Baseline::end});
  const double D = end.duration();
  ASSERT_GT(std::abs(as_recorded.velocity.back()), 1);
  EXPECT_NEAR(end.velocity.back(), 0, 1e-11);
  EXPECT_NEAR(end.displacement.back(), 0, 1e-10);
  EXPECT_EQ(end.stated_end_velocity, as_recorded.velocity.back());
  EXPECT_EQ(end.stated_end_displacement, as_recorded.displacement.back());
  // what was taken off is a straight line with the moments v = ∫c, d = ∫(D - t) c
  const double first = as_recorded.acceleration.front() - end.acceleration.front();
  const double last = as_recorded.acceleration.back() - end.acceleration.back();
  EXPECT_NEAR(0.5 * (first + last) * D, as_recorded.velocity.back(), 1e-10);
  EXPECT_NEAR(D * D * (2 * first + last) / 6, as_recorded.displacement.back(), 1e-9);
  const std::size_t middle = values.size() / 4;
  EXPECT_NEAR(as_recorded.acceleration[middle] - end.acceleration[middle],
              first + (last - first) * static_cast<double>(middle) / static_cast<double>(values.size() - 1), 1e-12);
  EXPECT_NEAR(end.taken_off, std::max(std::abs(first), std::abs(last)), 1e-13);
}

TEST(GroundMotion, MeanCorrectionLeavesNoVelocityAtTheEnd) {
  const std::vector<double> values = noise(500);
  const GroundMotion mean = make_ground_motion(acceleration, 0.02, values, {.baseline = Baseline::mean});
  EXPECT_NEAR(mean.velocity.back(), 0, 1e-12);
  EXPECT_NEAR(values[7] - mean.acceleration[7], mean.stated_end_velocity / mean.duration(), 1e-14);
  const GroundMotion of_velocity = make_ground_motion(velocity, 0.02, values, {.baseline = Baseline::mean});
  EXPECT_NEAR(of_velocity.displacement.back(), 0, 1e-12);
}

// ten cycles of a sine that starts at once: the correction bends it by 6/(2πn) of its amplitude
TEST(GroundMotion, EndCorrectionOfASineTakesOffWhatIsPrinted) {
  const RecordMeasures m = measures_of(sine(0.001, {.baseline = Baseline::end}));
  EXPECT_NEAR(m.taken_off, 6 / (2 * pi * 10), 1e-5 * m.taken_off + 6 / (2 * pi * 10) * omega * omega * 1e-6 / 12);
}

TEST(GroundMotion, IsClippedScaledAndDelayed) {
  const std::vector<double> values = noise(101);
  const GroundMotion motion =
      make_ground_motion(velocity, 0.1, values, {.scale = -0.5, .from = 2, .to = 5, .pad = 1.5});
  ASSERT_EQ(motion.velocity.size(), 31u);
  EXPECT_EQ(motion.velocity.front(), -0.5 * values[20]);
  EXPECT_EQ(motion.velocity.back(), -0.5 * values[50]);
  EXPECT_EQ(path_between(motion, 0, 1.5), 0);
  EXPECT_NEAR(path_between(motion, 0, 4.5), motion.displacement.back(), 1e-14);
  EXPECT_NEAR(path_between(motion, 4.5, 6.5), 2 * motion.velocity.back(), 1e-14);  // the last velocity stays
  EXPECT_EQ(values_kept(101, 0.1, {.from = 20}).first, 101u);
  EXPECT_EQ(values_kept(101, 0.1, {.from = 3, .to = 2}).end, values_kept(101, 0.1, {.from = 3, .to = 2}).first);
}

// displacement of a motion by its cubic within an interval, directly
double displacement_at(const GroundMotion& m, double time) {
  const double h = m.interval;
  const auto i = std::min(static_cast<std::size_t>(time / h), m.displacement.size() - 2);
  const double t = time - h * static_cast<double>(i);
  if (m.quantity == displacement) return m.displacement[i] + t / h * (m.displacement[i + 1] - m.displacement[i]);
  if (m.quantity == velocity)
    return m.displacement[i] + m.velocity[i] * t + (m.velocity[i + 1] - m.velocity[i]) * t * t / (2 * h);
  return m.displacement[i] + m.velocity[i] * t + m.acceleration[i] * t * t / 2 +
         (m.acceleration[i + 1] - m.acceleration[i]) * t * t * t / (6 * h);
}

// steps much shorter than an interval, incommensurate with it, and of several intervals
TEST(GroundMotion, PathIsTheDifferenceOfDisplacements) {
  const std::vector<double> values = noise(300);
  for (const MotionQuantity quantity : {acceleration, velocity, displacement}) {
    const GroundMotion motion = make_ground_motion(quantity, 0.01, values, {});
    EXPECT_NEAR(displacement_at(motion, motion.duration()), motion.displacement.back(), 1e-13);
    for (const double step : {1e-5, 0.0037, 0.01, 0.0231, 0.5}) {
      double sum = 0, time = 0;
      while (time + step < motion.duration()) {
        const double path = path_between(motion, time, time + step);
        ASSERT_NEAR(path, displacement_at(motion, time + step) - displacement_at(motion, time), 1e-12);
        sum += path;
        time += step;
      }
      EXPECT_NEAR(sum, displacement_at(motion, time) - motion.displacement.front(), 1e-11);
    }
  }
}

}  // namespace
}  // namespace voussoir::ground_motion_test
