// Sides that waves leave, in whole runs: what stays when a side opens, energy, bits, and columns beyond free fields.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/model/state_hash.hpp"
#include "core/run/stage_in_force.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::open_sides_test {
namespace {

const std::string rock = R"([[joint_properties]]
name = "rock"
normal_stiffness = 1e10
shear_stiffness = 5e9
friction_deg = 60
[contact]
face = "integrated"
[output]
frames = false
[time]
step_s = 2e-5
)";

// 5 by 6 blocks under their weight, the base fixed until it is quiet
const std::string ground = R"(dimension = 2
density = 2500
gravity = [0, -9.81]
domain = { box = { min = [0, 0], max = [5, 6] } }
[equilibrium]
unbalanced = 1e-9
[[joints]]
name = "bed"
dip = 0
point = [0, 1]
[[joints]]
name = "cross"
dip = 90
dip_direction = 90
point = [1, 0]
[[repeat]]
name = "beds"
joints = ["bed"]
count = 5
shift = [0, 1]
[[repeat]]
name = "crosses"
joints = ["cross"]
count = 4
shift = [1, 0]
[[fix]]
side = ["bottom"]
[[stage]]
name = "settle"
kind = "settle"
gravity_ramp_s = 0.2
[[stage.boundary]]
side = ["left", "right"]
stress = [5e4, 0, 0]
[[stage]]
name = "open"
kind = "run"
duration_s = 0.03
)" + rock;
const std::string quiet_base = "[[stage.boundary]]\nside = [\"bottom\"]\nquiet = {}\n";
const std::string shaken_base =
    "[[stage.boundary]]\nside = [\"bottom\"]\nquiet = { input = \"upgoing\", velocity = [1e-3, 5e-4], frequency_hz = "
    "50, "
    "times_s = [0, 0.01, 0.02], factors = [0, 1, 0] }\n";
const std::string free_sides =
    "[[stage.boundary]]\nside = [\"left\"]\nfree_field = {}\n[[stage.boundary]]\nside = [\"right\"]\nfree_field = {}\n";

double fastest(const Progress<2>& progress) {
  double most = 0;
  for (const Motion<2>& m : progress.state.bodies.motions)
    most = std::max(most, m.velocity.norm());
  return most;
}

// m: by how much anything has moved in the last stage
template <int Dim>
double moved_since(const Prepared<Dim>& scene, const Progress<Dim>& progress) {
  Prepared<Dim> before = scene;
  before.last_stage = 0;
  const Progress<Dim> settled = simulated(before);
  double most = 0;
  for (std::size_t b = 0; b < settled.state.bodies.motions.size(); ++b)
    most = std::max(
        most, (progress.state.bodies.motions[b].displacement - settled.state.bodies.motions[b].displacement).norm());
  return most;
}

using Overrides = std::vector<std::string>;
const Overrides explicit_steps, implicit_steps{"stage.open.time.integration=implicit", "stage.open.time.step_s=2e-4"};
const std::vector<Overrides> both{explicit_steps, implicit_steps};

Overrides during_the_wave(Overrides steps) {
  steps.push_back("stage.open.duration_s=0.012");
  return steps;
}

// The weight of the model rests on the reactions of the base that was fixed: without them it would fall by 4.4 mm.
TEST(OpenSides, WhatWasAtRestStaysAtRest) {
  for (const std::string& sides : {quiet_base, quiet_base + free_sides})
    for (const Overrides& steps : both) {
      const Prepared<2> scene = scene_of(ground + sides, steps);
      const Progress<2> run = whole_run(scene);
      EXPECT_LT(moved_since(scene, run), 1e-9);
    }
}

TEST(OpenSides, EnergyIsWhatCameInLessWhatWentOut) {
  for (const std::string& sides : {shaken_base, shaken_base + free_sides})
    for (const Overrides& steps : both) {
      const Progress<2> run = whole_run(scene_of(ground + sides, steps));
      const EnergyBalance& energy = run.state.ledger.energy;
      EXPECT_GT(energy.flows[Source::incoming_waves], 0);
      EXPECT_GT(energy.flows[Source::outgoing_waves], 0);
      EXPECT_LT(std::abs(energy.motion_error), 1e-9 * energy.largest_energy);
      // of the contacts: the geometry that changes along the path
      EXPECT_LT(std::abs(energy.unexplained()), 1e-3 * energy.flows[Source::incoming_waves]);
    }
}

TEST(OpenSides, SameBitsOnThreadsAndFromACheckpoint) {
  for (const Overrides& steps : both) {
    Prepared<2> scene = scene_of(ground + shaken_base + free_sides, during_the_wave(steps));
    const Progress<2> once = whole_run(scene);
    const std::string hash = state_hash(model_after(scene, 2), once.state);
    scene.settings.threads = 3;
    EXPECT_EQ(state_hash(model_after(scene, 2), whole_run(scene).state), hash);
    scene.settings.threads = 1;
    for (const long long back : {7LL, 1LL}) {
      const Progress<2> again = continued(scene, once.state.counters.steps - back);
      EXPECT_EQ(state_hash(model_after(scene, 2), again.state), hash) << back;
    }
  }
}

// a force that comes after the side has opened finds no spring there
TEST(OpenSides, CreepIsReported) {
  const Progress<2> run = whole_run(
      scene_of(ground + quiet_base + "[[stage.force]]\nname = \"crane\"\nside = [\"top\"]\nforce = [0, -1e5]\n",
               {"stage.open.duration_s=0.3"}));
  const std::vector<std::string>& warnings = run.results.warnings;
  EXPECT_TRUE(std::ranges::any_of(
      warnings, [](const std::string& w) { return w.find("quiet side bottom has crept") != std::string::npos; }));
  EXPECT_TRUE(std::ranges::none_of(whole_run(scene_of(ground + shaken_base)).results.warnings,
                                   [](const std::string& w) { return w.find("crept") != std::string::npos; }));
}

// Level ground pressed together by a micrometre on all sides: geometry changes by 1e-6.
const std::string level = R"(dimension = 2
density = 2500
gravity = [0, 0]
domain = { box = { min = [0, 0], max = [5, 6] } }
[equilibrium]
unbalanced = 1e-9
[[joints]]
name = "bed"
dip = 0
point = [0, 1]
[[joints]]
name = "cross"
dip = 90
dip_direction = 90
point = [1, 0]
[[repeat]]
name = "beds"
joints = ["bed"]
count = 5
shift = [0, 1]
[[repeat]]
name = "crosses"
joints = ["cross"]
count = 4
shift = [1, 0]
[[stage]]
name = "settle"
kind = "settle"
[[stage.boundary]]
all = true
stress = [1e4, 1e4, 0]
[[stage]]
name = "open"
kind = "run"
duration_s = 0.03
)" + rock;
const std::string small_shear =
    "[[stage.boundary]]\nside = [\"bottom\"]\nquiet = { input = \"upgoing\", velocity = [1e-4, 0], frequency_hz = 50, "
    "times_s = [0, 0.01, 0.02], factors = [0, 1, 0] }\n";

// a burst leaves through the base, and nothing moves a little later
TEST(OpenSides, TheWaveLeaves) {
  for (const Overrides& steps : both) {
    Overrides longer = steps;
    longer.push_back("stage.open.duration_s=0.1");
    const Progress<2> run = whole_run(scene_of(level + small_shear + free_sides, longer));
    EXPECT_LT(fastest(run), 1e-3 * 1e-4);
    const EnergyFlows& flows = run.state.ledger.energy.flows;
    const double unresolved = flows[Source::unresolved_motion] + flows[Source::unresolved_springs];
    EXPECT_NEAR((flows[Source::outgoing_waves] + unresolved) / flows[Source::incoming_waves], 1, 2e-3);
  }
}

// largest difference between the velocities of the blocks of one height, over the entering wave's 1e-4 m/s
template <int Dim>
double uneven(const Model<Dim>& model, const State<Dim>& state) {
  constexpr double entering = 1e-4;
  double most = 0;
  for (std::size_t a = 0; a < model.bodies.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      if (std::abs(model.bodies[a].reference[Dim - 1] - model.bodies[b].reference[Dim - 1]) > 0.1) continue;
      const Vector<Dim>&va = state.bodies.motions[a].velocity, &vb = state.bodies.motions[b].velocity;
      most = std::max(most, (va - vb).norm());
    }
  return most / entering;
}

// Where blocks meet at corners, those that stand at a free surface are pressed by 0.01 N more by one law of the corner
// than by the other, when implicit steps begin: 4e-5 of the wave's force.
const std::array within{1e-5, 5e-4};

// D16: blocks of the model, of the columns and their images move alike
TEST(FreeField, LevelGroundMovesAsItsColumns) {
  for (int i = 0; i < 2; ++i) {
    const Prepared<2> scene = scene_of(level + small_shear + free_sides, during_the_wave(both[i]));
    const Progress<2> run = whole_run(scene);
    const Model<2> model = model_after(scene, 2);
    EXPECT_EQ(model.column_bodies.size(), 12u);
    EXPECT_EQ(model.column_images.size(), 24u);
    EXPECT_EQ(model.bodies.size(), 30u + 36u);
    EXPECT_LT(uneven(model, run.state), within[i]);
  }
  // sides that are only quiet hold it back
  const Prepared<2> held = scene_of(level + small_shear +
                                        "[[stage.boundary]]\nside = [\"left\"]\nquiet = {}\n[[stage.boundary]]\nside = "
                                        "[\"right\"]\nquiet = {}\n",
                                    during_the_wave(explicit_steps));
  EXPECT_GT(uneven(model_after(held, 2), whole_run(held).state), 0.1);
}

TEST(FreeField, InSpaceToo) {
  const std::string cubes = R"(dimension = 3
density = 2500
domain = { box = { min = [0, 0, 0], max = [3, 3, 4] } }
[equilibrium]
unbalanced = 1e-9
[[joints]]
name = "x"
dip = 90
dip_direction = 90
point = [1, 0, 0]
[[joints]]
name = "y"
dip = 90
dip_direction = 0
point = [0, 1, 0]
[[joints]]
name = "z"
dip = 0
dip_direction = 0
point = [0, 0, 1]
[[repeat]]
name = "xs"
joints = ["x"]
count = 2
shift = [1, 0, 0]
[[repeat]]
name = "ys"
joints = ["y"]
count = 2
shift = [0, 1, 0]
[[repeat]]
name = "zs"
joints = ["z"]
count = 3
shift = [0, 0, 1]
[[stage]]
name = "settle"
kind = "settle"
[[stage.boundary]]
all = true
stress = [1e4, 1e4, 1e4, 0, 0, 0]
[[stage]]
name = "open"
kind = "run"
duration_s = 0.02
)" + rock + R"([[stage.boundary]]
side = ["bottom"]
quiet = { input = "upgoing", velocity = [1e-4, 5e-5, 0], frequency_hz = 50, times_s = [0, 0.01, 0.02], factors = [0, 1, 0] }
)";
  std::string sides;
  for (const char* side : {"west", "east", "south", "north"})
    sides += "[[stage.boundary]]\nside = [\"" + std::string(side) + "\"]\nfree_field = {}\n";
  for (int i = 0; i < 2; ++i) {
    Overrides steps = during_the_wave(both[i]);
    if (i == 0) steps.push_back("stage.open.time.step_s=1e-4");
    const Prepared<3> scene = scene_of<3>(cubes + sides, steps);
    const Progress<3> run = whole_run(scene);
    const Model<3> model = model_after(scene, 2);
    EXPECT_EQ(model.column_bodies.size(), 48u);
    EXPECT_LT(uneven(model, run.state), within[i]);
  }
}

}  // namespace
}  // namespace voussoir::open_sides_test
