// Waves in chains of blocks: worked numbers, limits, and a chain solved at one frequency.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <numbers>

#include "reference/waves/waves.hpp"

namespace voussoir::reference::waves_test {
namespace {

using Complex = std::complex<double>;

enum class End { full_block, half_block, half_joint };

// A chain of unit masses and springs, a wave of amplitude 1 that comes from its far end, which is exact: the amplitude
// of what its end 0 returns.
double returned_by_chain(double blocks, double dashpot, End end) {
  constexpr int count = 60;
  const double theta = std::numbers::pi / blocks, omega = 2 * std::sin(theta);
  const Complex q = std::polar(1.0, -2 * theta), i(0, 1);
  Eigen::MatrixXcd A = Eigen::MatrixXcd::Zero(count, count);
  Eigen::VectorXcd b = Eigen::VectorXcd::Zero(count);
  for (int j = 0; j < count; ++j)
    A(j, j) = 2 - omega * omega;
  for (int j = 0; j + 1 < count; ++j)
    A(j, j + 1) = A(j + 1, j) = -1;
  const Complex c = i * omega * dashpot;
  A(0, 0) = 1 - (end == End::half_block ? 0.5 : 1) * omega * omega + (end == End::half_joint ? 2.0 * c / (2.0 + c) : c);
  const auto comes = [&](int j) { return std::polar(1.0, 2 * theta * j); };
  A(count - 1, count - 1) -= q;
  b[count - 1] = comes(count) - comes(count - 1) * q;
  const Eigen::VectorXcd u = A.partialPivLu().solve(b);
  return std::abs((u[7] - comes(7)) / std::pow(q, 7));
}

TEST(QuietEnds, SolveTheChain) {
  for (const double n : {6.0, 10.0, 20.0, 40.0})
    for (const double dashpot : {1.0, 0.9, 1.2}) {
      EXPECT_NEAR(returned_by_chain(n, dashpot, End::full_block), returned_by_full_block(n, dashpot), 1e-9);
      EXPECT_NEAR(returned_by_chain(n, dashpot, End::half_block), returned_by_half_block(n, dashpot), 1e-9);
      EXPECT_NEAR(returned_by_chain(n, dashpot, End::half_joint), returned_through_half_joint(n, dashpot), 1e-9);
    }
}

TEST(QuietEnds, WorkedNumbers) {
  EXPECT_NEAR(returned_by_full_block(10, 1), 0.158384440, 1e-9);
  EXPECT_NEAR(returned_through_half_joint(10, 1), 0.025085631, 1e-9);
  EXPECT_NEAR(returned_through_half_joint(16, 1), std::pow(std::tan(std::numbers::pi / 32), 2), 1e-15);
  EXPECT_NEAR(returned_through_half_joint(10, 1 / std::cos(std::numbers::pi / 10)), 0, 1e-15);  // tuned to the wave
  EXPECT_NEAR(free_surface(20), 1.975376681, 1e-9);
  EXPECT_NEAR(base_under_wave(40), 1.001544 - 2.87e-7, 1e-9);
}

TEST(Chain, SpeedsOfLongWaves) {
  const BlockChain chain{0.5, 2600, 1e9};
  EXPECT_DOUBLE_EQ(chain.speed(), std::sqrt(1e9 * 0.5 / 2600));
  EXPECT_DOUBLE_EQ(chain.impedance(), 2600 * chain.speed());
  const double many = 1e4;
  EXPECT_NEAR(chain.angular_frequency(many) * many * 0.5 / (2 * std::numbers::pi), chain.speed(), 1e-5);
  // the group speed is dω/dκ
  const double n = 8, step = 1e-6, k = 2 * std::numbers::pi / (n * 0.5);
  const auto at = [&](double wave_number) {
    return chain.angular_frequency(2 * std::numbers::pi / (wave_number * 0.5));
  };
  EXPECT_NEAR((at(k + step) - at(k - step)) / (2 * step), chain.group_speed(n), 1e-6);
}

TEST(SoftJoint, PassesWhatTheExcessOfItsComplianceLeaves) {
  EXPECT_DOUBLE_EQ(passed_by_joint(12, 1), 1);
  EXPECT_NEAR(passed_by_joint(40, 0.1), 0.816031398, 1e-9);
  EXPECT_NEAR(passed_by_joint(10, 0.5), 0.951056516, 1e-9);
  // long waves: the displacement discontinuity of stiffness k kj/(k - kj)
  const double n = 2000, omega = 2 * std::sin(std::numbers::pi / n), excess = 1 / (1 / 0.1 - 1);
  EXPECT_NEAR(passed_by_joint(n, 0.1), 1 / std::hypot(1, omega / (2 * excess)), 1e-9);
}

// A long wave rises at √(ks a/(2ρ)), doubles at the surface and leaves.
TEST(Column, ALongWaveRisesDoublesAndLeaves) {
  const SquareGrid grid{1, 1, 1, 0.5, 40};
  const double speed = grid.shear_speed(), width = 160, step = 0.1;
  std::vector<double> wave;
  for (double t = 0; t < 1200; t += step) {
    const double x = (t - 200) / width;
    wave.push_back(std::abs(x) < 1 ? std::pow(std::cos(0.5 * std::numbers::pi * x), 4) : 0);
  }
  const std::vector<double> found = surface_of_column(grid, wave, step);
  double most = 0, when = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i] > most) {
      most = found[i];
      when = step * static_cast<double>(i);
    }
  EXPECT_DOUBLE_EQ(speed, 0.5);
  EXPECT_NEAR(most, 2, 0.02);
  EXPECT_NEAR(when, 200 + 40 / speed, 2);
  EXPECT_NEAR(found.back(), 0, 1e-3);
}

}  // namespace
}  // namespace voussoir::reference::waves_test
