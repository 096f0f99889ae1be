// Equilibrium of a run: the forces with which unbalanced forces are compared.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "core/run/simulate.hpp"
#include "core/scene/scene.hpp"
#include "core/step/integrate.hpp"
#include "core/testing/lined_opening.hpp"
#include "core/testing/models.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::rest_test {
namespace {

using Engine = std::mt19937_64;

double decades(Engine& engine) {
  return std::pow(10, std::uniform_real_distribution<>(-6, 6)(engine));
}

template <int Dim>
Vector<Dim> direction(Engine& engine) {
  Vector<Dim> v;
  for (int k = 0; k < Dim; ++k)
    v[k] = std::normal_distribution<>()(engine);
  return v.normalized();
}

// Bodies before any step, with forces of random size from every source; the oracle computes the means separately.
template <int Dim>
void expect_largest_mean(Engine& engine) {
  Model<Dim> model = shapes::block_on_plate<Dim>(0, 0.5);
  for (int k = 0; k < 3; ++k)
    model.bodies.push_back(model.bodies[shapes::index_of(model, "block")]);
  State<Dim> state = initial_state(model);
  const std::size_t count = model.bodies.size();
  const auto chance = [&](double p) { return std::bernoulli_distribution(p)(engine); };
  struct Mean {
    double sum = 0;
    int count = 0;
    void add(double force) {
      sum += force;
      ++count;
    }
    double value() const { return count > 0 ? sum / count : 0; }
  };
  Mean contacts_and_supports, supports;
  std::vector<double> means;
  for (std::size_t c = 0; c < count && chance(0.7); ++c) {
    const double force = decades(engine);
    state.contacts.loads.push_back({static_cast<int>(c), force * direction<Dim>(engine), {}, {}});
    contacts_and_supports.add(force);
  }
  while (chance(0.5)) {
    BoltSpring<Dim> spring;
    spring.broken = chance(0.2);
    spring.force = decades(engine);
    state.supports.bolt_springs.push_back(spring);
    if (spring.broken) continue;
    contacts_and_supports.add(spring.force);
    supports.add(spring.force);
  }
  means = {contacts_and_supports.value(), supports.value()};
  for (const Source source :
       {Source::excavation_forces, Source::applied_forces, Source::water_pressure, Source::gravity}) {
    if (chance(0.5)) continue;
    state.loads.by_source[source].resize(count);
    Mean mean;
    for (std::size_t b = 0; b < count; ++b) {
      if (chance(0.3)) continue;
      const double force = decades(engine);
      state.loads.by_source[source][b].force = force * direction<Dim>(engine);
      if (!model.bodies[b].fixed) mean.add(force);
    }
    if (source != Source::gravity) means.push_back(mean.value());
  }
  const double largest = *std::ranges::max_element(means), off = decades(engine);
  state.loads.total.resize(count);
  state.loads.total[shapes::index_of(model, "block")].force = off * direction<Dim>(engine);
  const double ratio = unbalanced_ratio(model, 1, state);
  if (largest > 0)
    EXPECT_NEAR(ratio * largest / off, 1, 1e-12);
  else
    EXPECT_TRUE(std::isinf(ratio));
}

TEST(Rest, IsMeasuredAgainstTheLargestMeanForce) {
  Engine engine(5204);
  for (int k = 0; k < 500; ++k) {
    expect_largest_mean<2>(engine);
    expect_largest_mean<3>(engine);
  }
}

template <int Dim>
Progress<Dim> run_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return simulated(scene_of<Dim>(text, overrides));
}

// A slab in the roof of an opening, supported by the forces of the rock that was below it, then by two bolts.
const std::string hung_slab = R"(
dimension = 2
gravity = [0, -9.81]
density = 2600
domain = { box = { min = [0, 0], max = [2, 4] } }
joints = [{ name = "roof", dip = 0, point = [0, 3] }, { name = "mid", dip = 0, point = [0, 2] }]
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 35 }]
excavations = [{ name = "hole", outline = true, box = { min = [-1, 1], max = [3, 2] } }]
fix = [{ above = ["roof"] }, { box = { min = [0, 0], max = [2, 1] } }, { side = ["bottom"] }]
[[bolts]]
name = "b"
from = [0.5, 2.2]
to = [0.5, 3.8]
repeat = [{ step = [1, 0], count = 2 }]
stiffness = 1e8
[[stage]]
name = "stress"
kind = "settle"
gravity_ramp_s = 1
[[stage]]
name = "dig"
kind = "settle"
excavate = ["hole"]
install = ["b"]
excavation_forces = { remaining = 1, duration_s = 1 }
step_limit = 100000
[[stage]]
name = "off"
kind = "settle"
excavation_forces = { remaining = 0.4, duration_s = 1 }
)";

// A share of 1 changes nothing. What is let off then comes on the bolts: (1 - share) of the slab's weight, 2 m by 1 m.
TEST(Rest, OfRockThatReliefLoadsHoldComesAtOnce) {
  const double weight = 2600 * 9.81 * 2;
  for (const std::string statics : {"local", "adaptive", "newton"})
    for (const double share : {0.4, 0.9}) {
      const Progress<2> progress = run_of<2>(
          hung_slab, {"statics=" + statics, "stage.off.excavation_forces.remaining=" + std::to_string(share)});
      const Results& results = progress.results;
      ASSERT_EQ(results.outcome, Outcome::done) << results.message;
      for (const BoltRow& bolt : results.bolts) {
        const double carried = bolt.stage == 3 ? 0.5 * (1 - share) * weight : 0;
        EXPECT_NEAR(bolt.force, carried, 1e-5 * weight) << statics << ' ' << share << ' ' << bolt.stage;
      }
      // the stage takes its ramp, 1 s, and the few steps of the equilibrium window
      EXPECT_LT(results.stages[1].time, 1.05) << statics;
      EXPECT_EQ(results.forces_remaining, share);
    }
}

// Water in the joint below a block supports all but a fraction of its weight: the contact supports the rest, and is in
// equilibrium however small that is.
TEST(Rest, IsReachedHoweverLittleTheWaterInAJointLeaves) {
  Engine engine(147);
  const double weight = 4 * 2 * 2000 * 10, area = 4;  // N, m² for each metre
  for (int k = 0; k < 24; ++k) {
    // true motion lifts the almost weightless block, which returns in time
    const std::string statics = std::vector{"adaptive", "newton", "local"}[k % 3];
    const double left = std::pow(10, std::uniform_real_distribution<>(statics == "local" ? -3 : -9, -1)(engine));
    const std::string scene = fmt::format(R"(
dimension = 2
gravity = [0, -10]
density = 2000
domain = {{ box = {{ min = [0, 0], max = [4, 3] }} }}
joints = [{{ name = "bed", dip = 0, point = [0, 1] }}]
joint_properties = [{{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 40 }}]
fix = [{{ below = "bed" }}]
statics = "{}"
water = [{{ name = "seep", pressure = 0, faces = ["bed"] }}]
monitors = [{{ name = "bed", joint = "bed", quantities = ["contact_force"] }}]
[[stage]]
name = "settle"
kind = "settle"
gravity_ramp_s = 0.1
[[stage]]
name = "wet"
kind = "settle"
step_limit = 20000
water = [{{ name = "seep", pressure = {:.17g}, duration_s = 0.1 }}]
)",
                                          statics, weight / area * (1 - left));
    const Progress<2> progress = run_of<2>(scene);
    ASSERT_EQ(progress.results.outcome, Outcome::done) << left << ' ' << progress.results.message;
    // 1e-6 of the water's force may be unbalanced, and the water's force and the weight are rounded
    EXPECT_NEAR(progress.results.find("bed_normal_force")->value, left * weight, 2e-6 * weight) << left;
  }
}

// A lining that has lost contact with the rock on all sides has no equilibrium.
TEST(Rest, IsNotExpectedOfALiningThatHasLeftItsRock) {
  const Prepared<2> prepared =
      scene_of(lined_opening::rock + lined_opening::held + lined_opening::shell + lined_opening::dig);
  Progress<2> progress = initial_progress(prepared);
  ASSERT_TRUE(simulate<2>(prepared, progress, {}));
  ASSERT_EQ(progress.results.outcome, Outcome::done) << progress.results.message;
  // the state of the last stage, its lining shrunk to half its size, at which no node is near rock
  Model<2> model = prepared.model;
  for (const StagePlan& stage : prepared.stages)
    model = apply(std::move(model), stage.change);
  State<2> state = progress.state;
  const Lining& lining = model.linings.front();
  for (std::size_t n = 0; n < lining.nodes.size(); ++n)
    state.bodies.motions[lining.first_body + n].displacement = -0.5 * lining.nodes[n].place;
  for (Body<2>& body : model.bodies)
    if (!body.parts.empty()) body.present = false;
  model.gravity.setZero();
  Settings relaxed = prepared.settings;  // Newton's method ends once its increment has been left to relaxation
  relaxed.statics.method = Statics::adaptive;
  const RunReport report = run<2>(model, relaxed, {.rest = true, .step_limit = 1000}, {}, state);
  EXPECT_EQ(report.reason, StopReason::lining_loose) << describe(report.reason);
  EXPECT_LE(report.steps, 2);
  EXPECT_NE(report.detail.find("'shell'"), std::string::npos) << report.detail;
}

// Unfinished work at a limit of steps is reported: each ramp with its progress, else the duration of equilibrium.
TEST(Rest, UnfinishedWorkAtALimitOfStepsIsReported) {
  const std::string scene = R"(
preset = "thesis"
dimension = 2
gravity = [0, -10]
density = 2000
domain = { box = { min = [0, 0], max = [4, 3] } }
joints = [{ name = "bed", dip = 0, point = [0, 1] }]
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 40 }]
fix = [{ below = "bed" }]
time = { step_s = 1e-3 }
water = [{ name = "seep", pressure = 0, faces = ["bed"] }]
[[stage]]
name = "settle"
kind = "settle"
gravity_ramp_s = 0.05
[[stage]]
name = "wet"
kind = "settle"
step_limit = 120
water = [{ name = "seep", pressure = 2e4, duration_s = 1 }]
)";
  const auto message = [&](const std::vector<std::string>& overrides) {
    return run_of<2>(scene, overrides).results.message;
  };
  EXPECT_NE(message({}).find("; not reached: the water 'seep' (at 12 % of 1 s)"), std::string::npos) << message({});
  const std::string both = message({"stage.settle.step_limit=10", "stage.settle.gravity_ramp_s=0.1"});
  EXPECT_NE(both.find("; not reached: gravity (at 10 % of 0.1 s)"), std::string::npos) << both;
  const std::string window = message({"stage.settle.step_limit=2000", "equilibrium.window=10000"});
  EXPECT_NE(window.find("; not reached: equilibrium in 10000 consecutive steps (equilibrium.window), it lasted for"),
            std::string::npos)
      << window;
}

}  // namespace
}  // namespace voussoir::rest_test
