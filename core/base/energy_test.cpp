// The energy balance: both parts on closed forms and on an assembly that collapses.
#include "core/base/energy.hpp"

#include <gtest/gtest.h>

#include "core/step.hpp"
#include "core/testing/models.hpp"

namespace voussoir::energy_test {
namespace {

using shapes::block_on_plate;
using shapes::density;
using shapes::gravity;
using shapes::index_of;
using shapes::model_of;

// roundings of some thousand steps, each an ulp of the largest energy
constexpr double rounding = 1e-12;

// an overlap of some 1e-5 m has an error of an ulp of the block's size
constexpr double overlap_rounding = 1e-9;

template <int Dim>
EnergyBalance energy_after(const Model<Dim>& model, const Settings& settings, int steps, State<Dim>& state) {
  for (int i = 0; i < steps; ++i)
    step(model, settings, state);
  return state.ledger.energy;
}

// a linear spring: leapfrog keeps ½ m v₋·v₊ + ½ k x² to rounding at any step
template <int Dim>
void expect_exact_oscillation() {
  Model<Dim> model = block_on_plate<Dim>(0, 35 * degree);
  model.properties[0].constant_stiffness = true;
  model.bodies[index_of(model, "block")].free_rotation.fill(false);
  Settings settings;
  settings.damping.local = 0;
  State<Dim> state = initial_state(model);
  const double deep = 3 * model.bodies[index_of(model, "block")].mass * gravity / 1e9;  // never lifts off
  state.bodies.motions[index_of(model, "block")].displacement[Dim - 1] = -0.5 * deep;
  const EnergyBalance e = energy_after(model, settings, 2000, state);
  EXPECT_GT(e.largest_energy, 0);
  EXPECT_LT(std::abs(e.motion_error), rounding * e.largest_energy);
  EXPECT_LT(e.relative_error(), overlap_rounding);
  EXPECT_EQ(e.external(), 0);
  EXPECT_EQ(e.damping(), 0);
}

TEST(EnergyBalance, AnOscillationOnLinearSpringsClosesToRounding) {
  expect_exact_oscillation<3>();
  expect_exact_oscillation<2>();
}

// the work of the weight becomes kinetic energy and friction
template <int Dim>
void expect_sliding_balance() {
  const double slope = 30 * degree, friction = 20 * degree;
  Model<Dim> model = block_on_plate<Dim>(slope, friction);
  const int block = index_of(model, "block");
  model.bodies[block].free_rotation.fill(false);
  State<Dim> state = initial_state(model);
  Vector<Dim> up = Vector<Dim>::Zero();
  up[0] = -std::sin(slope);
  up[Dim - 1] = std::cos(slope);
  state.bodies.motions[block].displacement = -density * 0.5 * gravity * std::cos(slope) / 1e9 * up;
  Settings settings;
  settings.damping.local = 0;
  const EnergyBalance e = energy_after(model, settings, 4000, state);
  const double slid = state.bodies.motions[block].displacement.norm();
  const double resistance = std::tan(friction) * model.bodies[block].mass * gravity * std::cos(slope);
  EXPECT_NEAR(e.flows[Source::friction], resistance * slid,
              0.02 * resistance * slid);  // except for the elastic slip at first
  EXPECT_NEAR(-e.potential(), model.bodies[block].mass * gravity * std::sin(slope) * slid, 0.02 * e.largest_energy);
  EXPECT_LT(std::abs(e.motion_error), rounding * e.largest_energy);
  EXPECT_LT(e.relative_error(), 1e-3);
}

TEST(EnergyBalance, ASlidingBlockLosesItsFrictionTimesItsPath) {
  expect_sliding_balance<3>();
  expect_sliding_balance<2>();
}

TEST(EnergyBalance, InEquilibriumDampingHasTakenTheEnergyNotStoredInSprings) {
  Model<3> model = block_on_plate<3>(0, 35 * degree);
  model.properties[0].constant_stiffness = true;
  Settings settings;
  settings.time.step = 1e-4;
  State<3> state = initial_state(model);
  const EnergyBalance e = energy_after(model, settings, 5000, state);
  const double weight = density * 0.5 * gravity, settlement = weight / 1e9, half = 0.5 * weight * settlement;
  EXPECT_NEAR(e.elastic, half, 1e-6 * half);
  EXPECT_NEAR(e.potential(), -2 * half, 1e-6 * half);
  EXPECT_NEAR(e.damping(), half, 0.01 * half);  // the force is found late when the block first touches
  EXPECT_NEAR(e.kinetic, 0, 1e-9 * half);
  EXPECT_LT(e.relative_error(), 0.01);
}

TEST(EnergyBalance, GravityThatGrowsIsExternalWork) {
  // in equilibrium under half its weight, then half the weight more: the ramp acts on the settlement that is already
  // there
  Model<2> model = block_on_plate<2>(0, 35 * degree);
  model.properties[0].constant_stiffness = true;
  State<2> state = initial_state(model);
  state.schedule.gravity_factor = 0.5;
  energy_after<2>(model, {}, 3000, state);
  const double sunk = -state.bodies.motions[index_of(model, "block")].displacement[1];
  state.schedule.gravity_factor = 1;
  const EnergyBalance e = energy_after<2>(model, {}, 3000, state);
  EXPECT_NEAR(e.external(), -0.5 * density * 0.5 * gravity * sunk, 1e-9 * e.largest_energy);
  EXPECT_LT(e.relative_error(), 1e-9);
}

TEST(EnergyBalance, AChangeOfTheModelIsExternalWork) {
  // a falling block is stopped: its motion is removed from the model
  Model<2> model = block_on_plate<2>(0, 35 * degree);
  const int block = index_of(model, "block");
  model.bodies[block].reference[1] += 10;
  Settings settings;
  settings.time.step = 1e-3;
  settings.damping.local = 0;
  State<2> state = initial_state(model);
  const EnergyBalance before = energy_after(model, settings, 500, state);
  EXPECT_GT(before.kinetic, 0);
  state.bodies.motions[block].velocity.setZero();
  state.ledger.energy.phase = BalancePhase::model_changed;
  const EnergyBalance after = energy_after(model, settings, 1, state);
  EXPECT_NEAR(after.external(), -before.kinetic, 0.01 * before.kinetic);
  EXPECT_LT(after.relative_error(), rounding);
}

// rotation, slip, local damping, dashpots, steps that change: the motion's energy balance closes all the same
TEST(EnergyBalance, ClosesWhenAnAssemblyCollapses) {
  const Model<3> model = model_of<3>(shapes::jointed_box(), 10 * degree);
  for (const bool viscous : {false, true}) {
    Settings settings;
    settings.damping.local = viscous ? 0 : 0.3;
    settings.damping.viscous_ratio = viscous ? 0.2 : 0;
    State<3> state = initial_state(model);
    const EnergyBalance e = energy_after(model, settings, 3000, state);
    EXPECT_GT(e.flows[Source::friction], 0);
    EXPECT_GT(e.damping(), 0);
    EXPECT_LT(std::abs(e.motion_error), rounding * e.largest_energy);
    EXPECT_LT(e.relative_error(), 0.01);
  }
}

}  // namespace
}  // namespace voussoir::energy_test
