// Regions that a stage excavates, suddenly or gradually.
#include "core/run/excavate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/step.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::excavate_test {
namespace {

constexpr double weight = 2000 * 10, stiffness = 1e9;  // N/m³, Pa/m

// A fixed floor, on it a block of 6 m by 1 m, and on that another one.
const std::string wall = R"(
dimension = 2
gravity = [0, -10]
density = 2000
domain = { box = { min = [0, 0], max = [6, 3] } }
equilibrium = { unbalanced = 1e-9 }
joint_properties = [{ name = "bed", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40 }]
[[joints]]
name = "floor"
dip = 0
point = [0, 1]
[[joints]]
name = "bed"
dip = 0
point = [0, 2]
[[fix]]
below = ["floor"]
)";

// the middle third of the lower block
const std::string gate = R"(
[[excavations]]
name = "gate"
box = { min = [2, 1], max = [4, 2] }
outline = true
)";

// the upper half of the upper block
const std::string top = R"(
[[excavations]]
name = "top"
box = { min = [-1, 2.5], max = [7, 4] }
outline = true
)";

const std::string settle = "[[stage]]\nname = \"settle\"\nkind = \"settle\"\ngravity_ramp_s = 1\n";

std::string dig(const std::string& name, const std::string& kind, const std::string& more) {
  return "[[stage]]\nname = \"dig\"\nkind = \"" + kind + "\"\nexcavate = [\"" + name + "\"]\n" + more;
}

double sinks(const Progress<2>& progress, int body) {
  return -progress.state.bodies.motions[body].displacement[1];
}

// m: under a column of this height
double overlap_under(double height) {
  return weight * height / stiffness;
}

TEST(Excavation, UntilThenTheRockIsIntact) {
  const Prepared<2> whole = scene_of(wall + gate + top + settle + dig("top\", \"gate", "settle", ""));
  ASSERT_EQ(whole.model.bodies.size(), 3u);
  EXPECT_NEAR(whole.model.bodies[2].mass, 2000 * 6, 1e-9);
  // the gate is excavated at the start, and divides the lower block
  const Prepared<2> parted = scene_of(wall + gate + top + settle + dig("top", "settle", ""));
  EXPECT_EQ(parted.model.bodies.size(), 4u);
  // without an outline a block is excavated completely
  const Prepared<2> simple =
      scene_of(wall + gate + settle + dig("gate", "settle", ""), {"excavations.gate.outline=false"});
  const Model<2> dug = apply(simple.model, simple.stages.back().change);
  EXPECT_FALSE(dug.bodies[1].present);
  EXPECT_TRUE(dug.bodies[2].present);
}

// remaining pieces that are too small are excavated, too
TEST(Excavation, SmallPiecesAreExcavated) {
  const Prepared<2> scene =
      scene_of(wall + top + settle + dig("top", "settle", ""), {"slicing.smallest_inscribed_radius=0.3"});
  ASSERT_EQ(scene.model.bodies.size(), 3u) << "intact until then";
  EXPECT_NEAR(scene.model.bodies[2].mass, 2000 * 6, 1e-9);
  const Model<2> dug = apply(scene.model, scene.stages.back().change);
  EXPECT_FALSE(dug.bodies[2].present) << "half a metre high";
  EXPECT_TRUE(dug.bodies[1].present);
  // pieces have a bound of their own, for excavations by a stage and at the start
  const std::vector<std::string> smaller{"slicing.smallest_inscribed_radius=0.3", "excavations.top.smallest_piece=0.2"};
  const Prepared<2> staged = scene_of(wall + top + settle + dig("top", "settle", ""), smaller);
  EXPECT_TRUE(apply(staged.model, staged.stages.back().change).bodies[2].present);
  EXPECT_EQ(scene_of(wall + top + settle, smaller).model.bodies.size(), 3u);
  EXPECT_EQ(scene_of(wall + top + settle, {"slicing.smallest_inscribed_radius=0.3"}).model.bodies.size(), 2u);
}

// A splinter that an outline cuts off and a body holds does not determine the steps of Newton's method.
TEST(Excavation, SplintersThatAreHeldDoNotShortenNewtonSteps) {
  const std::vector<std::string> newton{"preset=thesis", "statics=newton"};
  const Progress<2> plain = whole_run(scene_of(wall + settle, newton));
  const Progress<2> outlined = whole_run(scene_of(
      wall + top + settle + dig("top", "settle", ""),
      {"preset=thesis", "statics=newton", "excavations.top.box.min=[-1, 2.9999]", "stage.dig.excavate=[\"top\"]"}));
  EXPECT_GT(plain.state.counters.static_iterations, 0);
  // the same number again after the splinter has been removed
  EXPECT_LE(outlined.state.counters.static_iterations, 2 * plain.state.counters.static_iterations + 2);
}

// Half of the upper block is excavated: the remaining half has its id and its own mass and inertia, and all blocks rise
// by the removed stress over the joints' stiffness.
TEST(Excavation, RemainingRockIsUpdatedAndUnloaded) {
  for (const char* statics : {"adaptive", "newton", "local"}) {
    const Prepared<2> scene =
        scene_of(wall + top + settle + dig("top", "settle", ""), {std::string("statics=") + statics});
    const Progress<2> end = whole_run(scene);
    const Model<2> dug = apply(scene.model, scene.stages.back().change);
    ASSERT_EQ(dug.bodies.size(), 3u);
    EXPECT_NEAR(dug.bodies[2].mass, 2000 * 3, 1e-9);
    EXPECT_NEAR(dug.bodies[2].inertia[0], 2000 * 3 * (36 + 0.25) / 12, 1e-9);
    EXPECT_NEAR(dug.bodies[2].reference[1] + dug.origin[1], 2.25, 1e-12);
    EXPECT_NEAR(sinks(end, 1), overlap_under(1.5), 1e-6 * overlap_under(2)) << statics;
    EXPECT_NEAR(sinks(end, 2), overlap_under(2), 1e-6 * overlap_under(2)) << statics;
  }
}

// What is let off acts in proportion: elastic beds rise by as much of the whole rise.
TEST(TakeOut, AShareOfTheForcesGoesOnActing) {
  const std::string later =
      "[[stage]]\nname = \"later\"\nkind = \"settle\"\nexcavation_forces = { remaining = 0, duration_s = 1 }\n";
  for (const char* statics : {"adaptive", "newton", "local"})
    for (const double share : {1.0, 0.4, 0.0}) {
      const std::string first =
          dig("top", "settle", "excavation_forces = { remaining = " + std::to_string(share) + ", duration_s = 1 }\n");
      const std::vector<std::string> how{std::string("statics=") + statics};
      const Progress<2> held = whole_run(scene_of(wall + top + settle + first, how));
      const double height = 0.5 + 0.5 * share;
      EXPECT_NEAR(sinks(held, 1), overlap_under(1 + height), 1e-6 * overlap_under(2)) << statics << share;
      EXPECT_NEAR(sinks(held, 2), overlap_under(1 + 2 * height), 1e-6 * overlap_under(2)) << statics << share;
      EXPECT_EQ(held.state.loads.relief.size(), 1u) << "the lower block loses nothing";
      const Progress<2> gone = whole_run(scene_of(wall + top + settle + first + later, how));
      EXPECT_NEAR(sinks(gone, 1), overlap_under(1.5), 1e-6 * overlap_under(2)) << statics << share;
      EXPECT_LT(gone.results.energy.relative_error(), 1e-3);
    }
}

// The lower block loses its middle and becomes two; a force on the upper one has sheared the beds.
TEST(Excavation, PiecesAreBodiesAndKeepTheirJointForces) {
  const std::string push = R"(
[[stage]]
name = "push"
kind = "settle"
force = [{ name = "push", above = ["bed"], force = [3e4, 0] }]
)";
  for (const int cells : {1, 4}) {
    const Prepared<2> scene = scene_of(wall + gate + settle + push + dig("gate", "settle", ""),
                                       {"joint_properties.bed.sub_contacts=" + std::to_string(cells)});
    Prepared<2> pushed = scene;
    pushed.stages.pop_back();
    State<2> state = whole_run(pushed).state;
    Model<2> model = apply(apply(scene.model, scene.stages[0].change), scene.stages[1].change);
    find_forces(model, scene.settings, state);
    std::vector<Vector<2>> before;  // on the upper block by its contacts, except that with the middle
    for (const Contact<2>& c : state.contacts.list)
      if (c.touching() && model.parts[c.part_b].body == 2 && std::abs(model.polytope(c.part_a).mass.centroid[0]) > 0.1)
        before.push_back(c.force);
    ASSERT_EQ(before.size(), 2u);
    EXPECT_GT(before[0][0], -3e4);
    EXPECT_LT(before[0][0], -3e3) << "sheared";

    excavate({"gate"}, scene.settings, false, model, state);
    ASSERT_EQ(model.bodies.size(), 4u);
    for (const int piece : {1, 3})
      EXPECT_NEAR(model.bodies[piece].mass, 2000 * 2, 1e-9);
    EXPECT_LT(model.bodies[1].reference[0], model.bodies[3].reference[0]);
    find_forces(model, scene.settings, state);
    int found = 0;
    for (const Contact<2>& c : state.contacts.list) {
      if (!c.touching()) continue;
      const int a = model.parts[c.part_a].body, b = model.parts[c.part_b].body;
      if (a == 0) continue;  // the floor
      const bool turned = b == 3;
      const Vector<2> force = turned ? Vector<2>(-c.force) : c.force;
      EXPECT_LT((force - before[turned]).norm(), 1e-6 * before[turned].norm()) << cells;
      ++found;
    }
    EXPECT_EQ(found, 2);
    whole_run(scene);  // and reaches equilibrium
  }
}

// A piece of a flying, rotating block keeps the motion of its material.
TEST(Excavation, APieceInFlightKeepsItsVelocity) {
  const std::string text = R"(
dimension = 2
density = 2000
domain = { box = { min = [0, 0], max = [4, 2] } }
time = { step_s = 1e-3 }
[[excavations]]
name = "half"
box = { min = [2, -1], max = [5, 3] }
outline = true
[[initial_velocity]]
all = true
velocity = [1, 2]
angular_velocity = 3
[[stage]]
name = "fly"
kind = "run"
duration_s = 0.1
[[stage]]
name = "dig"
kind = "run"
duration_s = 0.2
excavate = ["half"]
)";
  const Prepared<2> scene = scene_of(text);
  const Progress<2> end = whole_run(scene);
  const double angle = 3 * 0.1;
  const Vector<2> arm(-std::cos(angle), -std::sin(angle));  // from the old centroid to the new one
  const Vector<2> velocity(1 - 3 * arm[1], 2 + 3 * arm[0]);
  const Vector<2> at_dig = Vector<2>(2, 1) + 0.1 * Vector<2>(1, 2) + arm;
  const Vector<2> expected = at_dig + 0.2 * velocity - Vector<2>(1, 1);
  EXPECT_LT((end.state.bodies.motions[0].displacement - expected).norm(), 1e-2);  // velocities are half a step behind
  EXPECT_LT((end.state.bodies.motions[0].velocity - velocity).norm(), 1e-2);
  EXPECT_NEAR(end.state.bodies.motions[0].angular_momentum[0], 3 * 2000 * 4 * (4 + 4) / 12., 1e-6);
}

// Neither an interruption nor threads have an effect, in any stage.
TEST(Excavation, SurvivesAnInterruption) {
  const std::string text = wall + gate + top + settle +
                           dig("gate", "run", "duration_s = 0.02\nexcavation_forces = { remaining = 0.3 }\n") +
                           "[[stage]]\nname = \"rest\"\nkind = \"settle\"\nexcavate = [\"top\"]\n";
  Prepared<2> scene = scene_of(text);
  const Progress<2> whole = whole_run(scene);
  ASSERT_FALSE(whole.state.loads.relief.empty());
  const long long steps = whole.state.counters.steps;
  for (const double fraction : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) {
    const Progress<2> second = continued(scene, static_cast<long long>(fraction * static_cast<double>(steps)));
    EXPECT_EQ(second.results.state_hash, whole.results.state_hash) << fraction;
  }
  scene.settings.threads = 3;
  EXPECT_EQ(whole_run(scene).results.state_hash, whole.results.state_hash);
}

// Two blocks on a smooth floor pressed together from both sides: the floor supports their weight, and the joint between
// them has the stress of the depth, up to the joints' closure over the blocks' size.
TEST(InSitu, StressBetweenTwoSidesIsThatOfTheDepth) {
  const std::string text = R"(
dimension = 2
gravity = [0, -10]
density = 2000
domain = { box = { min = [-5, -4], max = [5, 4] } }
equilibrium = { unbalanced = 1e-8 }
joint_properties = [{ name = "rock", normal_stiffness = 1e11, shear_stiffness = 5e10, friction_deg = 40, sub_contacts = 2 },
                    { name = "smooth", normal_stiffness = 1e11, shear_stiffness = 5e10, friction_deg = 0 }]
[[joints]]
name = "wall"
dip = 90
dip_direction = 90
point = [0, 0]
properties = "rock"
[[joints]]
name = "floor"
dip = 0
point = [0, -3]
properties = "smooth"
[[fix]]
side = ["bottom"]
[[stage]]
name = "stress"
kind = "settle"
gravity_ramp_s = 1
[[stage.boundary]]
side = ["left", "right"]
box = { min = [-5, -3], max = [5, 4] }
in_situ = { surface = 4, k0 = 0.5 }
)";
  const Prepared<2> scene = scene_of(text);
  ASSERT_EQ(scene.model.bodies.size(), 4u);
  const Progress<2> end = whole_run(scene);
  const Model<2> model = apply(scene.model, scene.stages.front().change);
  EXPECT_EQ(model.boundary.size(), 2u) << "the two upper ones";
  double across = 0, down = 0;  // N/m
  for (const Contact<2>& c : end.state.contacts.list) {
    const bool on_floor =
        model.bodies[model.parts[c.part_a].body].fixed || model.bodies[model.parts[c.part_b].body].fixed;
    if (c.touching()) (on_floor ? down : across) += std::abs(c.force[on_floor]);
  }
  EXPECT_NEAR(across, 0.5 * weight * 7 * 7 / 2, 1e-6 * weight * 12) << "of 7 m of depth";
  EXPECT_NEAR(down, weight * 70, 1e-6 * weight * 70);
}

}  // namespace
}  // namespace voussoir::excavate_test
