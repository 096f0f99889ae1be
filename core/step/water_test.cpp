// Water in the step: floating bodies, their energy balance, rising levels, and identical bits for any threads and
// interruptions.
#include <gtest/gtest.h>

#include <cmath>

#include "core/model/water_surfaces.hpp"
#include "core/run/run.hpp"
#include "core/step.hpp"
#include "core/testing/models.hpp"

namespace voussoir::water_test {
namespace {

using namespace shapes;

constexpr double unit_weight = 1000 * gravity;  // N/m³

// a water of one level on all faces
template <int Dim>
void flood(Model<Dim>& model, double level) {
  std::vector<double> numbers{level, 0, 0};
  if (Dim == 2) numbers = {0, level};
  assign_waters(model, {{"lake", unit_weight, false, numbers}}, {0, 0});
}

// 2 x 1 m (x 3 m), 600 kg/m³, floating in equilibrium: its draught is 0.6 m; there is nothing else, not even a joint's
// stiffness
template <int Dim>
Model<Dim> raft() {
  Vector<Dim> low = -1.5 * Vector<Dim>::Ones();
  low[0] = -1;
  low[Dim - 1] = -0.5;
  Model<Dim> model = model_of<Dim>({make_body<Dim>({block<Dim>(box<Dim>(low, -low))}, 600)});
  model.properties.clear();
  flood(model, 0.1);
  return model;
}

Settings undamped(double step = 0) {
  Settings settings;
  settings.damping.local = 0;
  settings.time.fraction = TimeSettings::most_undamped;
  if (step > 0) settings.time.step = step;
  return settings;
}

template <int Dim>
State<Dim> lifted(const Model<Dim>& model, double by) {
  State<Dim> state = initial_state(model);
  state.bodies.motions[0].displacement[Dim - 1] = by;
  return state;
}

template <int Dim>
void heave() {
  const Model<Dim> model = raft<Dim>();
  const double period = 2 * std::numbers::pi * std::sqrt(0.6 / gravity);  // 1.553893 s
  State<Dim> state = lifted(model, 0.01);
  run(model, undamped(), {.end_time = period / 4}, {}, state);
  EXPECT_NEAR(state.bodies.motions[0].displacement[Dim - 1], 0, 1e-4);
  state = lifted(model, 0.01);
  run(model, undamped(), {.end_time = period / 2}, {}, state);
  EXPECT_NEAR(state.bodies.motions[0].displacement[Dim - 1], -0.01, 2e-5);
  EXPECT_LT(state.ledger.energy.relative_error(), 1e-10);
  EXPECT_NE(state.ledger.energy.flows[Source::water], 0);
  EXPECT_EQ(state.ledger.energy.flows[Source::water_pressure], 0);
  EXPECT_EQ(state.ledger.energy.flows[Source::water_change], 0);
}

// Without a joint or a stated step only the water determines the time step.
TEST(RaftInWater, HeavesInItsPeriodWithAClosedEnergyBalance) {
  heave<2>();
  heave<3>();
}

// Surfaces requested for one model after another, as in a program that runs several scenes, contain nothing of the
// previous one.
TEST(WaterSurfaces, OfAPressureAreThoseOfNoTableBefore) {
  const Model<2> lake = raft<2>();
  Model<2> pressed = raft<2>();
  assign_waters(pressed, {{"joints", unit_weight, true, {1000}}}, {0, 0});
  WaterSurfaces<2> surfaces, fresh;
  find_surfaces(lake, initial_water(lake), 1, surfaces);
  find_surfaces(pressed, initial_water(pressed), 1, surfaces);
  find_surfaces(pressed, initial_water(pressed), 1, fresh);
  const Standing<2> tilted{.centroid = Vector<2>(0, -2)};
  EXPECT_EQ(water_load(pressed, surfaces, 0, tilted).force, water_load(pressed, fresh, 0, tilted).force);
  EXPECT_NEAR(water_load(pressed, surfaces, 0, tilted).force.norm(), 0, 1e-9);  // the same on all sides
  EXPECT_EQ(water_stiffness(pressed, surfaces, 0, tilted).translation,
            water_stiffness(pressed, fresh, 0, tilted).translation);
}

// The work of the water against the change of its potential, from a tilted start out of equilibrium: the error is
// proportional to the square of the step.
TEST(RaftInWater, HasAPotentialThatClosesWithTheSquareOfTheStep) {
  const Model<2> model = raft<2>();
  WaterSurfaces<2> surfaces;
  find_surfaces(model, initial_water(model), 1, surfaces);
  const auto open = [&](double step) {
    State<2> state = lifted(model, 0.15);
    state.bodies.motions[0].rotation.angle = 20 * degree;
    cache_poses(model, 1, state.bodies);
    const double before = water_potential(model, surfaces, 0, standing(state.bodies.poses[0]));
    run(model, undamped(step), {.end_time = 0.4}, {}, state);
    // the ledger's work is up to half a step before these positions
    find_forces(model, undamped(step), state);
    const Load<2>& load = state.loads.by_source[Source::water][0];
    const Spin<2> spin = angular_velocity(model.bodies[0], state.bodies.motions[0]);
    const double last =
        0.5 * state.time_step.length * (load.force.dot(state.bodies.motions[0].velocity) + load.moment.dot(spin));
    const double after = water_potential(model, surfaces, 0, standing(state.bodies.poses[0]));
    return std::abs(state.ledger.energy.flows[Source::water] + last + after - before);
  };
  const double coarse = open(4e-3), middle = open(2e-3), fine = open(1e-3);
  EXPECT_NEAR(std::log2(coarse / middle), 2, 0.1);
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.1);
}

// Unbalanced forces are compared with the force of the water if nothing touches.
TEST(RaftInWater, ReachesEquilibriumByRelaxation) {
  const Model<2> model = raft<2>();
  State<2> state = lifted(model, 0.15);
  state.bodies.motions[0].rotation.angle = 5 * degree;
  const RunReport report = run(model, Settings(), {.rest = true, .step_limit = 100'000}, {}, state);
  EXPECT_EQ(report.reason, StopReason::equilibrium) << describe(report.reason) << " " << report.steps;
  EXPECT_NEAR(state.bodies.motions[0].displacement[1], 0, 1e-5);
  EXPECT_NEAR(state.bodies.motions[0].rotation.angle, 0, 1e-5);
}

// A level on all faces gives Archimedes' force, also summed face by face; two waters have no potential.
TEST(WaterOfTheModel, ActsByVolumeOrByFaces) {
  Model<3> model = raft<3>();
  const Load<3> by_volume = water_loads_at_reference(model).front();
  EXPECT_TRUE(model.water_by_volume);
  EXPECT_NEAR(by_volume.force[2], unit_weight * 2 * 3 * 0.6, 1e-8);
  EXPECT_LT(by_volume.moment.norm(), 1e-9);
  const std::vector<double> level = model.waters[0].values;
  assign_waters(model, {{"a", unit_weight, false, level}, {"b", unit_weight, true, {1000}}}, {1, 0});
  EXPECT_FALSE(model.water_by_volume);
  const Load<3> by_faces = water_loads_at_reference(model).front();
  EXPECT_LT((by_faces.force - by_volume.force).norm(), 1e-12 * by_volume.force.norm());
  EXPECT_LT((by_faces.moment - by_volume.moment).norm(), 1e-12 * by_volume.force.norm());
  assign_waters(model, {{"a", unit_weight, false, level}, {"b", unit_weight, true, {1000}}}, {0, 1});
  EXPECT_LT(water_loads_at_reference(model).front().force.norm(), 1e-8);
  State<3> state = initial_state(model);
  find_forces(model, undamped(), state);
  EXPECT_TRUE(state.loads.by_source[Source::water].empty());
  EXPECT_FALSE(state.loads.by_source[Source::water_pressure].empty());
  model.bodies[0].present = false;
  EXPECT_TRUE(water_loads_at_reference(model).front().force.isZero(0));
}

TEST(WaterOfTheModel, GrowsWithGravity) {
  const Model<2> model = raft<2>();
  State<2> state = initial_state(model);
  state.schedule.gravity_factor = 0.25;
  find_forces(model, undamped(1e-3), state);
  EXPECT_NEAR(state.loads.by_source[Source::water][0].force[1], 0.25 * unit_weight * 2 * 0.6, 1e-8);
  EXPECT_NEAR(state.loads.total[0].force[1], 0, 1e-8);
}

WaterPlan rising(double from, double to, double ramp) {
  return {.water = 0, .from = {0, from}, .to = {0, to}, .ramp = ramp};
}

// Critical damping depends on the response of contacts and water to motion. A block with vertical sides in a rising
// level loses weight as under decreasing gravity: both are imposed, and both must give the same steps. Taken for a
// stiffness, the rise would make bodies that move with it seem unstable, and leave them undamped.
TEST(Relaxation, DoesNotTakeARisingLevelForStiffness) {
  Model<2> wet = block_on_plate<2>(0, 35 * degree), dry = wet;
  flood(wet, 0);
  const int b = index_of(wet, "block");
  constexpr double ramp = 0.05;
  const auto path = [&](const Model<2>& model, const RunSchedule& schedule) {
    State<2> state = initial_state(model);
    run(model, Settings(), {.rest = true}, {}, state);
    state.schedule.started = state.schedule.time;
    std::vector<double> heights;
    RunProgress<2> progress;
    const auto after = [&](const State<2>& now, double) { heights.push_back(now.bodies.motions[b].displacement[1]); };
    run<2>(model, Settings(), {.rest = true}, schedule, state, progress,
           {.with_forces = {}, .after_step = after, .pause = {}});
    return heights;
  };
  const double left = 1 - 1000 / density;
  const std::vector<double> in_water = path(wet, {.water = {rising(0, 0.5, ramp)}});
  const std::vector<double> under_less = path(dry, {.gravity = {.ramp = ramp, .from = 1, .to = left}});
  ASSERT_GT(in_water.size(), 30u);
  const double settled = -under_less.back();
  ASSERT_GT(settled, 0);
  for (std::size_t k = 0; k < std::min(in_water.size(), under_less.size()); ++k)
    ASSERT_NEAR(in_water[k], under_less[k], 2e-3 * settled) << k;
}

// A level that rises over a submerged block adds γ V dh, all of it potential energy.
TEST(WaterThatRises, AddsTheEnergyOfTheBalance) {
  Model<2> model = block_on_plate<2>(0, 35 * degree);
  flood(model, 1);
  State<2> state = initial_state(model);
  run(model, Settings(), {.rest = true}, {}, state);
  state.schedule.started = state.schedule.time;
  run(model, Settings(), {.rest = true}, {.water = {rising(1, 3, 0.02)}}, state);
  EXPECT_EQ(state.schedule.water[0][1], 3);
  EXPECT_NEAR(state.ledger.energy.flows[Source::water_change], unit_weight * 0.5 * 2, 1e-3 * unit_weight);
  EXPECT_LT(state.ledger.energy.relative_error(), 1e-6);
}

// Under a ramp of gravity the water reaches its full weight with the rock, and the ledger counts only displacements.
TEST(WaterThatRises, WithGravityDoesOnlyTheWorkOfDisplacements) {
  Model<2> model = block_on_plate<2>(0, 35 * degree);
  flood(model, 100);
  State<2> state = initial_state(model);
  run(model, Settings(), {.rest = true}, {.gravity = {.ramp = 0.02}}, state);
  const int b = index_of(model, "block");
  const double work = unit_weight * 0.5 * std::abs(state.bodies.motions[b].displacement[1]);
  EXPECT_LT(std::abs(state.ledger.energy.flows[Source::water_change]), 2 * work);
  EXPECT_NEAR(state.bodies.motions[b].displacement[1] * -1e9, (density - 1000) * gravity * 0.5,
              1e-3 * density * gravity);
}

}  // namespace
}  // namespace voussoir::water_test
