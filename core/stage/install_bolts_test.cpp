// Bolts in complete scenes: forces, anchors, excavation, identical bits.
#include "core/stage/install_bolts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/testing/hung_slab.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::install_bolts_test {
namespace {

using hung_slab::hang;
using hung_slab::slab;
using hung_slab::stage;
using hung_slab::weight;

std::string bolts(const std::string& more, const std::string& name = "roof") {
  return "[[bolts]]\nname = \"" + name + "\"\nstiffness = 1e8\n" + more + "\n";
}
// three of them, vertical, 2 m long
const std::string row = "from = [1, 0.2]\nto = [1, 2.2]\nrepeat = [{ step = [1, 0], count = 3 }]\n";

template <int Dim>
std::vector<double> forces(const Progress<Dim>& progress) {
  std::vector<double> all;
  for (const BoltSpring<Dim>& spring : progress.state.supports.bolt_springs)
    all.push_back(spring.force);
  return all;
}

TEST(Bolts, ShareTheWeightThatHangsFromThem) {
  for (const char* anchors : {"offset", "at_joint", "midway"})
    for (const double spacing : {1.0, 2.5}) {
      const Progress<2> done = simulated(
          scene_of(slab + bolts(row + "anchors = \"" + anchors + "\"\nspacing = " + std::to_string(spacing)) + hang));
      ASSERT_EQ(done.results.outcome, Outcome::done) << done.results.message;
      ASSERT_EQ(done.results.bolts.size(), 3u);
      for (const BoltRow& bolt : done.results.bolts)
        EXPECT_NEAR(bolt.force, spacing * weight / 3, 1e-6 * spacing * weight / 3) << anchors;
      EXPECT_LT(done.results.energy.relative_error(), 0.01);
    }
}

TEST(Bolts, InThreeDimensionsHoldByThePlate) {
  const std::string text = R"(
dimension = 3
gravity = [0, 0, -10]
density = 2500
domain = { box = { min = [0, 0, 0], max = [4, 2, 3] } }
equilibrium = { unbalanced = 1e-9 }
joint_properties = [{ name = "bed", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40, sub_contacts = 2 }]
joints = [{ name = "bed", dip = 0, point = [0, 0, 1] }]
fix = [{ above = ["bed"] }]
[[bolts]]
name = "roof"
kind = "end_anchored"
axial_stiffness = 1e8
from = [1, 0.5, -1]
to = [1, 0.5, 2]
repeat = [{ step = [2, 0, 0], count = 2 }, { step = [0, 1, 0], count = 2 }]
)" + hang;
  const Progress<3> done = simulated(scene_of<3>(text));
  ASSERT_EQ(done.results.outcome, Outcome::done) << done.results.message;
  ASSERT_EQ(done.state.supports.bolt_springs.size(), 4u);
  for (const BoltSpring<3>& spring : done.state.supports.bolt_springs) {
    EXPECT_NEAR(spring.force, 2 * weight / 4, 1e-6 * weight);
    EXPECT_NEAR(spring.length, 2, 1e-12) << "from the face to the end: the length outside the rock does not count";
    EXPECT_NEAR(spring.extension, spring.force / (1e8 / 2), 1e-9);
  }

  // inclined bolts, by relaxation and by Newton's method
  const std::string leaning = "bolts.roof.to=[1.7, 0.9, 2]";
  const Progress<3> relaxed = simulated(scene_of<3>(text, {leaning}));
  const Progress<3> newton = simulated(scene_of<3>(text, {leaning, "statics=\"newton\""}));
  ASSERT_EQ(relaxed.results.outcome, Outcome::done) << relaxed.results.message;
  ASSERT_EQ(newton.results.outcome, Outcome::done) << newton.results.message;
  EXPECT_GT(newton.results.counters.static_iterations, 0);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(forces(newton)[i], forces(relaxed)[i], 1e-4 * weight);
}

TEST(Bolts, HoldAtATenthOfAPercentMoreThanTheWeightAndNotAtLess) {
  for (const double of_weight : {1.001, 0.999}) {
    Prepared<2> scene = scene_of(slab + bolts(row + "yield = " + std::to_string(of_weight * weight / 3)) +
                                 stage("gravity_ramp_s = 1\ninstall = [\"roof\"]\nstep_limit = 20000"));
    const Progress<2> done = simulated(scene);
    EXPECT_EQ(done.results.outcome, of_weight > 1 ? Outcome::done : Outcome::incomplete) << done.results.message;
  }
}

TEST(Bolts, CompressTheJointsByTheirPretension) {
  constexpr double kn = 1e9, area = 1, K = 2e8, F0 = 1e5;
  for (const int joints : {1, 10}) {
    std::string text =
        "dimension = 2\ndensity = 2500\nequilibrium = { unbalanced = 1e-9 }\n"
        "joint_properties = [{ name = \"bed\", normal_stiffness = 1e9, shear_stiffness = 5e8, "
        "friction_deg = 40, sub_contacts = 2 }]\n";
    const std::string height = std::to_string(joints + 1);
    text += "domain = { box = { min = [0, 0], max = [1, " + height + "] } }\n";
    for (int k = 1; k <= joints; ++k)
      text += "[[joints]]\nname = \"j" + std::to_string(k) + "\"\ndip = 0\npoint = [0, " + std::to_string(k) + "]\n";
    text += "[[fix]]\nbelow = [\"j1\"]\n[[bolts]]\nname = \"roof\"\nfrom = [0.5, " + height +
            "]\nto = [0.5, 0]\nstiffness = 2e8\npretension = 1e5\n" + stage("install = [\"roof\"]");
    const Progress<2> done = simulated(scene_of(text));
    ASSERT_EQ(done.results.outcome, Outcome::done) << done.results.message;
    ASSERT_EQ(done.state.supports.bolt_springs.size(), static_cast<std::size_t>(joints));
    for (const double force : forces(done))
      EXPECT_NEAR(force, F0 * kn * area / (kn * area + K), 1e-4 * F0);
  }
}

TEST(Bolts, AreTheSameByNewtonsMethod) {
  const std::string text = slab + bolts(row) + bolts("from = [0.5, 0.5]\nto = [2, 2]\n", "inclined") +
                           stage("gravity_ramp_s = 1\ninstall = [\"roof\", \"inclined\"]");
  const std::vector<double> relaxed = forces(simulated(scene_of(text)));
  const Progress<2> done = simulated(scene_of(text, {"statics=\"newton\""}));
  ASSERT_EQ(done.results.outcome, Outcome::done) << done.results.message;
  EXPECT_GT(done.results.counters.static_iterations, 0);
  EXPECT_EQ(done.results.counters.static_fallbacks, 0);
  ASSERT_EQ(relaxed.size(), 4u);
  for (std::size_t i = 0; i < relaxed.size(); ++i)
    EXPECT_NEAR(forces(done)[i], relaxed[i], 1e-5 * weight);
}

TEST(Bolts, AnchorInTheMiddleOfThinBlocks) {
  // a bed 40 mm thick between the roof and the block below
  const Prepared<2> scene =
      scene_of(slab + "[[joints]]\nname = \"thin\"\ndip = 0\npoint = [0, 0.96]\n" + bolts(row) + hang);
  const std::vector<BoltSpring<2>> springs = springs_of(scene.model, scene.state, 0);
  ASSERT_EQ(springs.size(), 2u);
  for (const BoltSpring<2>& spring : springs) {
    EXPECT_NEAR(spring.length, 0.02 + 1.2 * 0.028, 1e-12);
    EXPECT_TRUE(shortened(scene.model, spring));
  }
}

TEST(Bolts, WarnIfTheyCrossNoJoint) {
  const Progress<2> done = simulated(
      scene_of(slab + bolts("from = [1, 1.5]\nto = [2, 2.5]\n") + stage("step_limit = 10\ninstall = [\"roof\"]")));
  ASSERT_FALSE(done.results.warnings.empty());
  EXPECT_NE(done.results.warnings.front().find("cross no joint"), std::string::npos);
}

// The lower third of the block below the bolts is excavated, and then the block that one of them holds.
std::string digging() {
  return slab + R"(
[[excavations]]
name = "bench"
box = { min = [0, 0], max = [4, 0.3] }
outline = true
)" + bolts("from = [1, 0.4]\nto = [1, 2.2]\nrepeat = [{ step = [1, 0], count = 3 }]\n") +
         hang;
}

TEST(Bolts, StayInTheRemainingPartsOfTheirBlocks) {
  const Progress<2> done = simulated(scene_of(digging() + stage("excavate = [\"bench\"]", "dig")));
  ASSERT_EQ(done.results.outcome, Outcome::done) << done.results.message;
  for (const double force : forces(done))
    EXPECT_NEAR(force, 0.7 * weight / 3, 1e-6 * weight);
  const Progress<2> gone = simulated(scene_of(digging() + stage("remove = [{ below = [\"bed\"] }]", "dig")));
  EXPECT_TRUE(gone.state.supports.bolt_springs.empty());
}

TEST(Bolts, SurviveInterruptionsThreadsAndTheOrderOfTheFile) {
  const std::string one = bolts(row + "yield = 20e3\ndowel_stiffness = 1e7\n"),
                    other = bolts("from = [0.5, 0.5]\nto = [2, 2]\npretension = 1e4\n", "inclined");
  const std::string dug = R"(
[[excavations]]
name = "bench"
box = { min = [0, 0], max = [1.5, 0.3] }
outline = true
)",
                    stages = stage("gravity_ramp_s = 1\ninstall = [\"inclined\"]") +
                             "[[stage]]\nname = \"run\"\nkind = \"run\"\nduration_s = 0.05\ninstall = [\"roof\"]\n" +
                             stage("excavate = [\"bench\"]", "dig");
  Prepared<2> scene = scene_of(slab + dug + one + other + stages);
  const Progress<2> whole = simulated(scene);
  ASSERT_EQ(whole.results.outcome, Outcome::done) << whole.results.message;
  ASSERT_EQ(whole.state.supports.bolt_springs.size(), 4u);
  EXPECT_EQ(simulated(scene_of(slab + dug + other + one + stages)).results.state_hash, whole.results.state_hash);
  const double steps = static_cast<double>(whole.state.counters.steps);
  for (const double fraction : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) {
    const Progress<2> second = continued(scene, static_cast<long long>(fraction * steps));
    EXPECT_EQ(second.results.state_hash, whole.results.state_hash) << fraction;
    EXPECT_EQ(second.results.bolts.size(), whole.results.bolts.size());
  }
  scene.settings.threads = 3;
  EXPECT_EQ(simulated(scene).results.state_hash, whole.results.state_hash);
}

// A wedge of rock supported by yielding bolts oscillates: kinetic, elastic and plastic energy add up.
TEST(Bolts, KeepTheEnergyBalanceOfAMotion) {
  const Prepared<2> scene = scene_of(
      slab + bolts(row + "yield = 50e3\ndowel_stiffness = 1e7\ndowel_strength = 1e3\n") +
      "[[stage]]\nname = \"run\"\nkind = \"run\"\nduration_s = 0.3\ninstall = [\"roof\"]\ndamping = { local = 0 }\n");
  const Progress<2> done = simulated(scene);
  const EnergyBalance& energy = done.results.energy;
  EXPECT_GT(energy.flows[Source::bolt_yield], 0.1 * energy.largest_energy);
  EXPECT_LT(std::abs(energy.motion_error), 1e-10 * energy.largest_energy);
  EXPECT_LT(energy.relative_error(), 0.01);
}

// The sum of the bolts' forces on all blocks is zero, and that of gravity is their weight, or its mean.
TEST(Monitors, SumAndAverageOverBlocks) {
  const auto monitor = [](const std::string& name, const std::string& over, const std::string& quantity) {
    return "[[monitors]]\nname = \"" + name + "\"\nall = true\nover = \"" + over + "\"\nquantities = [\"" + quantity +
           "\"]\n";
  };
  const Progress<2> done =
      simulated(scene_of(slab + bolts(row) + hang + monitor("bolts", "sum", "bolt_load") +
                         monitor("weights", "sum", "gravity_load") + monitor("ways", "mean", "displacement")));
  const auto value = [&](const char* name) { return done.results.find(name)->value; };
  EXPECT_EQ(value("bolts_sum_bolt_load_y"), 0);
  EXPECT_DOUBLE_EQ(value("weights_sum_gravity_load_y"), -3 * weight);
  double sum = 0;
  for (const Motion<2>& m : done.state.bodies.motions)
    sum += m.displacement[1];
  EXPECT_LT(sum, 0);
  EXPECT_DOUBLE_EQ(value("ways_mean_displacement_y"), sum / 2);

  // only the roof remains after the excavation of the slab
  const Progress<2> dug = simulated(
      scene_of(slab + "[[blocks]]\nname = \"crumb\"\nbox = { min = [0, 5], max = [1, 6] }\n" +
               stage("remove = [{ below = [\"bed\"] }]\nstep_limit = 10") + monitor("weights", "sum", "gravity_load")));
  EXPECT_DOUBLE_EQ(dug.results.find("weights_sum_gravity_load_y")->value, -2 * weight - 2500 * 10);
}

}  // namespace
}  // namespace voussoir::install_bolts_test
