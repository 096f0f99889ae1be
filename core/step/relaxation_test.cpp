// Relaxation finds the equilibrium of the true motion, in fewer steps, for any masses.
#include "core/step/relaxation.hpp"

#include <gtest/gtest.h>

#include "core/model/state_hash.hpp"
#include "core/run/run.hpp"
#include "core/step.hpp"
#include "core/testing/models.hpp"

namespace voussoir::relaxation_test {
namespace {

using shapes::block_on_plate;
using shapes::body_of;
using shapes::box;
using shapes::gravity;
using shapes::index_of;

// error of a column's overlap in equilibrium: each of its blocks 1e-6 of the mean contact force
constexpr double left_by_rest = 1e-6;

// squares on a fixed base, one above the other, that cannot turn; `heavier`: every other one has this times the density
Model<2> column(int blocks, double heavier = 1) {
  std::vector<Body<2>> bodies{body_of<2>(box<2>({-0.5, -1}, {1.5, 0}), true)};
  for (int i = 0; i < blocks; ++i) {
    const double height = i;
    bodies.push_back(make_body<2>({shapes::block<2>(box<2>({0, height}, {1, height + 1}))},
                                  shapes::density * (i % 2 == 0 ? 1 : heavier)));
    bodies.back().free_rotation.fill(false);
  }
  return shapes::model_of<2>(std::move(bodies));
}

struct Rest {
  RunReport report;
  State<2> state;
};

Rest rest_of(const Model<2>& model, Statics statics, int threads = 1) {
  Settings settings;
  settings.statics.method = statics;
  settings.damping.local = 0.8;
  settings.threads = threads;
  Rest rest{{}, initial_state(model)};
  rest.report = run<2>(model, settings, {.rest = true, .step_limit = 1'000'000}, {}, rest.state);
  EXPECT_EQ(rest.report.reason, StopReason::equilibrium);
  return rest;
}

TEST(Relaxation, AColumnSettlesOnItsSprings) {
  const Model<2> model = column(10);
  const Rest rest = rest_of(model, Statics::adaptive);
  double weight = 0, settled = 0;  // from the top down
  for (std::size_t b = model.bodies.size(); b-- > 1;) {
    weight += model.bodies[b].mass * gravity;
    settled += weight / model.properties[0].normal_stiffness;
  }
  const double top = rest.state.bodies.motions.back().displacement[1];
  EXPECT_NEAR(-top, settled, 10 * 10 * left_by_rest * settled);
}

// a hundred times the mass needs ten times the steps of true motion, but no more of relaxation
TEST(Relaxation, IsTheSameForLightAndHeavyBlocks) {
  const long long even = rest_of(column(10), Statics::adaptive).report.steps,
                  uneven = rest_of(column(10, 100), Statics::adaptive).report.steps,
                  true_motion = rest_of(column(10, 100), Statics::local).report.steps;
  EXPECT_LT(static_cast<double>(uneven), 1.5 * static_cast<double>(even));
  EXPECT_GT(true_motion, 15 * uneven);
}

// One contact outgrows its rating at every step: only its two bodies are estimated again, all at every tenth step.
TEST(Relaxation, RenewsTheInertiaOfTheBodiesOfAnOutgrownContact) {
  const Model<2> model = column(6);
  Settings settings;
  State<2> state = initial_state(model);
  begin_relaxation(state);
  const int settling = 20;
  for (int i = 0; i < settling; ++i)
    step(model, settings, state);
  const auto outgrow = [&] {
    for (Contact<2>& c : state.contacts.list)
      if (model.parts[c.part_a].body == 1 && model.parts[c.part_b].body == 2) c.area_rated = 1e-3;
  };
  const std::vector<double> before = state.time_step.frequency, inertia = state.relaxation.inertia;
  for (double& frequency : state.time_step.frequency)
    frequency *= 2;  // a mark that an estimate overwrites
  std::vector<int> renewed_after(model.bodies.size(), 0);
  for (int i = 1; i <= 10; ++i) {
    outgrow();
    step(model, settings, state);
    for (std::size_t b = 1; b < model.bodies.size(); ++b)
      if (renewed_after[b] == 0 && state.time_step.frequency[b] < 1.5 * before[b]) renewed_after[b] = i;
  }
  const int all = 3;  // renewed at steps 1, 12, 23
  EXPECT_EQ(renewed_after, (std::vector<int>{0, 1, 1, all, all, all, all}));
  for (std::size_t b = 1; b < model.bodies.size(); ++b)
    EXPECT_NEAR(state.relaxation.inertia[b], inertia[b], 1e-9 * inertia[b]) << "the mark is gone";
}

// gravity applied slowly: a block that rotates freely, on a slope that it does not slide down
TEST(Relaxation, ABlockThatMayRotateComesToTheSameEquilibrium) {
  const Model<3> model = block_on_plate<3>(20 * degree, 35 * degree);
  const auto rest = [&](Statics statics) {
    Settings settings;
    settings.statics.method = statics;
    State<3> state = initial_state(model);
    const RunReport report = run<3>(model, settings, {.rest = true, .step_limit = 200'000},
                                    {.gravity = {.ramp = 0.2}, .properties = {}}, state);
    EXPECT_EQ(report.reason, StopReason::equilibrium);
    return state.bodies.motions[index_of(model, "block")].displacement;
  };
  const Vector<3> relaxed = rest(Statics::adaptive), moved = rest(Statics::local);
  // the same path except for the effect of inertia
  EXPECT_LT((relaxed - moved).norm(), 0.01 * moved.norm());
}

TEST(Relaxation, DoesNotDependOnTimeAndThreads) {
  const Model<2> model = column(10);
  const Rest one = rest_of(model, Statics::adaptive), three = rest_of(model, Statics::adaptive, 3);
  EXPECT_EQ(state_hash(model, one.state), state_hash(model, three.state));
  for (const Motion<2>& m : one.state.bodies.motions)
    EXPECT_TRUE(m.velocity.isZero(0) && m.angular_momentum.isZero(0));
}

// the work of weight is in the springs or removed; there is no kinetic energy
TEST(Relaxation, TheEnergyBalanceIsThatOfSprings) {
  const Rest rest = rest_of(column(10), Statics::adaptive);
  const EnergyBalance& e = rest.state.ledger.energy;
  EXPECT_EQ(e.kinetic, 0);
  EXPECT_EQ(e.flows[Source::local_damping], 0);
  EXPECT_LT(e.flows[Source::friction],
            1e-30 * e.flows[Source::gravity]);  // none slips; areas are rounded, and lost area takes its shear
  EXPECT_GT(e.flows[Source::relaxation], 0);
  // springs under a weight store half of its work; the equilibrium tolerance leaves its fraction, the first step of
  // touching faces a little more
  EXPECT_NEAR(e.elastic, 0.5 * e.flows[Source::gravity], 1e-3 * e.elastic);
  EXPECT_NEAR(e.flows[Source::relaxation], 0.5 * e.flows[Source::gravity], 1e-3 * e.elastic);
  EXPECT_LT(e.relative_error(), 1e-3);
}

// after a relaxation bodies start to move from zero: v = g t after the first full kick, no half step ahead
TEST(Relaxation, MotionAfterwardsStartsFromZeroVelocity) {
  Model<2> model = column(1);
  State<2> state = rest_of(model, Statics::adaptive).state;
  Settings settings;
  settings.damping.local = 0;
  settings.time.step = 1e-3;
  model = apply(std::move(model), {.fix = {},
                                   .release = {},
                                   .remove = {{.names = {}, .above = {}, .below = {}, .inside = {{0, -0.5}}}},
                                   .move = {},
                                   .boundary = {},
                                   .friction = {}});
  state.bodies.listed_at.clear();
  const double before = state.bodies.motions[1].displacement[1];
  run<2>(model, settings, {.end_time = state.schedule.time + 0.1}, {}, state);
  EXPECT_NEAR(before - state.bodies.motions[1].displacement[1], 0.5 * gravity * 0.1 * 0.1, 1e-12);
}

}  // namespace
}  // namespace voussoir::relaxation_test
