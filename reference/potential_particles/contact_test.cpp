#include "reference/potential_particles/contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace voussoir::reference::contact_test {
namespace {

// the least of a convex function on 0..end, by thirds
template <class Function>
double least_place(Function f, double end) {
  double low = 0, high = end;
  for (int i = 0; i < 200; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
  }
  return (low + high) / 2;
}

TEST(PotentialParticles, WorkedValues) {
  const PotentialContactForm c = touching_spheres(2, 1, 2.7);
  EXPECT_NEAR(c.from_first, 1.8, 1e-15);
  EXPECT_NEAR(c.overlap, 0.3, 1e-15);
  EXPECT_NEAR(c.value, -0.19, 1e-15);
  EXPECT_NEAR(recess(3, 1), 0.7320508075688772, 1e-15);
  EXPECT_EQ(recess(1, 1), 0);
}

TEST(PotentialParticles, IsTheLeastLargerValueOnTheLine) {
  for (const double a : {0.1, 1.0, 3.0})
    for (const double b : {0.2, 1.0}) {
      const double distance = 0.95 * (a + b);
      const auto larger = [&](double t) {
        return std::max(t * t / (a * a), (distance - t) * (distance - t) / (b * b));
      };
      const double t = least_place(larger, distance);
      EXPECT_NEAR(touching_spheres(a, b, distance).from_first, t, 1e-12);
      EXPECT_NEAR(touching_spheres(a, b, distance).value, larger(t) - 1, 1e-12);
      EXPECT_NEAR(touching_features(a, b, distance).from_first, t, 1e-12);
      const auto sum = [&](double s) { return s / a + (distance - s) / b; };
      if (a != b) {
        EXPECT_NEAR(unlinked_spheres(a, b, distance), least_place(sum, distance), 1e-12);
      }
    }
}

TEST(PotentialParticles, RoundedFeaturesHaveEqualValuesAndBecomeTheSimpleOnes) {
  for (const double k : {0.0, 0.1, 0.5}) {
    const RoundedForm c = rounded_features(k, 0.35, 1, 0.8);
    const auto q = [&](double t, double part) { return (1 - k) * t * t + k * part; };
    EXPECT_NEAR(q(c.from_first, 0.35), q(c.from_second, 1), 1e-15);
    EXPECT_NEAR(c.from_first + c.from_second, 0.8, 1e-15);
    // the overlap's ends lie on both surfaces
    const double first = std::sqrt((1 - k * 0.35) / (1 - k));
    EXPECT_NEAR(q(first, 0.35), 1, 1e-15);
    EXPECT_NEAR(q(0.8 + c.overlap - first, 1), 1, 1e-14);
  }
  EXPECT_NEAR(rounded_features(0, 0.3, 1, 1.5).from_first, touching_features(1, 1, 1.5).from_first, 1e-15);
  EXPECT_NEAR(rounded_features(0, 0.3, 1, 1.5).overlap, touching_features(1, 1, 1.5).overlap, 1e-15);
  EXPECT_EQ(tilt(0, 1, 1, 1), 0);
  EXPECT_NEAR(tilt(0.5, 0.2, 2, 0.25), 0.2, 1e-15);
}

TEST(PotentialParticles, WithoutTheLinkSquaresAreLeastElsewhere) {
  for (const double a : {0.1, 1.0, 3.0})
    for (const double b : {0.2, 1.0}) {
      const double gap = 0.95 * (a + b);
      const auto squares = [&](double t) { return t * t / (a * a) + (gap - t) * (gap - t) / (b * b); };
      // flat at its minimum: thirds find it to the square root of rounding
      EXPECT_NEAR(unlinked_squares(a, b, gap), least_place(squares, gap), 1e-7);
      EXPECT_NEAR(unlinked_squares(a, b, gap), gap - unlinked_squares(b, a, gap), 1e-15);
      // at the overlap at which the contact is first seen, the point is on the larger body's surface
      const double just = a + b - unseen_overlap(a, b), t = unlinked_squares(a, b, just);
      EXPECT_NEAR(std::max(t / a, (just - t) / b), 1, 1e-14);
    }
  EXPECT_EQ(unseen_overlap(1, 1), 0);
}

TEST(PotentialParticles, ScalesWithItsLengthsAndTouchesAtTheSum) {
  const PotentialContactForm one = touching_features(0.1, 0.3, 0.35), ten = touching_features(1, 3, 3.5);
  EXPECT_NEAR(10 * one.from_first, ten.from_first, 1e-14);
  EXPECT_NEAR(10 * one.overlap, ten.overlap, 1e-14);
  EXPECT_NEAR(one.value, ten.value, 1e-14);
  EXPECT_EQ(touching_spheres(1, 2, 3).value, 0);
  EXPECT_EQ(touching_spheres(1, 2, 3).overlap, 0);
}

}  // namespace
}  // namespace voussoir::reference::contact_test
