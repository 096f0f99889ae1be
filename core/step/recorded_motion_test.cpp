// Blocks that follow records: the displacement of the integrated record at every step, whatever the step.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/load/ground_motion.hpp"
#include "core/step.hpp"
#include "core/step/prescribed.hpp"
#include "core/testing/models.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::recorded_motion_test {
namespace {

using shapes::block_on_plate;
using shapes::index_of;

constexpr double pi = std::numbers::pi;

template <int Dim>
MovePlan plate_along(std::vector<RecordedMotion> records) {
  MovePlan plan;
  plan.bodies.names = {"plate"};
  plan.velocity.assign(Dim, 0);
  plan.records = std::move(records);
  return plan;
}

template <int Dim>
Prepared<Dim> shaken(const Model<Dim>& model, const MovePlan& move, double duration, double step) {
  Prepared<Dim> scene;
  scene.model = model;
  scene.state = initial_state(model);
  StagePlan stage;
  stage.name = "shake";
  stage.plan = RunPlan{.duration = duration};
  stage.change.move = {move};
  scene.stages = {stage};
  scene.settings.damping.local = 0;
  scene.settings.time.step = step;
  return scene;
}

std::shared_ptr<const GroundMotion> motion_of(MotionQuantity quantity, double interval,
                                              const std::vector<double>& values,
                                              const RecordTreatment& treatment = {}) {
  return std::make_shared<const GroundMotion>(make_ground_motion(quantity, interval, values, treatment));
}

std::vector<double> irregular(int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
    values.push_back(std::sin(0.7 * i) + 0.5 * std::cos(1.3 * i * i));
  return values;
}

// every step of the explicit integration, with steps shorter and longer than the record's interval
TEST(RecordedMotion, IsTheIntegratedRecordAtEveryStep) {
  const Model<3> still = block_on_plate<3>(0, 60 * std::numbers::pi / 180);
  const auto motion = motion_of(MotionQuantity::acceleration, 0.01, irregular(60), {.pad = 0.03});
  for (const double step : {1e-4, 7.3e-4, 0.0127, 0.04}) {
    SCOPED_TRACE(step);
    Model<3> model = apply(still, Change{.move = {plate_along<3>({{{1, 0, 0}, motion}})}});
    model.gravity.setZero();
    const int plate = index_of(model, "plate");
    const PrescribedMotion<3>& prescribed = model.prescribed.front();
    Motion<3> moved = initial_state(model).bodies.motions[plate];
    double time = 0;
    for (int k = 0; time < 0.8; ++k) {
      Kick<3> kick;
      const StepTimes times{(k == 0 ? 0.5 : 1) * step, step};
      apply_prescribed_motion<3>(model.bodies[plate], prescribed, {}, time + 0.5 * step, times, moved, kick);
      time += step;
      ASSERT_NEAR(moved.displacement[0], path_between(*motion, 0, time), 1e-14) << time;
      ASSERT_EQ(moved.displacement[1], 0);
    }
  }
}

// two components at an angle, in a run, beyond the record's end
TEST(RecordedMotion, AddsComponentsInARun) {
  const Model<3> model = block_on_plate<3>(0, 60 * std::numbers::pi / 180);
  const auto along = motion_of(MotionQuantity::acceleration, 0.01, irregular(40), {.baseline = Baseline::end});
  const auto across = motion_of(MotionQuantity::velocity, 0.013, irregular(20), {.scale = 0.1});
  const MovePlan move = plate_along<3>({{{0.6, 0.8, 0}, along}, {{0, 0, 1}, across}});
  const Progress<3> end = whole_run(shaken(model, move, 0.5, 2e-4));
  const Vector<3>& displacement = end.state.bodies.motions[index_of(model, "plate")].displacement;
  const double d = path_between(*along, 0, 0.5);
  EXPECT_NEAR(displacement[0], 0.6 * d, 1e-12);
  EXPECT_NEAR(displacement[1], 0.8 * d, 1e-12);
  EXPECT_NEAR(displacement[2], path_between(*across, 0, 0.5), 1e-12);
  EXPECT_NEAR(d, 0, 1e-12);  // the correction's end
}

// A recorded sine against the sine of a factor: with values at an interval h its velocity differs by (ωh)²/12, and the
// factor's midpoint rule by (ω dt)²/24 of its displacement.
TEST(RecordedMotion, ASineIsThatOfTheFactor) {
  Model<2> model = block_on_plate<2>(0, 60 * std::numbers::pi / 180);
  model.bodies[index_of(model, "block")].free_rotation.fill(false);
  const double omega = 4 * pi, interval = 0.002, step = 5e-5, speed = 0.1, duration = 1.1;
  std::vector<double> values;
  for (int i = 0; i <= 600; ++i)
    values.push_back(speed * std::sin(omega * interval * i));
  const MovePlan recorded = plate_along<2>({{{1, 0}, motion_of(MotionQuantity::velocity, interval, values)}});
  MovePlan sine = plate_along<2>({});
  sine.velocity = {speed, 0};
  sine.factor = {.times = {}, .factors = {}, .frequency = 2, .phase = 0};
  const int plate = index_of(model, "plate"), block = index_of(model, "block");
  const auto end_of = [&](const MovePlan& move) {
    Prepared<2> scene = shaken(model, move, duration, step);
    scene.settings.damping.viscous_ratio = 0.1;
    return whole_run(scene);
  };
  const Progress<2> a = end_of(recorded), b = end_of(sine);
  const double bound =
      (omega * omega * interval * interval / 12 + omega * omega * step * step / 24) * 2 * speed / omega;
  EXPECT_NEAR(a.state.bodies.motions[plate].displacement[0], b.state.bodies.motions[plate].displacement[0], bound);
  // a block that sticks to the plate follows it
  EXPECT_NEAR(a.state.bodies.motions[block].displacement[0], b.state.bodies.motions[block].displacement[0], 2 * bound);
  EXPECT_GT(std::abs(a.state.bodies.motions[plate].displacement[0]), 100 * bound);
  EXPECT_NEAR(a.state.ledger.energy.relative_error(), b.state.ledger.energy.relative_error(), 1e-6);
}

}  // namespace
}  // namespace voussoir::recorded_motion_test
