// Prescribed motion: path as stated in the scene, work in the energy balance, end with its stage, continuation after an
// interruption.
#include "core/step/prescribed.hpp"
#include "core/load/time_factor.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/testing/end_bytes.hpp"
#include "core/testing/models.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::prescribed_test {
namespace {

using shapes::block_on_plate;
using shapes::index_of;

// rounding errors of some thousand steps, each an ulp of the largest value
constexpr double rounding = 1e-12;

// an overlap of about 1e-5 m has an error of an ulp of the block's size
constexpr double overlap_rounding = 1e-9;

template <int Dim>
MovePlan move_of(const std::string& body, int axis, double velocity, const TimeFactor& factor = {}) {
  MovePlan plan;
  plan.bodies.names = {body};
  plan.velocity.assign(Dim, 0);
  plan.velocity[axis] = velocity;
  plan.translation.fill(true);
  plan.factor = factor;
  return plan;
}

StagePlan run_of(const std::string& name, double duration, std::vector<MovePlan> moves = {}) {
  StagePlan stage;
  stage.name = name;
  stage.plan = RunPlan{.duration = duration};
  stage.change.move = std::move(moves);
  return stage;
}

template <int Dim>
Prepared<Dim> scene_of(const Model<Dim>& model, std::vector<StagePlan> stages, double step) {
  Prepared<Dim> scene;
  scene.model = model;
  scene.state = initial_state(model);
  scene.stages = std::move(stages);
  scene.settings.damping.local = 0;
  scene.settings.time.step = step;
  return scene;
}

TEST(TimeFactor, IsLinearBetweenItsTimesAndTimesASine) {
  const TimeFactor table{.times = {1, 2, 4}, .factors = {10, 20, -20}};
  const double expected[][2] = {{0, 10}, {1, 10}, {1.5, 15}, {2, 20}, {3, 0}, {4, -20}, {9, -20}};
  for (const auto& [time, value] : expected)
    EXPECT_DOUBLE_EQ(value_at(table, time), value) << time;
  EXPECT_EQ(value_at({}, 3), 1);
  const TimeFactor sine{.times = {0, 1}, .factors = {0, 2}, .frequency = 5, .phase = 90 * degree};
  EXPECT_NEAR(value_at(sine, 0.5), std::cos(5 * std::numbers::pi), rounding);
}

// a joint compressed by a prescribed displacement: force, work and spring energy are those of the spring
template <int Dim>
void expect_press() {
  Model<Dim> model = block_on_plate<Dim>(0, 35 * degree);
  model.properties[0].constant_stiffness = true;
  model.gravity.setZero();
  const double stiffness = model.properties[0].normal_stiffness, speed = 1e-2, duration = 0.05;
  const int block = index_of(model, "block");
  MovePlan push = move_of<Dim>("block", Dim - 1, -speed);
  model.bodies[block].free_rotation.fill(false);
  const Progress<Dim> end = whole_run(scene_of(model, {run_of("push", duration, {push})}, 1e-5));
  const State<Dim>& state = end.state;
  const double way = -state.bodies.motions[block].displacement[Dim - 1];
  EXPECT_NEAR(way, speed * state.schedule.time, rounding);
  // forces and ledger are those before the last step's drift
  const double pressed = way - speed * state.time_step.length, work = 0.5 * stiffness * pressed * pressed;
  EXPECT_NEAR(state.loads.total[block].force[Dim - 1], stiffness * pressed, 1e-9 * stiffness * pressed);
  EXPECT_NEAR(state.ledger.energy.elastic, work, 1e-8 * work);
  const double half_a_step_on = 0.5 * state.time_step.length * speed * stiffness * pressed;
  EXPECT_NEAR(state.ledger.energy.flows[Source::prescribed_motion], work + half_a_step_on, 1e-8 * work);
  EXPECT_LT(state.ledger.energy.relative_error(), overlap_rounding);
}

TEST(Prescribed, CompressesAJointAndCountsItsWork) {
  expect_press<3>();
  expect_press<2>();
}

// only the named axis is prescribed: along the other the block is as free as before
TEST(Prescribed, LeavesTheOtherDirectionsFree) {
  Model<2> model = block_on_plate<2>(0, 35 * degree);
  model.gravity = {3, 0};
  const int block = index_of(model, "block");
  MovePlan lift = move_of<2>("block", 1, 0.5);
  lift.translation = {false, true, false};
  const Progress<2> end = whole_run(scene_of(model, {run_of("lift", 0.2, {lift})}, 1e-3));
  EXPECT_NEAR(end.state.bodies.motions[block].displacement[1], 0.5 * end.state.schedule.time, rounding);
  EXPECT_NEAR(end.state.bodies.motions[block].displacement[0], 1.5 * end.state.schedule.time * end.state.schedule.time,
              1e-12);
  EXPECT_LT(end.state.ledger.energy.relative_error(), rounding);
}

// a shaking base: its displacement is the integral of the stated velocity, a block that sticks moves with it, and the
// energy balance closes
template <int Dim>
void expect_shaken() {
  const Model<Dim> model = block_on_plate<Dim>(0, 60 * degree);
  const int block = index_of(model, "block"), plate = index_of(model, "plate");
  Model<Dim> still = model;
  still.bodies[block].free_rotation.fill(false);
  const TimeFactor sine{.times = {}, .factors = {}, .frequency = 2, .phase = 0};
  Prepared<Dim> scene =
      scene_of(still, {run_of("settle", 0.2), run_of("shake", 1.1, {move_of<Dim>("plate", 0, 0.1, sine)})}, 5e-5);
  scene.settings.damping.viscous_ratio = 0.1;
  const Progress<Dim> end = whole_run(scene);
  const double shaken = end.state.schedule.time - end.state.schedule.started;
  const double way = 0.1 / (4 * std::numbers::pi) * (1 - std::cos(4 * std::numbers::pi * shaken));
  EXPECT_NEAR(end.state.bodies.motions[plate].displacement[0], way,
              1e-9);  // the error of the midpoint rule is (ω dt)²/24 of 16 mm
  EXPECT_EQ(end.state.bodies.motions[plate].displacement[Dim - 1], 0);
  // the block's acceleration of ω v shears the joint by micrometres
  EXPECT_NEAR(end.state.bodies.motions[block].displacement[0], way, 2e-5);
  EXPECT_LT(end.state.ledger.energy.relative_error(), 1e-3);
}

TEST(Prescribed, ShakesABase) {
  expect_shaken<3>();
  expect_shaken<2>();
}

// contacts of a moving fixed block are found: it meets a free block and another fixed one, far from its start, whether
// the list of neighbours contains them from the start or has to be renewed
TEST(Prescribed, MeetsBlocksInItsPath) {
  using shapes::body_of;
  using shapes::box;
  Model<2> model = shapes::model_of<2>({body_of<2>(box<2>({-3, -1}, {3, 0}), true, "plate"),
                                        body_of<2>(box<2>({-2, 0.3}, {-1, 1.3}), false, "block"),
                                        body_of<2>(box<2>({1, 0.3}, {2, 1.3}), true, "stop")});
  model.gravity.setZero();
  for (const double skin : {0.1, 2.0}) {
    Prepared<2> scene = scene_of(model, {run_of("rise", 0.301, {move_of<2>("plate", 1, 1)})}, 1e-5);
    scene.settings.contact.skin = skin;
    const Progress<2> end = whole_run(scene);
    EXPECT_EQ(std::count_if(end.state.contacts.list.begin(), end.state.contacts.list.end(),
                            [](const Contact<2>& c) { return c.touching(); }),
              2)
        << skin;
  }
}

// nothing can be damped between two blocks that both cannot move
TEST(Prescribed, OverlapsAFixedBlockUnderDashpots) {
  Model<2> model = block_on_plate<2>(0, 35 * degree);
  model.bodies[index_of(model, "block")].fixed = true;
  Prepared<2> scene = scene_of(model, {run_of("press", 0.01, {move_of<2>("block", 1, -1e-2)})}, 1e-4);
  scene.settings.damping.viscous_ratio = 0.5;
  const Progress<2> end = whole_run(scene);
  ASSERT_TRUE(end.state.contacts.list.front().touching());
  const ContactGeometry<2>& at = end.state.contacts.list.front().geometry;
  EXPECT_NEAR(end.state.contacts.list.front().force[1], model.properties[0].normal_stiffness * at.overlap * at.area,
              1e-3);
}

// two squares on their corners, side by side: their boxes always meet, so only the displacement decides when the pair
// is examined
TEST(Prescribed, ExaminesAPairThatWasProvenApart) {
  const Matrix<2> turn = matrix(Rotation<2>{45 * degree});
  const auto square = [&](double at, bool fixed, const char* name) {
    return shapes::body_of<2>(shapes::placed<2>(shapes::cube<2>(0.5), turn, {at, at}), fixed, name);
  };
  Model<2> model = shapes::model_of<2>({square(0, true, "moved"), square(0.8, false, "block")});
  model.gravity.setZero();
  const Progress<2> end = whole_run(scene_of(model, {run_of("near", 0.186, {move_of<2>("moved", 0, 1)})}, 1e-5));
  // the gap of 0.8 √2 - 1 closes at 1/√2 m/s
  ASSERT_EQ(end.state.contacts.list.size(), 1u);
  EXPECT_TRUE(end.state.contacts.list[0].touching());
}

TEST(Prescribed, RotatesABlockInThreeDimensions) {
  Model<3> model = block_on_plate<3>(0, 35 * degree);
  model.gravity.setZero();
  const int block = index_of(model, "block");
  MovePlan turn;
  turn.bodies.names = {"block"};
  turn.angular_velocity = {0, 0, 2};
  MovePlan away = move_of<3>("plate", 2, -1);
  const Progress<3> end = whole_run(scene_of(model, {run_of("turn", 0.4, {turn, away})}, 1e-3));
  EXPECT_NEAR(rotation_vector(end.state.bodies.motions[block].rotation)[2], 2 * end.state.schedule.time, 1e-11);
  EXPECT_NEAR(angular_velocity(model.bodies[block], end.state.bodies.motions[block])[2], 2, rounding);
}

// for any step the stage ends at its stated time
TEST(Prescribed, MovesByItsVelocityTimesDuration) {
  Model<2> model = block_on_plate<2>(0, 35 * degree);
  model.gravity.setZero();
  const int block = index_of(model, "block");
  for (const double step : {1.0, 0.1, 0.03, 0.007, 1e-4}) {
    const std::vector<MovePlan> lift = {move_of<2>("block", 1, 0.5)};
    const Progress<2> end = whole_run(scene_of(model, {run_of("up", 0.1, lift), run_of("on", 0.3, lift)}, step));
    EXPECT_EQ(end.results.stages[0].time, 0.1) << step;
    EXPECT_EQ(end.state.schedule.time, 0.1 + 0.3) << step;
    EXPECT_NEAR(end.state.bodies.motions[block].displacement[1], 0.5 * 0.4, rounding) << step;
    const double steps = std::ceil(0.1 / step - 1e-6) + std::ceil(0.3 / step - 1e-6);
    EXPECT_EQ(end.state.counters.steps, static_cast<long long>(steps)) << step;
  }
}

// being fixed in the next stage does not revoke the slip of the last step
TEST(Prescribed, LeavesAllItsSlipInTheJoint) {
  Model<2> model = block_on_plate<2>(0, 40 * degree);
  model.gravity.setZero();
  const int block = index_of(model, "block");
  model.bodies[block].free_translation.fill(false);
  model.bodies[block].free_rotation.fill(false);
  MovePlan move = move_of<2>("block", 1, -2e-3);
  move.velocity[0] = 1e-3;
  const Progress<2> end = whole_run(scene_of(model, {run_of("press", 0.0095, {move}), run_of("hold", 1e-3)}, 1e-3));
  const double way = 1e-3 * 0.0095;
  EXPECT_NEAR(end.state.bodies.motions[block].displacement[0], way, rounding);
  EXPECT_NEAR(end.state.loads.total[block].force[0], -model.properties[0].shear_stiffness * way, 1e-6 * 5e8 * way);
}

TEST(Prescribed, EndsWithItsStage) {
  Model<2> model = block_on_plate<2>(0, 35 * degree);
  model.gravity.setZero();
  model.bodies[index_of(model, "block")].free_translation[0] = false;
  const int block = index_of(model, "block"), plate = index_of(model, "plate");
  const std::vector<MovePlan> both = {move_of<2>("block", 1, 1), move_of<2>("plate", 1, -1)};
  const Prepared<2> scene = scene_of(model, {run_of("part", 0.1, both), run_of("fly", 0.1)}, 1e-3);
  const Progress<2> end = whole_run(scene);
  EXPECT_NEAR(end.state.bodies.motions[block].displacement[1], end.state.schedule.time,
              rounding);                                      // free, it keeps moving
  EXPECT_EQ(end.state.bodies.motions[plate].velocity[1], 0);  // fixed, it stops
  const Model<2> last = apply(apply(model, scene.stages[0].change), scene.stages[1].change);
  EXPECT_TRUE(last.prescribed.empty());
  EXPECT_FALSE(last.bodies[block].free_translation[0]);
  EXPECT_TRUE(last.bodies[block].free_translation[1]);
  EXPECT_TRUE(last.bodies[plate].immobile());
}

// the complete final state, except the clock
TEST(Prescribed, ContinuesFromACheckpoint) {
  const Model<2> model = block_on_plate<2>(0, 35 * degree);
  const TimeFactor factor{.times = {0, 0.01}, .factors = {0, 1}, .frequency = 30, .phase = 0.3};
  const Prepared<2> scene =
      scene_of(model, {run_of("shake", 0.02, {move_of<2>("plate", 0, 0.3, factor)}), run_of("rest", 0.005)}, 1e-4);
  const std::string expected = end_of(whole_run(scene));
  for (long long k = 0; k < 250; k += 7) {
    ASSERT_TRUE(end_of(continued(scene, k)) == expected) << "interrupted after step " << k;
  }
}

}  // namespace
}  // namespace voussoir::prescribed_test
