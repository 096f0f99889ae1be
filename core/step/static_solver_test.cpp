// The implicit static solver finds the equilibria of relaxation, in a number of iterations that does not grow with the
// number of blocks; it leaves unsupported problems to relaxation; its bits are the same for any interruption and any
// threads.
#include "core/step/static_solver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/on_threads.hpp"
#include "core/joint_laws/joint_law.hpp"
#include "core/model/state_hash.hpp"
#include "core/run/run.hpp"
#include "core/run/simulate.hpp"
#include "core/step/loads.hpp"
#include "core/testing/models.hpp"
#include "core/testing/stacks.hpp"
#include "core/testing/whole_runs.hpp"
#include "text/angle.hpp"

namespace voussoir::static_solver_test {
namespace {

using shapes::block_on_plate;
using shapes::body_of;
using shapes::box;
using shapes::brick_wall;
using shapes::column_of_squares;
using shapes::gravity;
using shapes::index_of;

constexpr double rounding = 1e-9;  // relative displacement in relaxation's window of ten steps

// ---- equilibrium -------
// ----------------------------------------------------------------------------------------------------

template <int Dim>
std::pair<RunReport, State<Dim>> rest_of(const Model<Dim>& model, Statics statics, int threads = 1,
                                         const RunSchedule& schedule = {}, int increments = 1) {
  Settings settings;
  settings.statics.method = statics;
  settings.statics.increments = increments;
  settings.threads = threads;
  State<Dim> state = initial_state(model);
  const RunReport report = run<Dim>(model, settings, {.rest = true, .step_limit = 1'000'000}, schedule, state);
  EXPECT_EQ(report.reason, StopReason::equilibrium) << report.detail;
  return {report, std::move(state)};
}

// Linear springs: the full weight in one increment, for any height. Stiff enough that no step is shortened.
void expect_columns_take_as_many_iterations(const std::vector<int>& heights) {
  for (const int blocks : heights) {
    Model<2> model = column_of_squares(blocks);
    model.properties[0].normal_stiffness = 26000 * gravity * blocks / 1e-3;  // overlaps up to a millimetre
    const auto [report, state] = rest_of(model, Statics::newton);
    double weight = 0, settled = 0;  // from the top down
    for (std::size_t b = model.bodies.size(); b-- > 1;) {
      weight += model.bodies[b].mass * gravity;
      settled += weight / model.properties[0].normal_stiffness;
    }
    EXPECT_NEAR(-state.bodies.motions.back().displacement[1], settled, rounding * settled) << blocks;
    EXPECT_LE(state.counters.static_iterations, 15) << blocks;
    EXPECT_EQ(state.counters.static_fallbacks, 0) << blocks;
    // including the ten steps of relaxation that confirm it
    EXPECT_LE(state.counters.contact_evaluations, 100 * blocks) << blocks;
    EXPECT_LT(state.ledger.energy.relative_error(), 1e-9) << "the mean of the loads at both ends is exact for springs";
  }
}

TEST(Newton, AColumnOfAnyHeightTakesTheSameIterations) {
  expect_columns_take_as_many_iterations({10, 100, 1000});
}

// with 10,000 blocks the middle is compressed only after more iterations than the number for which closed joints count
// as stiff
TEST(NewtonLong, AColumnOfAnyHeightTakesTheSameIterations) {
  expect_columns_take_as_many_iterations({10'000, 20'000});
}

// Joints between bricks of a course have almost no force, and open and close as the wall settles.
void expect_walls_take_as_many_evaluations_a_pair(const std::vector<int>& sizes) {
  std::vector<double> a_pair, blocks;
  for (const int courses : sizes) {
    const Model<2> model = brick_wall(courses);
    const auto [report, state] = rest_of(model, Statics::newton);
    const auto touching = std::count_if(state.contacts.list.begin(), state.contacts.list.end(),
                                        [](const Contact<2>& c) { return c.touching(); });
    a_pair.push_back(static_cast<double>(state.counters.contact_evaluations) / static_cast<double>(touching));
    blocks.push_back(static_cast<double>(model.bodies.size() - 1));
    EXPECT_EQ(state.counters.static_fallbacks, 0) << courses;
    EXPECT_LE(state.counters.linear_iterations, 2 * state.counters.static_iterations) << "the factors are complete";
    EXPECT_LT(a_pair.back(), 50) << courses;
  }
  EXPECT_LT(a_pair.back() / a_pair.front(), std::pow(blocks.back() / blocks.front(), 0.15));
}

TEST(Newton, AWallOfAnySizeTakesTheSameEvaluationsPerPair) {
  expect_walls_take_as_many_evaluations_a_pair({5, 17});
}

TEST(NewtonLong, AWallOfAnySizeTakesTheSameEvaluationsPerPair) {
  expect_walls_take_as_many_evaluations_a_pair({5, 55, 141});
}

template <int Dim>
void expect_same_rest(const Model<Dim>& model, double allowed) {
  const auto [marched, by_steps] = rest_of(model, Statics::adaptive);
  const auto [found, by_newton] = rest_of(model, Statics::newton);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].fixed) continue;
    const Vector<Dim>& expected = by_steps.bodies.motions[b].displacement;
    EXPECT_LT((by_newton.bodies.motions[b].displacement - expected).norm(), allowed * expected.norm()) << b;
  }
  EXPECT_GT(by_newton.counters.static_iterations, 0);
  EXPECT_EQ(by_newton.counters.static_fallbacks, 0);
  EXPECT_LT(found.steps, marched.steps);
}

// error of relaxation: 1e-6 of the contact force, and the shear lost by slip in its oscillations
TEST(Newton, ABlockOnASlopeHasTheEquilibriumOfRelaxation) {
  expect_same_rest<2>(block_on_plate<2>(20 * degree, 35 * degree), 1e-4);
  expect_same_rest<3>(block_on_plate<3>(20 * degree, 35 * degree), 1e-4);
}

TEST(Newton, EverySubContactHasItsStiffness) {
  for (Model<3> model : {block_on_plate<3>(20 * degree, 35 * degree), block_on_plate<3>(0, 35 * degree)}) {
    model.properties[0].sub_contacts = 3;
    expect_same_rest<3>(model, 1e-3);
  }
}

// A sliding block is followed up to the displacement that the run states, not declared to fail.
TEST(Newton, ASlideIsFollowed) {
  const Model<2> model = block_on_plate<2>(30 * degree, 20 * degree);
  Settings settings;
  settings.statics.method = Statics::newton;
  State<2> state = initial_state(model);
  const RunReport report =
      run<2>(model, settings, {.rest = true, .step_limit = 100'000, .moved_away = 0.05}, {}, state);
  EXPECT_EQ(report.reason, StopReason::moved_away);
  EXPECT_GT(state.bodies.motions[index_of(model, "block")].displacement.norm(), 0.05);
}

TEST(Newton, AppliesGravityInIncrements) {
  const Model<2> model = block_on_plate<2>(20 * degree, 35 * degree);
  const RunSchedule ramp{.gravity = {.ramp = 2}, .properties = {}};
  const auto [one, at_once] = rest_of(model, Statics::newton, 1, ramp);
  const auto [four, in_four] = rest_of(model, Statics::newton, 1, ramp, 4);
  const int block = index_of(model, "block");
  EXPECT_EQ(in_four.schedule.gravity_factor, 1);
  EXPECT_GE(in_four.schedule.time, 2);
  EXPECT_GT(in_four.counters.static_iterations, at_once.counters.static_iterations);
  EXPECT_LT((in_four.bodies.motions[block].displacement - at_once.bodies.motions[block].displacement).norm(),
            1e-6 * at_once.bodies.motions[block].displacement.norm())
      << "nothing slips in between";
}

// ---- loads that change with the pose -------------------------------------------------------------------------------

Model<3> loaded_block() {
  Model<3> model = block_on_plate<3>(20 * degree, 35 * degree);
  const int block = index_of(model, "block");
  model.applied = {{.name = "keeps", .body = block, .place = {0.2, -0.1, 0.3}, .force = {2e3, 1e3, -4e3}, .factor = {}},
                   {.name = "turns",
                    .body = block,
                    .place = {-0.3, 0.2, 0.1},
                    .force = {1e3, -2e3, -1e3},
                    .turns_with_body = true,
                    .factor = {}}};
  model.boundary = {{block, {{{0.1, 0.2, 0.25}, {1e3, 500, -3e3}}, {{0, -0.3, 0.1}, {0, 2e3, -1e3}}}}};
  return model;
}

TEST(Newton, KnowsTheChangeOfLoadsWithThePose) {
  const Model<3> model = loaded_block();
  const int block = index_of(model, "block");
  State<3> state = initial_state(model);
  const auto load_at = [&](const Spin<3>& turn) {
    State<3> turned_state = state;
    turned_state.bodies.motions[block].rotation = turned(state.bodies.motions[block].rotation, turn);
    cache_poses(model, 1, turned_state.bodies);
    sum_loads(model, Settings(), turned_state.schedule, turned_state.bodies, turned_state.contacts,
              turned_state.supports, turned_state.loads);
    Eigen::Matrix<double, 6, 1> load;
    load << turned_state.loads.total[block].force, turned_state.loads.total[block].moment;
    return load;
  };
  state.bodies.motions[block].rotation = turned(state.bodies.motions[block].rotation, Spin<3>(0.3, -0.2, 0.1));
  cache_poses(model, 1, state.bodies);
  const auto stiffness = load_stiffness(model, state);
  constexpr double step = 1e-5;
  for (int s = 0; s < 3; ++s) {
    const Spin<3> e = step * Spin<3>::Unit(s);
    const Eigen::Matrix<double, 6, 1> slope = (load_at(e) - load_at(-e)) / (2 * step);
    EXPECT_LT((stiffness[block].col(3 + s) + slope).norm(), 1e-7 * slope.norm()) << s;
    EXPECT_EQ(stiffness[block].col(s).norm(), 0) << "no load changes with the position";
  }
  EXPECT_TRUE(
      load_stiffness(block_on_plate<3>(0, 35 * degree), initial_state(block_on_plate<3>(0, 35 * degree))).empty());
}

TEST(Newton, ForcesAtALeverHaveTheEquilibriumOfRelaxation) {
  Model<3> model = loaded_block();
  model.properties[0].sub_contacts = 3;
  expect_same_rest<3>(model, 2e-3);
}

// ---- no equilibrium -----------------------------------------------------------------------------------------------

template <int Dim>
RunReport no_rest_of(const Model<Dim>& model) {
  Settings settings;
  settings.statics.method = Statics::newton;
  State<Dim> state = initial_state(model);
  return run<Dim>(model, settings, {.rest = true, .step_limit = 20'000}, {}, state);
}

TEST(Newton, ABlockWithoutSupportIsNamed) {
  Model<2> model = block_on_plate<2>(0, 35 * degree);
  std::vector<Body<2>> bodies = model.bodies;
  bodies.push_back(body_of<2>(box<2>({20, 0}, {21, 1}), false, "over nothing"));
  const RunReport report = no_rest_of(shapes::model_of<2>(std::move(bodies)));
  EXPECT_EQ(report.reason, StopReason::falls_free);
  EXPECT_NE(report.detail.find("over nothing"), std::string::npos) << report.detail;
}

TEST(Newton, AMechanismIsNamed) {
  Model<2> model = block_on_plate<2>(20 * degree, 0);  // without friction, for unlimited sliding
  const RunReport report = no_rest_of(model);
  EXPECT_NE(report.reason, StopReason::equilibrium);
  EXPECT_NE(report.detail.find("block"), std::string::npos) << report.detail;
}

// The face has one contact point: nothing resists a rotation about the normal. A couple that rotates with the block
// spins it without bound, although its centroid does not move.
TEST(Newton, ABodyThatRotatesFreelyIsNamed) {
  Model<3> model = block_on_plate<3>(0, 35 * degree);
  const int block = index_of(model, "block");
  for (const double side : {0.5, -0.5})
    model.applied.push_back({.name = "couple",
                             .body = block,
                             .place = {side, 0, 0},
                             .force = {0, 400 * side, 0},
                             .turns_with_body = true,
                             .factor = {}});
  const RunReport report = no_rest_of(model);
  EXPECT_EQ(report.reason, StopReason::step_limit);
  EXPECT_NE(report.detail.find("block"), std::string::npos) << report.detail;
  EXPECT_NE(report.detail.find("rotated by"), std::string::npos) << report.detail;
}

// The face has one contact point, and nothing rotates the block.
TEST(Newton, AFreeRotationWithoutLoadIsInEquilibrium) {
  const auto [report, state] = rest_of(block_on_plate<3>(0, 35 * degree), Statics::newton);
  EXPECT_EQ(state.counters.static_fallbacks, 0);
}

// ---- joint laws -----------------------------------------------------------------------------------------------------

void stiffen_by_stress(JointProperties& joint) {
  joint.laws.normal = joint.laws.shear = StiffnessLaw::linear;
  joint.normal_growth = 3e4;
  joint.shear_growth = 1e4;
}

void stiffen_by_a_power(JointProperties& joint) {
  joint.laws.normal = joint.laws.shear = StiffnessLaw::power;
  joint.normal_stiffness = 1e6;
  joint.shear_stiffness = 5e5;
  joint.normal_exponent = joint.shear_exponent = 0.5;
}

void harden(JointProperties& joint) {
  joint.laws.friction = FrictionLaw::hardening;
  joint.hardening_slip = 1e-6;
}

// each joint closes under the weight above it, by its own law
TEST(Newton, AColumnClosesByStressDependentStiffness) {
  for (const auto& law : {stiffen_by_stress, stiffen_by_a_power}) {
    Model<2> model = column_of_squares(30);
    law(model.properties[0]);
    const auto [report, state] = rest_of(model, Statics::newton);
    double weight = 0, settled = 0;  // from the top down
    for (std::size_t b = model.bodies.size(); b-- > 1;) {
      weight += model.bodies[b].mass * gravity;
      settled += overlap_at(model.properties[0], weight);
    }
    EXPECT_NEAR(-state.bodies.motions.back().displacement[1], settled, 1e-6 * settled) << "unbalanced forces";
    EXPECT_EQ(state.counters.static_fallbacks, 0);
    EXPECT_GT(state.counters.static_iterations, 0);
  }
}

TEST(Newton, OtherLawsHaveTheEquilibriumOfRelaxation) {
  for (const auto& law : {stiffen_by_stress, stiffen_by_a_power, harden}) {
    Model<3> model = block_on_plate<3>(20 * degree, 35 * degree);
    law(model.properties[0]);
    model.properties[0].laws.shear = StiffnessLaw::constant;  // one that varies depends on the path: below
    expect_same_rest<3>(model, 1e-3);
    model.properties[0].sub_contacts = 2;
    expect_same_rest<3>(model, 1e-3);
  }
}

// Shear and normal stress grow together, so that du = dτ/ks(σ) can be integrated. An increment adds all of its shear at
// the stiffness of its end.
TEST(Newton, ShearWithStressDependentStiffnessConvergesInIncrements) {
  const double slope = 20 * degree;
  Model<2> model = block_on_plate<2>(slope, 35 * degree);
  const int block = index_of(model, "block");
  model.bodies[block].free_rotation.fill(false);
  JointProperties& joint = model.properties[0];
  stiffen_by_stress(joint);
  const double normal = model.bodies[block].mass * gravity * std::cos(slope);  // a face of 1 m
  const double shear = std::tan(slope) * normal, last = joint.shear_stiffness + joint.shear_growth * normal;
  const double exact = shear / (last - joint.shear_stiffness) * std::log(last / joint.shear_stiffness);
  const Vector<2> down(std::cos(slope), std::sin(slope));
  for (const int increments : {1, 4, 16}) {
    const RunSchedule ramp{.gravity = {.ramp = 1}, .properties = {}};
    const auto [report, state] = rest_of(model, Statics::newton, 1, ramp, increments);
    const double slip = std::abs(state.bodies.motions[block].displacement.dot(down));
    EXPECT_LT(slip, exact) << increments;
    EXPECT_GT(slip, exact - (shear / joint.shear_stiffness - shear / last) / increments)
        << "error of a sum for an integral";
  }
}

// Joints that soften are left to relaxation, to the bit.
TEST(Newton, LeavesSofteningToRelaxation) {
  Model<2> model = block_on_plate<2>(20 * degree, 35 * degree);
  JointProperties& joint = model.properties[0];
  joint.laws.friction = FrictionLaw::softening;
  joint.softening_drop = joint.softening_slip = 0.1;
  EXPECT_FALSE(newton_follows(joint));
  const auto [marched, by_steps] = rest_of(model, Statics::adaptive);
  const auto [found, by_newton] = rest_of(model, Statics::newton);
  EXPECT_EQ(by_newton.counters.static_iterations, 0);
  EXPECT_EQ(state_hash(model, by_newton), state_hash(model, by_steps));
}

// Blocks that will be bonded with tensile strength first close by tension over normal stiffness, as far as their weight
// closes the lowest of them, without any force on that path.
TEST(Newton, AColumnClosesByTheOffsetOfItsBonds) {
  Model<2> model = column_of_squares(30);
  JointProperties& joint = model.properties[0];
  joint.laws.bond = true;
  joint.constant_stiffness = false;
  joint.normal_stiffness = joint.shear_stiffness = 1e9;
  const double largest = model.bodies.back().mass * gravity * 30;  // N, and Pa on faces of 1 m2
  joint.tension = largest;
  const auto [report, state] = rest_of(model, Statics::newton);
  const double closed = 30 * joint.tension / joint.normal_stiffness;
  const double settled = closed + largest / joint.normal_stiffness * 31 / 2;
  EXPECT_NEAR(-state.bodies.motions.back().displacement[1], settled, 1e-6 * settled) << "unbalanced forces";
  EXPECT_EQ(state.counters.static_fallbacks, 0);
}

// ---- the same bits --------------------------------------------------------------------------------------------------

TEST(Newton, ThreadsChangeNoBit) {
  Model<2> model = column_of_squares(2 * too_few_for_a_team);
  model.properties[0].normal_stiffness *= 1e3;
  const auto [report, one] = rest_of(model, Statics::newton);
  for (const int threads : {2, 7})
    EXPECT_EQ(state_hash(model, rest_of(model, Statics::newton, threads).second), state_hash(model, one)) << threads;
}

TEST(Newton, MayBeInterruptedAfterEveryEvaluation) {
  Prepared<2> scene;
  scene.model = block_on_plate<2>(20 * degree, 35 * degree);
  scene.state = initial_state(scene.model);
  scene.settings.statics.method = Statics::newton;
  scene.settings.statics.increments = 3;
  StagePlan settle;
  settle.name = "settle";
  settle.plan = SettlePlan{.gravity = {.ramp = 1}};
  scene.stages.push_back(settle);
  const Progress<2> whole = simulated(scene);
  const long long steps = whole.state.counters.steps;
  ASSERT_GT(whole.state.counters.static_iterations, 3);
  for (long long k = 0; k < steps; ++k) {
    EXPECT_EQ(continued(scene, k).results.state_hash, whole.results.state_hash) << "interrupted after step " << k;
  }
}

}  // namespace
}  // namespace voussoir::static_solver_test
