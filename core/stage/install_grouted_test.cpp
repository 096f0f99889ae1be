// Grouted bolts in complete scenes: forces and their potential, excavation, identical bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/stage/install_bolts.hpp"
#include "core/step.hpp"
#include "core/step/bolt_forces.hpp"
#include "core/testing/hung_slab.hpp"
#include "core/testing/shapes.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::install_grouted_test {
namespace {

using hung_slab::hang;
using hung_slab::slab;
using hung_slab::stage;
using hung_slab::weight;

constexpr double axial = 1e8, bond = 1e9;

std::string bolts(const std::string& more, const std::string& name = "roof") {
  return "[[bolts]]\nname = \"" + name + "\"\nkind = \"grouted\"\naxial_stiffness = 1e8\nbond_stiffness = 1e9\n" +
         more + "\n";
}
// three of them, vertical, 2 m long
const std::string row = "from = [1, 0]\nto = [1, 2]\nrepeat = [{ step = [1, 0], count = 3 }]\n";

// across a joint at the middle of 2 m: of each half √(EA k) tanh(l √(k/EA))
double joint_stiffness() {
  return 0.5 * std::sqrt(axial * bond) * std::tanh(std::sqrt(bond / axial));
}

TEST(GroutedBolts, ShareTheWeightThatHangsFromThem) {
  for (const char* statics : {"adaptive", "newton"})
    for (const double spacing : {1.0, 2.5}) {
      const Progress<2> done = simulated(scene_of(slab + bolts(row + "spacing = " + std::to_string(spacing)) + hang,
                                                  {std::string("statics=\"") + statics + "\""}));
      ASSERT_EQ(done.results.outcome, Outcome::done) << done.results.message;
      ASSERT_EQ(done.results.bolts.size(), 3u);
      for (const BoltRow& bolt : done.results.bolts) {
        EXPECT_NEAR(bolt.force, spacing * weight / 3, 1e-6 * spacing * weight / 3) << statics;
        // the default spacing of nodes, a fifth of √(EA/k), has an error of 0.5 %
        EXPECT_NEAR(bolt.extension, bolt.force / joint_stiffness(), 0.006 * bolt.extension) << statics;
        ASSERT_TRUE(bolt.slip);
        EXPECT_EQ(*bolt.slip, 0);
      }
      if (done.results.counters.static_iterations > 0) {
        EXPECT_EQ(done.results.counters.static_fallbacks, 0);
      }
      EXPECT_LT(done.results.energy.relative_error(), 0.01);
    }
}

// A bond strength of a third of the slab's weight over the metre in it is sufficient, and a thousandth less is not.
TEST(GroutedBolts, FailIfTheBondSlipsOrTheBarYields) {
  for (const char* strength : {"bond_strength", "yield"})
    for (const double of_weight : {1.001, 0.999}) {
      const Progress<2> done =
          simulated(scene_of(slab + bolts(row + strength + " = " + std::to_string(of_weight * weight / 3)) +
                             stage("gravity_ramp_s = 1\ninstall = [\"roof\"]\nstep_limit = 20000")));
      EXPECT_EQ(done.results.outcome, of_weight > 1 ? Outcome::done : Outcome::incomplete)
          << strength << done.results.message;
    }
}

TEST(GroutedBolts, CompressTheJointByTheirPretension) {
  // the plate at the top, ungrouted across the joint, grouted in the lower block: half a metre of bar and the pull-out
  // of a metre
  const std::string text = R"(
dimension = 2
density = 2500
equilibrium = { unbalanced = 1e-9 }
domain = { box = { min = [0, 0], max = [1, 2] } }
joint_properties = [{ name = "bed", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40, sub_contacts = 2 }]
joints = [{ name = "bed", dip = 0, point = [0, 1] }]
fix = [{ below = ["bed"] }]
)" + bolts("from = [0.5, 3]\nto = [0.5, 0]\npretension = 1e5\nfree_length = 1\nnode_spacing = 0.01\n") +
                           stage("install = [\"roof\"]");
  constexpr double F0 = 1e5, joint = 1e9;
  for (const double plate : {0.0, 3e8}) {
    std::vector<std::string> how{"bolts.roof.plate=\"tied\""};
    if (plate > 0) how = {"bolts.roof.plate=\"spring\"", "bolts.roof.plate_stiffness=3e8"};
    const double pull_out = std::sqrt(axial * bond) * std::tanh(std::sqrt(bond / axial));
    const double bar = 1 / (1 / axial + 1 / pull_out + (plate > 0 ? 1 / plate : 0));
    const Progress<2> done = simulated(scene_of(text, how));
    ASSERT_EQ(done.results.outcome, Outcome::done) << done.results.message;
    ASSERT_EQ(done.results.bolts.size(), 2u);
    EXPECT_EQ(done.results.bolts[0].joint, 0);
    for (const BoltRow& r : done.results.bolts)
      EXPECT_NEAR(r.force, F0 * joint / (joint + bar), 1e-4 * F0) << plate;
  }
  const Progress<2> weak = simulated(
      scene_of(text, {"bolts.roof.plate=\"tied\"", "bolts.roof.bond_strength=6e4", "bolts.roof.from=[0.5, 2.9]"}));
  EXPECT_EQ(weak.results.outcome, Outcome::failed);
  EXPECT_NE(weak.results.message.find("cannot take its pretension"), std::string::npos) << weak.results.message;
}

TEST(GroutedBolts, WarnIfTheyCrossNoJoint) {
  const Progress<2> done = simulated(
      scene_of(slab + bolts("from = [1, 1.5]\nto = [2, 2.5]\n") + stage("step_limit = 10\ninstall = [\"roof\"]")));
  ASSERT_FALSE(done.results.warnings.empty());
  EXPECT_NE(done.results.warnings.front().find("cross no joint"), std::string::npos);
  EXPECT_TRUE(done.state.supports.grouted.empty());
}

// ---- forces and their potential -------------------------------------------------------------------------------------

// Four blocks in a row, in 3-D or 2-D, and an oblique bar through all of them.
template <int Dim>
std::string row_of_blocks() {
  const std::string three = Dim == 3 ? "3" : "2";
  const auto point = [](const std::string& x, const std::string& y, const std::string& z) {
    return Dim == 3 ? "[" + x + ", " + y + ", " + z + "]" : "[" + x + ", " + y + "]";
  };
  std::string text = "dimension = " + three +
                     "\ndensity = 2500\njoint_properties = [{ name = \"bed\", normal_stiffness = 1e9, "
                     "shear_stiffness = 5e8, friction_deg = 40 }]\n";
  text += "domain = { box = { min = " + point("0", "0", "0") + ", max = " + point("4", "1", "1") + " } }\n";
  for (const char* at : {"1", "2", "3"})
    text += std::string("[[joints]]\nname = \"j") + at + "\"\ndip = 90\n" + "dip_direction = 90\n" +
            "point = " + point(at, "0.5", "0.5") + "\n";
  return text +
         bolts("from = " + point("0", "0.3", "0.4") + "\nto = " + point("4", "0.7", "0.5") + "\nnode_spacing = 0.2") +
         "plate = \"spring\"\nplate_stiffness = 1e8\npretension = 1e4\n" +
         "[[stage]]\nname = \"run\"\nkind = \"run\"\nduration_s = 1e-3\ninstall = [\"roof\"]\n";
}

template <int Dim>
struct Bars {
  Prepared<Dim> scene = scene_of<Dim>(row_of_blocks<Dim>());
  State<Dim> state = scene.state;

  Bars() {
    install_bolts<Dim>(scene.model, {"roof"}, state);
    evaluate(state);
  }
  void evaluate(State<Dim>& s) const {
    cache_poses(scene.model, 1, s.bodies);
    s.ledger.energy.elastic = 0;
    find_bar_forces<Dim>(scene.model, s.schedule, {}, s.bodies, s.supports, s.ledger, s.counters);
  }
  // along one degree of freedom of a body
  void move(State<Dim>& s, int body, int freedom, double by) const {
    if (freedom < Dim) {
      s.bodies.motions[body].displacement[freedom] += by;
    } else {
      Spin<Dim> turn = Spin<Dim>::Zero();
      turn[freedom - Dim] = by;
      s.bodies.motions[body].rotation = turned(s.bodies.motions[body].rotation, turn);
    }
  }
  std::vector<Load<Dim>> loads(const State<Dim>& s) const {
    std::vector<Load<Dim>> all(scene.model.bodies.size());
    bolt_loads<Dim>(scene.model, 1, load_inputs(s), all);
    return all;
  }
};

double along(const Load<2>& l, int freedom) {
  return freedom < 2 ? l.force[freedom] : l.moment[0];
}
double along(const Load<3>& l, int freedom) {
  return freedom < 3 ? l.force[freedom] : l.moment[freedom - 3];
}

template <int Dim>
void expect_a_potential() {
  const Bars<Dim> bars;
  ASSERT_EQ(bars.state.supports.grouted.size(), 1u);
  ASSERT_EQ(bars.state.supports.bolt_springs.size(), 3u);
  shapes::Random random(7);
  State<Dim> state = bars.state;
  for (int b = 0; b < 4; ++b)
    for (int f = 0; f < freedoms<Dim>; ++f)
      bars.move(state, b, f, shapes::uniform(random, -0.02, 0.02));
  bars.evaluate(state);
  const std::vector<Load<Dim>> loads = bars.loads(state);

  Load<Dim> all;
  double scale = 0;
  for (int b = 0; b < 4; ++b) {
    const Vector<Dim> at = bars.scene.model.bodies[b].reference + state.bodies.motions[b].displacement;
    all += {loads[b].force, Spin<Dim>(loads[b].moment + moment(at, loads[b].force))};
    scale = std::max(scale, loads[b].force.norm());
  }
  EXPECT_LT(all.force.norm(), 1e-14 * scale);
  EXPECT_LT(all.moment.norm(), 1e-13 * scale) << "arms of a few metres";

  constexpr double step = 1e-6;  // of strains of 1e-2: the second difference is 1e-8 of the first
  for (int b = 0; b < 4; ++b)
    for (int f = 0; f < freedoms<Dim>; ++f) {
      double energy[2];
      for (const int side : {0, 1}) {
        State<Dim> there = state;
        bars.move(there, b, f, side == 0 ? -step : step);
        bars.evaluate(there);
        energy[side] = there.ledger.energy.elastic;
      }
      EXPECT_NEAR(-(energy[1] - energy[0]) / (2 * step), along(loads[b], f), 1e-6 * scale) << b << " " << f;
    }
}

TEST(GroutedBolts, HaveForcesOfAPotentialAndZeroSum) {
  expect_a_potential<2>();
  expect_a_potential<3>();
}

// The stiffness between segments is the derivative of the forces, and the bound for a body is an upper bound.
template <int Dim>
void expect_a_tangent() {
  const Bars<Dim> bars;
  std::vector<PairStiffness<Dim>> pairs;
  add_bar_pairs(bars.scene.model, bars.scene.settings, bars.state, pairs);
  ASSERT_EQ(pairs.size(), 6u) << "each of four blocks with each other one";
  std::vector<BodyStiffness> bounds(4);
  add_bar_stiffness<Dim>(bars.scene.model, load_inputs(bars.state), bounds);
  const std::vector<Load<Dim>> before = bars.loads(bars.state);
  constexpr double step = 1e-7;
  for (int b = 0; b < 4; ++b)
    for (int f = 0; f < Dim; ++f) {
      State<Dim> there = bars.state;
      bars.move(there, b, f, step);
      bars.evaluate(there);
      const std::vector<Load<Dim>> after = bars.loads(there);
      for (int c = 0; c < 4; ++c) {
        if (c == b) continue;
        for (int g = 0; g < Dim; ++g) {
          double expected = 0;  // of the second body: minus the stiffness; of the first, the opposite force
          for (const PairStiffness<Dim>& p : pairs)
            if ((p.body_a == b && p.body_b == c) || (p.body_a == c && p.body_b == b)) expected += p.stiffness(g, f);
          const double found = (after[c].force[g] - before[c].force[g]) / step;
          EXPECT_NEAR(found, expected, 1e-6 * bounds[c].translation) << b << c << f << g;
        }
      }
      EXPECT_LE(std::abs(after[b].force[f] - before[b].force[f]) / step, bounds[b].translation);
    }
}

TEST(GroutedBolts, HaveTheTangentOfTheirForces) {
  expect_a_tangent<2>();
  expect_a_tangent<3>();
}

// ---- nothing is lost ------------------------------------------------------------------------------------------------

// Beds of 1 m under a roof; bars through three joints; after the excavation of the lowest bed the bars support the
// rest.
const std::string beds = R"(
dimension = 2
gravity = [0, -10]
density = 2500
domain = { box = { min = [0, 0], max = [4, 4] } }
equilibrium = { unbalanced = 1e-8 }
joint_properties = [{ name = "bed", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40, sub_contacts = 2 }]
joints = [{ name = "b1", dip = 0, point = [0, 1] }, { name = "b2", dip = 0, point = [0, 2] },
          { name = "b3", dip = 0, point = [0, 3] }]
fix = [{ above = ["b3"] }]
)";
const std::string lowest = "[[excavations]]\nname = \"dug\"\nbox = { min = [0, 0], max = [4, 1] }\n",
                  half_of_it =
                      "[[excavations]]\nname = \"dug\"\nbox = { min = [0, 0], max = [4, 0.5] }\noutline = true\n";
const std::string dig = stage("excavate = [\"dug\"]", "dig");
const std::string through = "from = [1, 0]\nto = [1, 4]\nrepeat = [{ step = [1, 0], count = 3 }]\n";

TEST(GroutedBolts, StayInTheRemainingPartsOfTheirBlocks) {
  const std::string plate = "plate = \"tied\"\n";
  const Progress<2> whole = simulated(scene_of(beds + bolts(through + plate) + hang));
  ASSERT_EQ(whole.results.outcome, Outcome::done) << whole.results.message;
  ASSERT_EQ(whole.results.bolts.size(), 12u) << "a plate and three joints each";
  const Progress<2> half = simulated(scene_of(beds + half_of_it + bolts(through + plate) + hang + dig));
  ASSERT_EQ(half.results.outcome, Outcome::done) << half.results.message;
  ASSERT_EQ(half.state.supports.grouted.size(), 3u);
  const Progress<2> dug = simulated(scene_of(beds + lowest + bolts(through + plate) + hang + dig));
  ASSERT_EQ(dug.results.outcome, Outcome::done) << dug.results.message;
  ASSERT_EQ(dug.state.supports.bolt_springs.size(), 6u);
  for (const GroutedBolt<2>& g : dug.state.supports.grouted) {
    EXPECT_EQ(g.joints(), 2);
    EXPECT_EQ(g.bar.plate, Plate::none) << "it was removed with its rock";
  }
  // at each joint the weight below it
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(whole.state.supports.bolt_springs[3 * i].force, weight / 3, 1e-5 * weight);
    EXPECT_NEAR(half.state.supports.bolt_springs[3 * i].force, 0.5 * weight / 3, 1e-5 * weight);
    EXPECT_NEAR(half.state.supports.bolt_springs[3 * i + 2].force, 2.5 * weight / 3, 1e-5 * weight);
    EXPECT_EQ(dug.state.supports.bolt_springs[2 * i].number, 2);
    EXPECT_NEAR(dug.state.supports.bolt_springs[2 * i].force, weight / 3, 1e-5 * weight);
    EXPECT_NEAR(dug.state.supports.bolt_springs[2 * i + 1].force, 2 * weight / 3, 1e-5 * weight);
  }
}

// What the rock that goes held by bolts is held by its let-off, and nothing moves as long as none is let off.
TEST(GroutedBolts, AreRelievedWithTheRockThatGoes) {
  const std::string hold = "excavation_forces = { remaining = 1, duration_s = 0.1 }";
  const std::string plain = "[[bolts]]\nname = \"roof\"\nstiffness = 1e8\n" + through;
  for (const std::string& roof : {plain, bolts(through)}) {
    const Progress<2> done =
        simulated(scene_of(beds + lowest + roof + hang + stage("excavate = [\"dug\"]\n" + hold, "dig") +
                           stage("excavation_forces = { remaining = 0, duration_s = 1 }", "off")));
    ASSERT_EQ(done.results.outcome, Outcome::done) << done.results.message;
    std::vector<double> opened[3];  // of the joints that are left
    for (const BoltRow& r : done.results.bolts)
      if (r.joint > 1) opened[r.stage - 1].push_back(r.extension);
    ASSERT_EQ(opened[0].size(), 6u);
    ASSERT_EQ(opened[1].size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(opened[1][i], opened[0][i], 1e-5 * opened[0][i]);
      EXPECT_LT(opened[2][i], 0.8 * opened[0][i]);
    }
    EXPECT_NEAR(done.state.supports.bolt_springs[1].force, 2 * weight / 3, 1e-5 * weight);
  }
}

// A bar whose middle is excavated becomes two bars, each of which must still cross a joint.
TEST(GroutedBolts, AreCutAtExcavatedRock) {
  Bars<2> bars;
  State<2> state = bars.state;
  cut_bolts<2>([](int& body, Vector<2>&) { return body != 1; }, state);
  ASSERT_EQ(state.supports.grouted.size(), 1u) << "the first block has no joint left";
  EXPECT_EQ(state.supports.grouted[0].joints(), 1);
  ASSERT_EQ(state.supports.bolt_springs.size(), 1u);
  EXPECT_EQ(state.supports.bolt_springs[0].number, 3);
  bars.evaluate(state);
  EXPECT_NEAR(state.supports.bolt_springs[0].force, 0, 1e-10 * 1e4) << "its pretension was lost with the plate";
  cut_bolts<2>([](int& body, Vector<2>&) { return body != 3; }, state);
  EXPECT_TRUE(state.supports.grouted.empty());
  EXPECT_TRUE(state.supports.bolt_springs.empty());
}

void expect_same_bits(const std::string& statics) {
  const std::string one = bolts(through + "bond_strength = 60e3\nyield = 100e3\n"),
                    other = bolts("from = [0.5, 0.5]\nto = [2, 3.5]\npretension = 1e4\nplate = \"tied\"\n", "inclined"),
                    springs = "[[bolts]]\nname = \"plain\"\nfrom = [3.5, 0.5]\nto = [3.5, 3.5]\nstiffness = 1e8\n",
                    stages = stage("gravity_ramp_s = 0.3\ninstall = [\"inclined\", \"plain\"]") +
                             "[[stage]]\nname = \"run\"\nkind = \"run\"\nduration_s = 0.02\ninstall = [\"roof\"]\n" +
                             dig;
  Prepared<2> scene = scene_of(beds + lowest + one + other + springs + stages, {statics});
  const Progress<2> whole = simulated(scene);
  ASSERT_EQ(whole.results.outcome, Outcome::done) << whole.results.message;
  ASSERT_EQ(whole.state.supports.grouted.size(), 4u);
  const auto slipped = [](double slip) { return slip != 0; };
  EXPECT_TRUE(std::ranges::any_of(whole.state.supports.grouted[1].state.slip, slipped));
  // bars on both sides of a bolt of springs have their own slip in their rows
  double most = 0;
  for (const BoltRow& r : whole.results.bolts) {
    EXPECT_EQ(r.slip.has_value(), r.bolts != "plain" && r.joint > 0);
    if (r.bolts == "inclined" && r.slip) {
      EXPECT_EQ(*r.slip, 0) << "its bond has unlimited strength";
    }
    if (r.bolts == "roof" && r.stage == 3) most = std::max(most, std::abs(*r.slip));
  }
  double of_bars = 0;
  for (std::size_t k = 1; k < 4; ++k)
    for (const double slip : whole.state.supports.grouted[k].state.slip)
      of_bars = std::max(of_bars, std::abs(slip));
  EXPECT_NEAR(most, of_bars, 1e-6 * of_bars) << "rows are at the positions after the last step";
  EXPECT_EQ(simulated(scene_of(beds + lowest + springs + other + one + stages, {statics})).results.state_hash,
            whole.results.state_hash);
  const double steps = static_cast<double>(whole.state.counters.steps);
  for (const double fraction : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) {
    const Progress<2> second = continued(scene, static_cast<long long>(fraction * steps));
    EXPECT_EQ(second.results.state_hash, whole.results.state_hash) << fraction;
    EXPECT_EQ(second.results.bolts.size(), whole.results.bolts.size());
  }
  scene.settings.threads = 3;
  EXPECT_EQ(simulated(scene).results.state_hash, whole.results.state_hash);
}

TEST(GroutedBolts, SurviveInterruptionsThreadsAndTheOrderOfTheFile) {
  for (const char* statics : {"adaptive", "local", "newton"}) {
    SCOPED_TRACE(statics);
    expect_same_bits(std::string("statics=\"") + statics + "\"");
  }
}

// A slab supported by bars oscillates: kinetic energy, elastic energy of bars and bonds, slip and yield add up.
TEST(GroutedBolts, KeepTheEnergyBalanceOfAMotion) {
  for (const char* strength : {"bond_strength = 50e3\n", "yield = 50e3\n"}) {
    const Prepared<2> scene = scene_of(
        slab + bolts(row + strength) +
        "[[stage]]\nname = \"run\"\nkind = \"run\"\nduration_s = 0.3\ninstall = [\"roof\"]\ndamping = { local = 0 }\n");
    const Progress<2> done = simulated(scene);
    const EnergyBalance& energy = done.results.energy;
    EXPECT_GT(energy.flows[Source::bolt_yield], 0.1 * energy.largest_energy) << strength;
    EXPECT_LT(std::abs(energy.motion_error), 1e-10 * energy.largest_energy);
    EXPECT_LT(energy.relative_error(), 0.01);
  }
}

}  // namespace
}  // namespace voussoir::install_grouted_test
