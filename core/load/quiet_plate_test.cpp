// The plate of a quiet side: its closed forms, energy, and derivative.
#include "core/load/quiet_plate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace voussoir::quiet_plate_test {
namespace {

template <int Dim>
Vector<Dim> drawn(std::mt19937& random) {
  std::uniform_real_distribution<double> from(-1, 1);
  Vector<Dim> v;
  for (double& x : v)
    x = from(random);
  return v;
}

template <int Dim>
QuietPlate<Dim> any_plate(std::mt19937& random) {
  QuietPlate<Dim> plate;
  plate.stiffness = Vector<Dim>::Constant(2e9) + 1e9 * drawn<Dim>(random);
  plate.impedance = Vector<Dim>::Constant(5e6) + 3e6 * drawn<Dim>(random);
  const Vector<2> turn{0.6, 0.8};
  plate.axes.template topLeftCorner<2, 2>() << turn[0], -turn[1], turn[1], turn[0];
  return plate;
}

// A held block: the plate comes back as exp(-K t/C), to the second order in the step.
TEST(QuietPlate, ComesBackExponentially) {
  QuietPlate<2> plate;
  plate.stiffness = {3, 2};
  plate.impedance = {1, 4};
  const Vector<2> none = Vector<2>::Zero();
  double before = 0;
  for (const int steps : {20, 40, 80}) {
    Vector<2> w(1, 1);
    for (int i = 0; i < steps; ++i)
      w = step_of<2>(plate, none, w, none, none, 1.0 / steps).plate;
    const double off = std::abs(w[0] - std::exp(-3));
    EXPECT_NEAR(w[1], std::exp(-0.5), 1e-4);
    if (before > 0) {
      EXPECT_NEAR(before / off, 4, 0.1);
    }
    before = off;
  }
}

// A wave that meets a block which moves with it: w' = v_in, so that what goes out balances half of what comes in.
TEST(QuietPlate, AWaveAloneMovesItAtTwiceItsVelocityWithoutResistance) {
  QuietPlate<2> plate;
  plate.stiffness = {1e-9, 1e-9};  // nearly no block
  plate.impedance = {2, 3};
  const Vector<2> in{0.5, -0.25};
  const PlateStep<2> step = step_of<2>(plate, Vector<2>::Zero(), Vector<2>::Zero(), Vector<2>::Zero(), in, 0.1);
  EXPECT_NEAR(step.plate[0], 2 * 0.1 * 0.5, 1e-9);
  EXPECT_NEAR(step.plate[1], -2 * 0.1 * 0.25, 1e-9);
  EXPECT_NEAR(step.came_in, step.went_out, 1e-9);
}

template <int Dim>
void check_energy(double h) {
  std::mt19937 random(7);
  for (int i = 0; i < 50; ++i) {
    const QuietPlate<Dim> plate = any_plate<Dim>(random);
    const Vector<Dim> u = drawn<Dim>(random), w = drawn<Dim>(random), v = drawn<Dim>(random), in = drawn<Dim>(random);
    const PlateStep<Dim> step = step_of<Dim>(plate, u, w, v, in, h);
    const Vector<Dim> after = u + h * v;
    const double gained = energy_of<Dim>(plate, after, step.plate) - energy_of<Dim>(plate, u, w);
    const double expected = -step.mean_force.dot(h * v) + step.came_in - step.went_out;
    const double scale = energy_of<Dim>(plate, after, step.plate) + energy_of<Dim>(plate, u, w) + step.went_out;
    EXPECT_NEAR(gained, expected, 1e-12 * scale) << h;
    EXPECT_GE(step.went_out, 0);
    const Vector<Dim> mean = 0.5 * (force_of<Dim>(plate, u, w) + force_of<Dim>(plate, after, step.plate));
    EXPECT_LT((mean - step.mean_force).norm(), 1e-9 * (1 + mean.norm() + force_of<Dim>(plate, u, w).norm()));
  }
}

// at any step, resolved or not
TEST(QuietPlate, ItsEnergyIsWhatComesInLessWhatGoesOut) {
  for (const double h : {1e-6, 1e-3, 1.0, 1e3}) {
    check_energy<2>(h);
    check_energy<3>(h);
  }
}

template <int Dim>
void check_derivative() {
  std::mt19937 random(11);
  const QuietPlate<Dim> plate = any_plate<Dim>(random);
  const Vector<Dim> u = drawn<Dim>(random), w = drawn<Dim>(random), v = drawn<Dim>(random), in = drawn<Dim>(random);
  const double h = 2e-3;
  const PlateStep<Dim> step = step_of<Dim>(plate, u, w, v, in, h);
  for (int k = 0; k < Dim; ++k) {
    const Vector<Dim> more = v + Vector<Dim>::Unit(k);  // the force is linear in it
    const Vector<Dim> change = step_of<Dim>(plate, u, w, more, in, h).mean_force - step.mean_force;
    EXPECT_LT((change - step.by_velocity.col(k)).norm(), 1e-9 * step.mean_force.norm());
    EXPECT_LT(step.by_velocity(k, k), 0);
  }
  EXPECT_LT((step.by_velocity - step.by_velocity.transpose()).norm(), 1e-12 * step.by_velocity.norm());
}

TEST(QuietPlate, ItsDerivativeIsThatOfItsForce) {
  check_derivative<2>();
  check_derivative<3>();
}

// an unresolved step: the block meets the dashpot alone, -Z v
TEST(QuietPlate, OverALongStepTheDashpotAloneResists) {
  QuietPlate<2> plate;
  plate.stiffness = {1e12, 1e12};
  plate.impedance = {5e6, 3e6};
  const Vector<2> none = Vector<2>::Zero(), v{1, 1};
  const PlateStep<2> step = step_of<2>(plate, none, none, v, none, 1);
  EXPECT_NEAR(step.mean_force[0], -5e6, 5e6 * 2e-5);
  EXPECT_NEAR(step.mean_force[1], -3e6, 3e6 * 2e-5);
}

}  // namespace
}  // namespace voussoir::quiet_plate_test
