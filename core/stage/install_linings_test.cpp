// Linings in complete scenes: forces, excavation, identical bits, and nodes that slide across a flush joint.
#include "core/stage/install_linings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "core/step.hpp"
#include "core/step/lining_forces.hpp"
#include "core/step/tangent.hpp"
#include "core/step/time_step.hpp"
#include "core/testing/dense.hpp"
#include "core/testing/lined_opening.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::install_linings_test {
namespace {

using namespace lined_opening;

// The forces of the rock on a ring, and of the ring on the rock, balance the ring's weight.
TEST(Linings, AreSupportedByTheRockWithTheirWeight) {
  const Prepared<2> scene = scene_of(rock + held + shell + dig);
  const Progress<2> done = whole_run(scene);
  EXPECT_LT(done.results.energy.relative_error(), 0.01);
  ASSERT_EQ(done.results.linings.size(), 48u);
  Vector<2> of_rock = Vector<2>::Zero();
  double thrust = 0;
  for (std::size_t i = 0; i < 48; ++i) {
    const LiningRow& row = done.results.linings[i];
    EXPECT_GE(row.rock, 0) << i;
    thrust += row.forces.thrust / 48;
  }
  EXPECT_GT(thrust, 0) << "the rock that was let off presses on it";
  const Lining& lining = scene.model.linings.front();
  double weight = 0;
  for (const LiningNode& node : lining.nodes)
    weight += 10 * node.mass;
  for (std::size_t i = 0; i < 48; ++i) {
    const LiningContact &a = done.state.supports.linings[0].contacts[2 * i],
                        &b = done.state.supports.linings[0].contacts[2 * i + 1];
    for (const auto& [c, half] : {std::pair(a, 0), std::pair(b, 1)}) {
      const LiningSide& side = lining.sides[lining.nodes[i].side[half]];
      of_rock += -c.normal * side.normal + c.shear * side.along();
    }
  }
  // blocks have rotated by about 1e-4 since the lining was cast
  EXPECT_NEAR(of_rock[0], 0, 1e-2 * weight);
  EXPECT_NEAR(of_rock[1], weight, 1e-2 * weight);
}

// From the same state, in rock that does not slip, with a light lining: its own weight, applied suddenly, would leave
// shear in the interface that depends on the path.
TEST(Linings, HaveTheSameEquilibriumByNewtonsMethod) {
  const std::vector<std::string> stick = {"joint_properties.bed.friction_deg=89",
                                          "joint_properties.contact.friction_deg=89", "linings.shell.density=1"};
  std::vector<std::string> by_newton = stick;
  by_newton.push_back("stage.line.damping={ statics = \"newton\" }");
  const Progress<2> relaxed = whole_run(scene_of(rock + held + shell + dig, stick));
  const Progress<2> newton = whole_run(scene_of(rock + held + shell + dig, by_newton));
  EXPECT_GT(newton.results.counters.static_iterations, 0);
  EXPECT_EQ(newton.results.counters.static_fallbacks, 0);
  double largest = 0;
  for (const LiningRow& row : relaxed.results.linings)
    largest = std::max(largest, row.forces.thrust);
  for (std::size_t i = 0; i < relaxed.results.linings.size(); ++i)
    EXPECT_NEAR(relaxed.results.linings[i].forces.thrust, newton.results.linings[i].forces.thrust, 0.05 * largest)
        << i << ": nodes that open on the path lose their shear, and which do depends on the path";
}

// Interruptions, three threads and another order of the tables give the same bits.
TEST(Linings, KeepTheirBits) {
  const Prepared<2> scene = scene_of(rock + held + shell + dig);
  const Progress<2> whole = whole_run(scene);
  for (const double part : {0.4, 0.8, 0.95}) {
    const auto until = static_cast<long long>(part * static_cast<double>(whole.state.counters.steps));
    EXPECT_EQ(continued(scene, until).results.state_hash, whole.results.state_hash) << part;
  }
  EXPECT_EQ(whole_run(scene_of(rock + dig + shell + held)).results.state_hash, whole.results.state_hash);
  Prepared<2> threads = scene;
  threads.settings.threads = 3;
  EXPECT_EQ(whole_run(threads).results.state_hash, whole.results.state_hash);
}

// Bolts installed in the same stage find their blocks among the bodies of the lining, too: they have the same forces as
// if an earlier stage without motion had installed them.
TEST(Linings, AreInstalledTogetherWithBolts) {
  const std::string roof = "[[bolts]]\nname = \"roof\"\nstiffness = 1e8\n",
                    left = roof + "from = [-0.2, 3]\nto = [-5, 7.8]\n",
                    right = "[[bolts]]\nname = \"right\"\nstiffness = 1e8\nfrom = [0.5, 3]\nto = [4, 6.5]\n";
  const std::string dug =
      stage("weight", "gravity_ramp_s = 1") +
      stage("dig", "excavate = [\"tunnel\"]\nexcavation_forces = { remaining = 0.5, duration_s = 1 }");
  const auto last = [](const std::string& names) {
    return stage("line", "install = [" + names + "]\nexcavation_forces = { remaining = 0, duration_s = 1 }");
  };
  const std::string support = held + shell + left + right;
  const Progress<2> together = whole_run(scene_of(rock + support + dug + last(R"("roof", "shell", "right")")));
  const Progress<2> reordered =
      whole_run(scene_of(rock + right + left + shell + held + dug + last(R"("shell", "right", "roof")")));
  const Progress<2> before =
      whole_run(scene_of(rock + support + dug + stage("bolt", R"(install = ["right", "roof"])") + last(R"("shell")")));
  EXPECT_EQ(reordered.results.state_hash, together.results.state_hash);
  ASSERT_EQ(together.state.supports.bolt_springs.size(), 2u);
  ASSERT_EQ(before.state.supports.bolt_springs.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const double force = together.state.supports.bolt_springs[i].force;
    EXPECT_GT(std::abs(force), 100) << i;
    EXPECT_NEAR(before.state.supports.bolt_springs[i].force, force, 1e-3 * std::abs(force)) << i;
  }
  EXPECT_EQ(together.results.linings.size(), 48u);
  EXPECT_LT(together.results.energy.relative_error(), 0.01);
}

void find_forces_of_linings(const Cast& cast, State<2>& state) {
  find_lining_forces(cast.model, state.schedule, joint_step(cast.scene.settings, state.time_step, state.relaxation),
                     state.bodies, state.supports, state.ledger, state.counters);
}

TEST(Linings, AreCastWithoutForce) {
  Cast cast;
  EXPECT_EQ(nodes_without_rock(cast.state.supports.linings.front()), 0);
  find_forces_of_linings(cast, cast.state);
  for (const LiningContact& contact : cast.state.supports.linings.front().contacts) {
    EXPECT_LT(std::abs(contact.normal), 1e-3) << "rounding of a few m at 1e9 N/m";
    EXPECT_EQ(contact.shear, 0);
  }
}

// New bodies measure their paths from 0 again: distances until which a pair may be skipped are reset, too.
TEST(Linings, ResetTheDistancesOfSkippedPairs) {
  const Progress<2> before = whole_run(scene_of(rock + held + stage("weight", "gravity_ramp_s = 1")));
  Cast cast;
  State<2> state = before.state;
  for (Contact<2>& contact : state.contacts.list)
    contact.near_until = contact.free_until = 5;
  add_bodies(cast.model, state.bodies, state.contacts, state.loads, state.time_step);
  EXPECT_EQ(state.bodies.motions.size(), cast.model.bodies.size());
  for (const Contact<2>& contact : state.contacts.list) {
    EXPECT_EQ(contact.near_until, 0);
    EXPECT_EQ(contact.free_until, 0);
  }
}

// A node is pressed against the rock and moved along a side across a joint.
TEST(Linings, AreNotAffectedByAFlushJoint) {
  Cast cast;
  for (double& friction : cast.state.schedule.friction)
    friction = 1.57;  // nothing slips
  int crossed = 0;
  for (int n = 0; n < 48; ++n) {
    const LiningNode& node = cast.lining().nodes[n];
    if (node.side[0] != node.side[1]) continue;
    const LiningSide& side = cast.lining().sides[node.side[0]];
    State<2> state = cast.state;
    LiningContact& contact = state.supports.linings.front().contacts[2 * n];
    const int rock_before = contact.rock;
    constexpr double depth = 1e-3, step = 1e-4;
    double place = 0;
    bool changed = false;
    for (int k = 0; k < 2500; ++k, place += step) {
      state.bodies.motions[cast.body(n)].displacement = depth * side.normal + place * side.along();
      cache_poses(cast.model, 1, state.bodies);
      find_forces_of_linings(cast, state);
      if (contact.rock < 0) break;
      changed = changed || contact.rock != rock_before;
      const double stiffness = node.half_length[0];
      ASSERT_NEAR(contact.normal, 1e9 * stiffness * depth, 1e-6 * 1e9 * stiffness * depth) << n << " at " << place;
      ASSERT_NEAR(contact.shear, -5e8 * stiffness * place, 1e-6 * 5e8 * stiffness * (place + step)) << n;
    }
    crossed += changed;
  }
  EXPECT_GT(crossed, 0) << "at least one node must have passed from one block to the next";
}

// The pair stiffness of Newton's method against differences of the loads.
TEST(Linings, HaveTheTangentOfTheirForces) {
  Cast cast;
  const double size = 1e-4;
  for (std::size_t b = 0; b < cast.model.bodies.size(); ++b) {
    const double x = std::sin(3.7 * static_cast<double>(b + 2)), y = std::cos(2.9 * static_cast<double>(b + 2));
    cast.state.bodies.motions[b].displacement = size * Vector<2>(x, y);
    cast.state.bodies.motions[b].rotation.angle = 0.3 * size * (x - y);
  }
  cast.state.time_step.length = 1;
  cast.state.relaxation.under_way = true;
  const auto loads_at = [&](const State<2>& at) {
    State<2> state = at;
    cache_poses(cast.model, 1, state.bodies);
    find_forces_of_linings(cast, state);
    std::vector<Load<2>> loads(cast.model.bodies.size());
    lining_loads<2>(cast.model, 1, load_inputs(state), loads);
    return loads;
  };
  State<2> here = cast.state;
  here.increment.base.supports.linings = here.supports.linings;
  cache_poses(cast.model, 1, here.bodies);
  find_forces_of_linings(cast, here);
  std::vector<PairStiffness<2>> pairs;
  add_lining_pairs(cast.model, cast.scene.settings, here, pairs);
  std::vector<const PairStiffness<2>*> list;
  for (const PairStiffness<2>& pair : pairs)
    list.push_back(&pair);
  const int bodies = static_cast<int>(cast.model.bodies.size());
  std::vector<int> place(bodies);
  std::iota(place.begin(), place.end(), 0);
  const Eigen::VectorXd free = Eigen::VectorXd::Ones(3 * bodies);
  BlockMatrix<3> k;
  find_tangent<2>(1, list, {}, place, free, k);

  double largest = 0, worst = 0;
  for (int column = 0; column < 3 * bodies; ++column) {
    const double h = 1e-9;
    const auto moved = [&](double way) {
      State<2> state = cast.state;
      Motion<2>& m = state.bodies.motions[column / 3];
      if (column % 3 < 2)
        m.displacement[column % 3] += way;
      else
        m.rotation.angle += way;
      return loads_at(state);
    };
    const std::vector<Load<2>> more = moved(h), less = moved(-h);
    Eigen::VectorXd product;
    k.times(1, Eigen::VectorXd::Unit(3 * bodies, column), product);
    for (int b = 0; b < bodies; ++b) {
      const Vector<3> change(more[b].force[0] - less[b].force[0], more[b].force[1] - less[b].force[1],
                             more[b].moment[0] - less[b].moment[0]);
      for (int f = 0; f < 3; ++f) {
        largest = std::max(largest, std::abs(product[3 * b + f]));
        worst = std::max(worst, std::abs(product[3 * b + f] + change[f] / (2 * h)));
      }
    }
  }
  EXPECT_LT(worst, 1e-5 * largest);
}

// The bound of the step against the exact limit of an unsupported ring.
TEST(Linings, HaveASafeTimeStep) {
  for (const int nodes : {24, 48, 96}) {
    Prepared<2> scene = scene_of(rock + held + shell + stage("dig", "excavate = [\"tunnel\"]\ninstall = [\"shell\"]"),
                                 {"linings.shell.nodes=" + std::to_string(nodes)});
    const Lining& lining = scene.model.linings.front();
    const int n = static_cast<int>(lining.nodes.size());
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    Eigen::VectorXd root(3 * n);
    for (int i = 0; i < n; ++i) {
      root.segment<2>(3 * i).setConstant(1 / std::sqrt(lining.nodes[i].mass));
      root[3 * i + 2] = 1 / std::sqrt(lining.nodes[i].inertia);
    }
    double bound = 0;
    for (int i = 0; i < n; ++i) {
      const Beam beam = lining.beam(i);
      const BeamMatrix own = beam_tangent(beam, beam_strain(beam, {}, {}));
      const int at[2] = {3 * i, 3 * lining.next(i)};
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b)
          k.block<3, 3>(at[a], at[b]) += own.block<3, 3>(3 * a, 3 * b);
      bound = std::max(bound, lining.nodes[i].square_frequency);
    }
    const double ratio = std::sqrt(oracle::largest_eigenvalue(root.asDiagonal() * k * root.asDiagonal()) / bound);
    EXPECT_GT(ratio, 0.7) << nodes;
    EXPECT_LE(ratio, 1) << nodes;
  }
}

// Half of the rock around a lining is excavated: it loses its contacts there and keeps the rest.
TEST(Linings, LoseContactsOfExcavatedRock) {
  const std::string more =
      "[[excavations]]\nname = \"cross\"\noutline = true\nbox = { min = [0.5, -1], max = [11, 1] }\n";
  const Progress<2> done =
      whole_run(scene_of(rock + more + held + shell + dig + stage("cross", "excavate = [\"cross\"]")));
  const LiningState& lined = done.state.supports.linings.front();
  const int without = nodes_without_rock(lined);
  EXPECT_GT(without, 2);
  EXPECT_LT(without, 24);
  for (const LiningRow& row : done.results.linings)
    if (row.stage == 4 && row.rock < 0) {
      EXPECT_EQ(row.pressure, 0);
    }
}

}  // namespace
}  // namespace voussoir::install_linings_test
