// Modes of blocks on joints against worked numbers, limits and second derivations.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "reference/modes/modes.hpp"

namespace voussoir::reference::modes_test {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr SwayingBlock tall{1, 2, 2600, 1e10, 5e9, 9.81}, cube{1, 1, 2600, 1e10, 5e9, 0};

TEST(AxialModes, OneAndTwoBlocks) {
  EXPECT_DOUBLE_EQ(axial_mode(1, 1), 1);
  // x² - 3x + 1 = 0: the golden ratio and its inverse
  EXPECT_NEAR(axial_mode(2, 1), (std::sqrt(5.0) - 1) / 2, 1e-15);
  EXPECT_NEAR(axial_mode(2, 2), (std::sqrt(5.0) + 1) / 2, 1e-15);
}

// the tridiagonal matrix 2, -1, with 1 at the free end, applied to the shape sin((2j-1) π i/(2n+1))
TEST(AxialModes, SolveTheChain) {
  constexpr int n = 10;
  for (int j = 1; j <= n; ++j) {
    const auto at = [&](int i) { return std::sin((2 * j - 1) * std::numbers::pi * i / (2 * n + 1)); };
    const double w = axial_mode(n, j);
    for (int i = 1; i <= n; ++i) {
      const double force = i < n ? 2 * at(i) - at(i - 1) - at(i + 1) : at(i) - at(i - 1);
      EXPECT_NEAR(force, w * w * at(i), 1e-14) << j << ' ' << i;
    }
  }
}

// second differences of the exact energy in 40 digits
TEST(SwayModes, WorkedNumbers) {
  const SwayModes modes = sway_modes(tall, false);
  EXPECT_NEAR(std::sqrt(modes.vertical) / turn, 220.7081954082, 1e-9);
  EXPECT_NEAR(std::sqrt(modes.lower) / turn, 51.37018697632, 1e-9);
  EXPECT_NEAR(std::sqrt(modes.upper) / turn, 299.8558183564, 1e-9);
  SwayingBlock weightless = tall;
  weightless.gravity = 0;
  EXPECT_NEAR(std::sqrt(sway_modes(weightless, false).lower) / turn, 51.37163137165, 1e-9);
}

TEST(SwayModes, LoseTheirHoldWhereTheWeightTurnsTheJoint) {
  const double least = least_normal_stiffness(tall);
  EXPECT_NEAR(least, 612144, 1e-6);
  for (const double part : {0.9, 1.1}) {
    SwayingBlock soft = tall;
    soft.normal_stiffness = part * least;
    soft.shear_stiffness = soft.normal_stiffness / 2;
    EXPECT_EQ(sway_modes(soft, false).lower < 0, part < 1);
    EXPECT_NEAR(std::sqrt(std::abs(sway_modes(soft, false).lower)), 0.83, 0.01);
  }
}

// a shear spring that is much stiffer than rocking: the block turns about the joint's centre
TEST(SwayModes, TurnAboutARigidHinge) {
  SwayingBlock hinged = tall;
  hinged.gravity = 0;
  hinged.shear_stiffness = 1e7 * hinged.normal_stiffness;
  const double mass = 5200, about_hinge = mass * (1.0 + 4.0) / 12 + mass;
  EXPECT_NEAR(sway_modes(hinged, false).lower, 1e10 / 12 / about_hinge, 1e-6 * 1e10 / 12 / about_hinge);
}

TEST(BendingModes, WorkedNumbers) {
  const double expected[][4] = {{2, 48.1187038826, 218.4685798745, 427.7415552282},
                                {5, 10.3540073976, 59.5366866553, 147.5615099865},
                                {10, 2.8644212920, 17.4994096363, 47.0117031593},
                                {20, 0.7532220557, 4.6881472565, 12.9735064167},
                                {50, 0.1242084024, 0.7775162748, 2.1727426717}};
  for (const auto& row : expected) {
    const int blocks = static_cast<int>(row[0]);
    const std::vector<double> modes = bending_modes(cube, blocks, 2 * blocks);
    for (int k = 0; k < 3; ++k) {
      // the numbers' last digits, and rounding of the matrix, which is that of its largest eigenvalue
      const double spread = std::pow(modes.back() / modes[k], 2);
      EXPECT_NEAR(modes[k] / turn / row[k + 1], 1, 1e-9 + 4 * std::numeric_limits<double>::epsilon() * spread)
          << blocks;
    }
  }
}

TEST(BendingModes, OneBlockSways) {
  const SwayModes one = sway_modes(cube, false);
  const std::vector<double> modes = bending_modes(cube, 1, 2);
  EXPECT_NEAR(modes[0], std::sqrt(one.lower), 1e-12 * modes[0]);
  EXPECT_NEAR(modes[1], std::sqrt(one.upper), 1e-12 * modes[1]);
}

// a beam of EI = kn I H and mass per length ρ b: ω L² √(ρb/EI) = 3.5160; shear and rotary inertia lower long ones
// little
TEST(BendingModes, ApproachTheBeam) {
  constexpr int n = 300;
  const double bending = 1e10 / 12, mass = 2600;
  const double length = n, beam = 3.516015 / (length * length) * std::sqrt(bending / mass);
  EXPECT_NEAR(bending_modes(cube, n, 1)[0] / beam, 1, 0.005);
}

TEST(BendingModes, ScaleWithTheRootOfStiffness) {
  SwayingBlock stiff = cube;
  stiff.normal_stiffness *= 4;
  stiff.shear_stiffness *= 4;
  EXPECT_NEAR(bending_modes(stiff, 7, 1)[0], 2 * bending_modes(cube, 7, 1)[0], 1e-9);
}

}  // namespace
}  // namespace voussoir::reference::modes_test
