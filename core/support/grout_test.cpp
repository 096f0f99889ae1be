// The grouted bar against closed forms of pull-out and joint opening, its own energy balance and random histories.
#include "core/support/grout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/testing/counted_allocations.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::grout_test {
namespace {

using shapes::power_of_ten;
using shapes::Random;
using shapes::uniform;

// a bar of 25 mm, 200 GPa, in stiff grout, 3 m long
GroutedBar steel_bar(double spacing, std::span<const double> joints = {}) {
  GroutedBar bar;
  bar.axial_stiffness = 98e6;
  bar.bond_stiffness = 200e6;
  lay_nodes(3, joints, spacing, bar);
  return bar;
}

// rock from `position` on, 0, and before it, `opened` out of the hole
std::vector<double> opened_at(const GroutedBar& bar, double position, double opened) {
  std::vector<double> rock;
  for (const double s : bar.position)
    rock.push_back(s < position ? -opened : 0);
  return rock;
}

// the first element whose end is behind this place
int rod_across(const GroutedBar& bar, double position) {
  int i = 0;
  while (bar.position[i + 1] < position)
    ++i;
  return i;
}

struct LoadedBar {
  GroutedBar bar;
  GroutedBarState state;
  GroutWorkspace workspace;
  double work = 0, dissipated = 0, stored = 0, turnover = 0;
  int most_iterations = 0;

  explicit LoadedBar(GroutedBar b)
      : bar(std::move(b)), state(installed(bar, std::vector<double>(bar.position.size()))) {}
  void add(const GroutStep& step) {
    ASSERT_TRUE(step.converged);
    EXPECT_GE(step.dissipated, 0);
    work += step.work;
    dissipated += step.dissipated;
    stored = step.stored;
    most_iterations = std::max(most_iterations, step.iterations);
    // Every term is known to an ulp, every node is out of balance by no more than 32 ulps of the forces of
    // displacements.
    const double terms = static_cast<double>(bar.position.size());
    turnover += terms * (std::abs(step.work) + step.stored + step.dissipated) +
                32 * terms * stiffest() * furthest() * furthest();
  }
  double stiffest() const {  // N/m, spring
    double k = 0;
    for (std::size_t i = 0; i < bar.position.size(); ++i) {
      if (i > 0) k = std::max(k, bar.axial_stiffness / (bar.position[i] - bar.position[i - 1]));
      k = std::max(k, bar.bond_stiffness * bar.bond_length[i]);
    }
    return k;
  }
  double furthest() const {  // m, that bar and rock have moved in the last step
    double most = 0;
    for (std::size_t i = 0; i < bar.position.size(); ++i)
      most = std::max(most, std::abs(workspace.move[i]) + std::abs(workspace.rock_move[i]));
    return most;
  }
  void move(std::span<const double> rock) { add(move_rock(bar, rock, state, workspace)); }
  void open(double position, double opened) { move(opened_at(bar, position, opened)); }

  void expect_balance() const {
    EXPECT_NEAR(work, stored + dissipated, std::numeric_limits<double>::epsilon() * turnover);
    if (work != 0) worst_balance = std::max(worst_balance, std::abs(stored + dissipated - work) / std::abs(work));
  }
  static inline double worst_balance = 0;
};

void expect_second_order(const std::vector<double>& errors) {
  for (std::size_t i = 1; i < errors.size(); ++i)
    EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), 2, 0.1) << errors[i - 1] << " then " << errors[i];
}

// ---- closed forms ---------------------------------------------------------------------------------------------------

double pull_out_stiffness(const GroutedBar& bar, double length) {
  return std::sqrt(bar.axial_stiffness * bar.bond_stiffness) *
         std::tanh(length * std::sqrt(bar.bond_stiffness / bar.axial_stiffness));
}

TEST(Grout, NodesAreTheMiddlesOfCellsBetweenJoints) {
  const double joints[] = {1};
  const GroutedBar bar = steel_bar(0.75, joints);
  EXPECT_EQ(bar.position, (std::vector<double>{0, 0.25, 0.75, 1 + 1.0 / 3, 2, 2 + 2.0 / 3}));
  EXPECT_EQ(bar.bond_length, (std::vector<double>{0, 0.5, 0.5, 2.0 / 3, 2.0 / 3, 2.0 / 3}));
}

TEST(Grout, PullsOutAsStiffAsTheClosedForm) {
  std::vector<double> errors;
  for (const double spacing : {0.2, 0.1, 0.05}) {
    GroutedBar bar = steel_bar(spacing);
    bar.plate = Plate::tied;
    LoadedBar test(bar);
    test.open(1e-9, 1e-3);  // the collar alone
    errors.push_back(std::abs(test.state.plate_force / 1e-3 / pull_out_stiffness(bar, 3) - 1));
  }
  EXPECT_LT(errors[1], 0.01);
  expect_second_order(errors);
  RecordProperty("error at 0.1 m", std::to_string(errors[1]));
}

TEST(Grout, OpeningJointMeetsItsHalvesInSeries) {
  for (const double joint : {1.5, 0.7}) {
    std::vector<double> errors;
    for (const double spacing : {0.1, 0.05, 0.025}) {
      LoadedBar test(steel_bar(spacing, {&joint, 1}));
      test.open(joint, 1e-3);
      const double exact =
          1e-3 / (1 / pull_out_stiffness(test.bar, joint) + 1 / pull_out_stiffness(test.bar, 3 - joint));
      errors.push_back(std::abs(test.state.bar_force[rod_across(test.bar, joint)] / exact - 1));
      // both sides are drawn together
      double near = 0, far = 0;
      for (std::size_t i = 0; i < test.bar.position.size(); ++i)
        (test.bar.position[i] < joint ? near : far) += test.state.bond_force[i];
      EXPECT_NEAR(near, exact, 0.02 * exact);
      EXPECT_NEAR(near, -far, 1e-12 * exact);
    }
    EXPECT_LT(errors[0], 0.01);
    expect_second_order(errors);
    RecordProperty("error at 0.1 m, joint at " + std::to_string(joint), std::to_string(errors[0]));
  }
}

// Rigid, plastic bond: the force is exact when a cell has just begun to slip and linear between, the square root of
// the opening is not.
TEST(Grout, OpeningJointSlipsAlongARigidPlasticBond) {
  const double joint = 1.5, strength = 200e3;
  std::vector<double> errors;
  for (const double spacing : {0.1, 0.05, 0.025}) {
    GroutedBar bar = steel_bar(spacing, {&joint, 1});
    bar.bond_stiffness = 1e13;
    bar.bond_strength = strength;
    LoadedBar test(bar);
    const double most = 0.9 * strength * 1.5 * 1.5 / bar.axial_stiffness;
    double error = 0;
    for (int i = 1; i <= 2000; ++i) {
      const double opened = most * i / 2000;
      test.open(joint, opened);
      if (i < 500) continue;
      const double exact = std::sqrt(bar.axial_stiffness * strength * opened);
      error = std::max(error, std::abs(test.state.bar_force[rod_across(test.bar, joint)] / exact - 1));
    }
    errors.push_back(error);
    test.expect_balance();
  }
  EXPECT_LT(errors[0], 0.01);
  // the largest error falls on the cell that begins to slip at the quarter, whose number is not quite doubled
  for (std::size_t i = 1; i < errors.size(); ++i)
    EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), 2, 0.4) << errors[i - 1] << " then " << errors[i];
  RecordProperty("error at 0.1 m", std::to_string(errors[0]));
}

// ---- plasticity -----------------------------------------------------------------------------------------------------

// a bar so stiff that its 3 m of bond act as one spring of k l, which slips at S l; beyond it only residual stiffness
// acts
TEST(Grout, BondYieldsAndYieldsBackwards) {
  GroutedBar bar = steel_bar(0.25);
  bar.axial_stiffness = 98e12;
  bar.bond_strength = 100e3;  // at 0.5 mm
  bar.plate = Plate::tied;
  LoadedBar test(bar);
  const double stiffness = 200e6 * 3, most = 100e3 * 3;
  const double accuracy = 1e-5;  // the bar's own extension, l²k/EA, is 2e-5 / 3
  const auto force_at = [&](double out) {
    test.open(1e-9, out);
    return test.state.plate_force;
  };
  EXPECT_NEAR(force_at(0.4e-3), 0.4e-3 * stiffness, accuracy * most);
  EXPECT_NEAR(force_at(2e-3), most, accuracy * most);
  EXPECT_NEAR(force_at(1.7e-3), most - 0.3e-3 * stiffness, accuracy * most);
  EXPECT_NEAR(force_at(0.5e-3), -most, accuracy * most);
  EXPECT_NEAR(test.state.slip[3], -1e-3, 1e-8);  // the bar extends by N l/EA = 9e-9
  test.expect_balance();

  // in small steps that is the force times the slip: error below most times a step
  LoadedBar slow(bar);
  for (int i = 1; i <= 2000; ++i)
    slow.open(1e-9, 1e-6 * i);
  EXPECT_NEAR(slow.dissipated, most * 1.5e-3, most * 1e-6);
  slow.expect_balance();
}

TEST(Grout, BarYields) {
  GroutedBar bar = steel_bar(0.1);
  bar.plate = Plate::tied;
  bar.yield_force = 50e3;
  LoadedBar test(bar);
  for (int i = 1; i <= 50; ++i)
    test.open(1e-9, 1e-4 * i);
  EXPECT_NEAR(test.state.plate_force, 50e3, 1e-2);
  test.expect_balance();
}

// Every bond slips, as much on one side as on the other: only the residual stiffness determines the bar's position.
TEST(Grout, ABarAllOfWhoseBondsSlipHasAPosition) {
  const double joint = 1.5;
  GroutedBar bar = steel_bar(0.1, {&joint, 1});
  bar.bond_strength = 100e3;
  LoadedBar test(bar);
  test.open(joint, 0.5);  // half a metre in one step
  EXPECT_NEAR(test.state.bar_force[rod_across(bar, joint)], 150e3, 1);
  // the bar's position is that of equal slip on both sides
  const std::size_t n = bar.position.size();
  EXPECT_NEAR(test.state.slip[1], -test.state.slip[n - 1], 1e-6);
  test.expect_balance();
  RecordProperty("iterations", test.most_iterations);
}

TEST(Grout, HistoryDoesNotDependOnCallsWithoutMotion) {
  Random random(1);
  const double joint = 1.2;
  GroutedBar bar = steel_bar(0.1, {&joint, 1});
  bar.bond_strength = 100e3;
  bar.yield_force = 90e3;
  bar.plate = Plate::spring;
  bar.plate_stiffness = 50e6;
  LoadedBar once(bar), often(bar);
  once.add(tighten(bar, 30e3, once.state, once.workspace));
  often.add(tighten(bar, 30e3, often.state, often.workspace));
  for (int step = 0; step < 300; ++step) {
    std::vector<double> rock;
    const double near = uniform(random, -3e-3, 3e-3), far = uniform(random, -3e-3, 3e-3);
    for (const double s : bar.position)
      rock.push_back(s < joint ? near : far);
    once.move(rock);
    often.move(rock);
    for (int again = 0; again < 3; ++again) {
      const GroutStep idle = move_rock(bar, rock, often.state, often.workspace);
      EXPECT_EQ(idle.iterations, 0);
      EXPECT_EQ(idle.work, 0);
      EXPECT_EQ(idle.dissipated, 0);
    }
    EXPECT_EQ(once.state.bond_force, often.state.bond_force);
    EXPECT_EQ(once.state.bar_force, often.state.bar_force);
    EXPECT_EQ(once.state.slip, often.state.slip);
    EXPECT_EQ(once.state.displacement, often.state.displacement);
    EXPECT_EQ(once.state.plate_force, often.state.plate_force);
  }
}

// ---- random bars ----------------------------------------------------------------------------------------------------

// any stiffnesses and strengths, plates that hold throughout, rock that moves in either direction
GroutedBar random_bar(Random& random, std::span<const double> joints) {
  GroutedBar bar;
  bar.axial_stiffness = power_of_ten(random, 6, 10);
  bar.bond_stiffness = power_of_ten(random, 5, 12);
  if (uniform(random, 0, 1) < 0.9) bar.bond_strength = power_of_ten(random, 3, 6);
  if (uniform(random, 0, 1) < 0.5) bar.yield_force = power_of_ten(random, 3, 6);
  if (uniform(random, 0, 1) < 0.5) bar.plate = Plate::tied;
  lay_nodes(3, joints, power_of_ten(random, -2, 0), bar);
  return bar;
}

// to the rounding of the forces and of those due to the displacements of this step
void expect_equilibrium(const LoadedBar& test) {
  const auto& s = test.state;
  double most = test.stiffest() * test.furthest();
  for (std::size_t i = 0; i < s.bond_force.size(); ++i)
    most = std::max({most, std::abs(s.bond_force[i]), i > 0 ? std::abs(s.bar_force[i - 1]) : 0.0});
  for (std::size_t i = test.bar.plate == Plate::tied ? 1 : 0; i < s.bond_force.size(); ++i) {
    const double left = i > 0 ? s.bar_force[i - 1] : 0, right = i < s.bar_force.size() ? s.bar_force[i] : 0;
    EXPECT_NEAR(s.bond_force[i] + left - right, 0, 256 * std::numeric_limits<double>::epsilon() * most);
  }
}

TEST(Grout, RandomHistoriesConvergeBalanceAndNeverCreateEnergy) {
  Random random(2);
  int most = 0;
  long long steps = 0, iterations = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double joints[] = {uniform(random, 0.2, 1.2), uniform(random, 1.5, 2.8)};
    LoadedBar test(random_bar(random, joints));
    const double size = power_of_ten(random, -6, -2);
    double block[3] = {};
    for (int step = 0; step < 30; ++step) {
      for (double& g : block)
        g += size * uniform(random, -1, 1);
      std::vector<double> rock;
      for (const double s : test.bar.position)
        rock.push_back(block[(s > joints[0]) + (s > joints[1])]);
      const GroutStep now = move_rock(test.bar, rock, test.state, test.workspace);
      test.add(now);
      if (HasFailure()) return;
      iterations += now.iterations;
      ++steps;
      expect_equilibrium(test);
    }
    test.expect_balance();
    most = std::max(most, test.most_iterations);
  }
  EXPECT_LT(most, most_grout_iterations / 2);
  RecordProperty("worst balance", std::to_string(1e12 * LoadedBar::worst_balance) + "e-12");
  RecordProperty("most iterations", most);
  RecordProperty("mean iterations", std::to_string(static_cast<double>(iterations) / static_cast<double>(steps)));
}

TEST(Grout, StepsOfAnElasticBarDoNotDependOnTheirNumber) {
  const double joint = 1.5;
  LoadedBar one(steel_bar(0.1, {&joint, 1})), many(steel_bar(0.1, {&joint, 1}));
  one.open(joint, 1e-3);
  for (int i = 1; i <= 100; ++i)
    many.open(joint, 1e-5 * i);
  for (std::size_t i = 0; i < one.state.bar_force.size(); ++i)
    EXPECT_NEAR(one.state.bar_force[i], many.state.bar_force[i], 1e-12 * 70e3);
  EXPECT_EQ(one.dissipated, 0);
  EXPECT_EQ(many.dissipated, 0);
  many.expect_balance();
}

// ---- plates ---------------------------------------------------------------------------------------------------------

TEST(Grout, TightenedPlatePressesOnTheRock) {
  for (const Plate plate : {Plate::spring, Plate::tied}) {
    GroutedBar bar = steel_bar(0.1);
    bar.plate = plate;
    bar.plate_stiffness = 50e6;
    LoadedBar test(bar);
    test.add(tighten(bar, 60e3, test.state, test.workspace));
    EXPECT_EQ(test.state.plate_force, 60e3);
    EXPECT_NEAR(test.state.bar_force[0], 60e3, 1e-7);
    test.expect_balance();
    // the rock at the plate comes out by 0.1 mm: bar, and plate, in series
    test.open(1e-9, 1e-4);
    const double bar_stiffness = elastic_stiffness(bar, 0, 1, test.workspace);
    EXPECT_NEAR(test.state.plate_force, 60e3 + 1e-4 * bar_stiffness, 1e-6);
    test.expect_balance();
  }
}

TEST(Grout, PlateNeverPulls) {
  GroutedBar bar = steel_bar(0.1);
  bar.plate = Plate::spring;
  bar.plate_stiffness = 50e6;
  LoadedBar test(bar);
  test.add(tighten(bar, 1e3, test.state, test.workspace));
  test.open(1e-9, -1e-3);  // into the rock: off the plate
  EXPECT_EQ(test.state.plate_force, 0);
  EXPECT_LT(test.state.plate_closure, 0);
  test.open(1e-9, 0);
  EXPECT_NEAR(test.state.plate_force, 1e3, 1e-6);
}

TEST(Grout, ABarWithoutSupportIsRefused) {
  GroutedBar bar = steel_bar(0.5);
  bar.bond_stiffness = 0;
  EXPECT_THROW(installed(bar, std::vector<double>(bar.position.size())), std::invalid_argument);
}

// ---- for the step ---------------------------------------------------------------------------------------------------

TEST(Grout, StiffnessIsThatAgainstABlock) {
  const double joint = 1.1;
  for (const Plate plate : {Plate::none, Plate::spring, Plate::tied}) {
    GroutedBar bar = steel_bar(0.1, {&joint, 1});
    bar.plate = plate;
    bar.plate_stiffness = 50e6;
    LoadedBar test(bar);
    test.open(joint, 1e-3);
    const int n = static_cast<int>(bar.position.size()), across = rod_across(bar, joint) + 1;
    double near = test.state.plate_force;
    for (int i = 0; i < across; ++i)
      near += test.state.bond_force[i];
    const double stiffness = elastic_stiffness(bar, 0, across, test.workspace);
    EXPECT_NEAR(near, 1e-3 * stiffness, 1e-9 * near);
    EXPECT_NEAR(elastic_stiffness(bar, across, n, test.workspace), stiffness, 1e-9 * stiffness);
  }
}

TEST(Grout, StepAllocatesNothing) {
  if (!allocations_are_counted) GTEST_SKIP();
  const double joint = 1.5;
  GroutedBar bar = steel_bar(0.1, {&joint, 1});
  bar.bond_strength = 100e3;
  LoadedBar test(bar);
  test.open(joint, 1e-5);
  const std::vector<double> rock = opened_at(bar, joint, 0.1);
  const long long before = allocations;
  const GroutStep step = move_rock(bar, rock, test.state, test.workspace);
  elastic_stiffness(bar, 0, 3, test.workspace);
  EXPECT_EQ(allocations, before);
  EXPECT_GT(step.iterations, 1);
}

// ---- blocks along a bar ---------------------------------------------------------------------------------------------

// Segments of rock act on each other as springs do: the force to move one is the force that its motion exerts on all
// others.
TEST(Grout, CondensesToSpringsBetweenSegments) {
  const double joints[] = {0.7, 1.5, 2.6};
  for (const Plate plate : {Plate::none, Plate::spring, Plate::tied}) {
    GroutedBar bar = steel_bar(0.1, joints);
    bar.plate = plate;
    bar.plate_stiffness = 1e8;
    bar.bond_strength = 2e4;
    LoadedBar test(bar);
    if (plate != Plate::none) test.add(tighten(bar, 1e3, test.state, test.workspace));
    std::vector<int> stretch;
    for (const double s : bar.position)
      stretch.push_back(static_cast<int>(std::count_if(joints, joints + 3, [&](double joint) { return joint < s; })));

    std::vector<double> k;
    condensed_stiffness(bar, test.state, stretch, 4, test.workspace, k);
    for (int a = 0; a < 4; ++a) {
      const auto [first, last] = std::equal_range(stretch.begin(), stretch.end(), a);
      const double alone = elastic_stiffness(bar, static_cast<int>(first - stretch.begin()),
                                             static_cast<int>(last - stretch.begin()), test.workspace);
      EXPECT_NEAR(k[5 * a], alone, 1e-12 * alone) << "nothing slips yet";
      double sum = 0;
      for (int b = 0; b < 4; ++b) {
        sum += k[4 * a + b];
        EXPECT_NEAR(k[4 * a + b], k[4 * b + a], 1e-12 * alone);
        if (a != b) {
          EXPECT_LT(k[4 * a + b], 0);
        }
      }
      EXPECT_NEAR(sum, 0, 1e-12 * alone);
    }

    // when all of the last segment's bond slips, it is almost released
    test.open(2.6, 0.1);
    condensed_stiffness(bar, test.state, stretch, 4, test.workspace, k);
    EXPECT_LT(k[15], 1e-9 * bar.axial_stiffness);
  }
}

TEST(Grout, EndsWithoutForceWhereItIsCut) {
  const double joints[] = {1, 2};
  GroutedBar bar = steel_bar(0.1, joints);
  bar.plate = Plate::tied;
  LoadedBar test(bar);
  test.add(tighten(bar, 5e4, test.state, test.workspace));
  test.open(2, 1e-3);
  const int at = rod_across(bar, 1) + 1;
  GroutedBarState left = test.state;
  keep_nodes(at, static_cast<int>(bar.position.size()), bar, left);
  EXPECT_EQ(bar.plate, Plate::none);
  EXPECT_EQ(left.rock.front(), 0);
  ASSERT_TRUE(settle(bar, left, test.workspace).converged);
  double sum = 0;
  for (const double force : left.bond_force)
    sum += force;
  EXPECT_NEAR(sum, 0, 1e-9 * 5e4) << "only the bond holds it";
  // as if the bar had been so short when the joint opened
  const double shorter[] = {1};
  GroutedBar short_bar;
  short_bar.axial_stiffness = bar.axial_stiffness;
  short_bar.bond_stiffness = bar.bond_stiffness;
  lay_nodes(2, shorter, 0.1, short_bar);
  LoadedBar once(short_bar);
  once.open(1, 1e-3);
  const double expected = once.state.bar_force[rod_across(short_bar, 1)];
  EXPECT_NEAR(left.bar_force[rod_across(bar, 2)], expected, 1e-9 * expected);
}

}  // namespace
}  // namespace voussoir::grout_test
