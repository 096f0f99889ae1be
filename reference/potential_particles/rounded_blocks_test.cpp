#include "reference/potential_particles/rounded_blocks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace voussoir::reference::rounded_blocks_test {
namespace {

TEST(FaceBulge, IsFlatWithoutASphereAndAlmostTheSphereAtItsEnd) {
  EXPECT_NEAR(face_bulge(0.4, 0.1, 0, 1).height, 0.1, 1e-16);
  EXPECT_TRUE(std::isinf(face_bulge(0.4, 0.1, 0, 1).curvature_radius));
  const FaceBulge ball = face_bulge(0.4, 0.1, 1 - 1e-12, 1);
  EXPECT_NEAR(0.4 + ball.height, 1, 1e-9);
  EXPECT_NEAR(ball.curvature_radius, 1, 1e-8);
}

// points of the surface beside the middle, by bisection of f
TEST(FaceBulge, IsTheCurvatureOfPointsBesideTheMiddle) {
  const double plane = 0.3, r = 0.2, k = 0.4, R = 0.8;
  const auto surface = [&](double y) {
    double low = plane, high = R;
    for (int i = 0; i < 200; ++i) {
      const double x = (low + high) / 2, u = x - plane;
      ((1 - k) * u * u / (r * r) + k * (x * x + y * y) / (R * R) < 1 ? low : high) = x;
    }
    return low;
  };
  const FaceBulge bulge = face_bulge(plane, r, k, R);
  EXPECT_NEAR(plane + bulge.height, surface(0), 1e-15);
  const double y = 1e-3;
  EXPECT_NEAR(y * y / (2 * (surface(0) - surface(y))) / bulge.curvature_radius, 1, 1e-5);
}

// The forces of the formula on a block in the position that it gives: springs, and the moment about the centroid.
TEST(RoundedHingedBeam, IsInEquilibrium) {
  for (const double midspan : {50e6, 100e6, 300e6}) {
    const RoundedHingedBeam model{{}, midspan, 0.004};
    const double length = model.beam.length, r = model.corner_radius, a = length / 2 - r, b = model.beam.depth / 2 - r;
    for (const double turn : {0.02, 0.1, 0.2}) {
      const HingedBeamLoad load = rounded_hinged_beam(model, turn);
      const double c = std::cos(turn), s = std::sin(turn);
      // clockwise: the lower left corner's arc moves out to the left, the upper right one's to the right
      const double left[2] = {-a * c - b * s, a * s - b * c}, right[2] = {a * c + b * s, -a * s + b * c};
      const double at_wall = load.thrust / model.beam.stiffness, at_midspan = load.thrust / midspan;
      EXPECT_NEAR((right[0] - left[0] + 2 * r - length) / (at_wall + at_midspan / 2), 1, 1e-12);
      // the wall's point of contact is r less half the overlap beyond the arc's centre
      const double moment = (right[1] - left[1]) * load.thrust + (left[0] - r + at_wall / 2) * load.weight;
      EXPECT_NEAR(moment / (load.thrust * model.beam.depth), 0, 1e-12);
    }
  }
}

// initial slope of the path: δ = (L2 - 2 r) θ/2, W = K θ (L2 - 2 r)²/L1
TEST(RoundedHingedBeam, BeginsAsALinearBeamAndTendsToTheSharpHinge) {
  const HingedBeam beam;
  const double turn = 1e-6, inner = beam.depth - 0.01;
  EXPECT_NEAR(rounded_hinged_beam({beam, beam.stiffness / 2, 0.005}, turn).weight /
                  (beam.stiffness * turn * inner * inner / beam.length),
              1, 1e-4);
  // the peak falls in proportion to r
  const double sharp = rounded_hinged_beam_peak({}).weight;
  const auto slope = [&](double r) { return (1 - rounded_hinged_beam_peak({beam, 50e6, r}).weight / sharp) / r; };
  EXPECT_GT(slope(1e-5), 0);
  EXPECT_NEAR(slope(1e-5) / slope(5e-6), 1, 1e-2);
}

TEST(RoundedHingedBeam, ScalesWithLengthAndStiffness) {
  const HingedBeam one, large{10 * one.length, 10 * one.depth, 3 * one.stiffness};
  EXPECT_NEAR(rounded_hinged_beam_peak({large, 150e6, 0.05}).weight,
              30 * rounded_hinged_beam_peak({one, 50e6, 0.005}).weight, 1e-3);
  EXPECT_THROW(rounded_hinged_beam({one, 50e6, one.depth / 2}, 0.1), std::invalid_argument);
}

// one block on another of its kind: stable while half its height is less than the radius about which it rolls
TEST(RoundedColumn, OneBlockStandsOnHalfItsHeight) {
  EXPECT_NEAR(least_joint_radius(1), 0.5, 1e-14);
  EXPECT_GT(least_joint_radius(2), least_joint_radius(1));
}

// the heights of the centroids themselves, of arcs that roll on each other, at small tilts
double energy(const std::vector<double>& tilts, double radius) {
  const double face = 2 * radius, h = 1;  // of either face
  double last = 0, z = 0, sum = 0;
  for (const double tilt : tilts) {
    z += (h / 2 - face) * (std::cos(last) + std::cos(tilt)) + 2 * face * std::cos((last + tilt) / 2);
    sum += z;
    last = tilt;
  }
  return sum;
}

TEST(RoundedColumn, IsTheRadiusAtWhichSomeTiltLowersTheCentroids) {
  const int blocks = 4;
  const double least = least_joint_radius(blocks);
  // the worst of many tilts of one small length, by a coordinate search
  const auto worst = [&](double radius) {
    std::vector<double> tilts(blocks, 5e-4);
    const auto gain = [&](std::vector<double> t) {
      double length = 0;
      for (const double x : t)
        length += x * x;
      for (double& x : t)
        x *= 1e-3 / std::sqrt(length);
      return energy(t, radius) - energy(std::vector<double>(blocks, 0.0), radius);
    };
    for (double step = 2e-4; step > 1e-8; step /= 1.5)
      for (int round = 0; round < 40; ++round)
        for (double& x : tilts)
          for (const double sign : {1.0, -1.0}) {
            const double before = gain(tilts);
            x += sign * step;
            if (gain(tilts) >= before) x -= sign * step;
          }
    return gain(tilts);
  };
  EXPECT_GT(worst(1.02 * least), 0);
  EXPECT_LT(worst(0.98 * least), 0);
}

}  // namespace
}  // namespace voussoir::reference::rounded_blocks_test
