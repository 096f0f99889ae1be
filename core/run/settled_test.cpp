// Bodies displaced in a stage, its sentence on their motion, and the messages of the run.
#include "core/run/settled.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "core/run/checkpoint.hpp"
#include "core/run/simulate.hpp"
#include "core/scene/scene.hpp"
#include "core/testing/whole_runs.hpp"
#include "text/angle.hpp"

namespace voussoir::settled_test {
namespace {

using Engine = std::mt19937_64;

double between(Engine& engine, double low, double high) {
  return std::uniform_real_distribution<>(low, high)(engine);
}

std::string head(const std::string& gravity = "[0, -10]") {
  return "dimension = 2\ndensity = 2000\nstatics = \"local\"\ngravity = " + gravity +
         "\njoint_properties = [{ name = \"rock\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 20 "
         "}]\n";
}
const std::string leaning = "[5, -10]";

std::string box(const std::string& name, double x, double y, double width, double height, bool fixed = false) {
  return fmt::format(
      "[[blocks]]\nname = \"{}\"\nbox = {{ min = [{:.17g}, {:.17g}], max = [{:.17g}, {:.17g}] }}\nfixed = {}\n", name,
      x, y, x + width, y + height, fixed);
}

const std::string settle = "[[stage]]\nname = \"settle\"\nkind = \"settle\"\ngravity_ramp_s = 0.1\n";
const std::string search =
    "[[stage]]\nname = \"search\"\nkind = \"reduce\"\nfrom_deg = 20\nto_deg = 1\ntolerance_deg = 0.5\n";

Results results_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return simulated(scene_of(text, overrides)).results;
}

// A block of 1 m by 1 m that slides on a floor under inclined gravity, until a wall stops it after `gap`; one on top
// rides with it.
std::string slider(double gap, bool rider) {
  return head(leaning) + box("floor", -5, -1, 30, 1, true) + box("wall", 1 + gap, 0, 1, 3, true) +
         box("block", 0, 0, 1, 1) + (rider ? box("rider", 0.2, 1, 0.6, 0.4) : "");
}

TEST(Settled, ABodyThatSlidByMoreThanATenthOfItsInscribedRadiusIsNamed) {
  Engine engine(13);
  for (int k = 0; k < 16; ++k) {
    // half of them on either side of a tenth of its inscribed radius of 0.5 m
    const double gap = k % 2 == 0 ? between(engine, 0.01, 0.045) : between(engine, 0.055, 1.5);
    const Results results = results_of(slider(gap, false) + settle);
    ASSERT_EQ(results.outcome, Outcome::done) << results.message;
    ASSERT_EQ(results.moved.size(), gap > 0.05 ? 1u : 0u) << gap;
    EXPECT_EQ(results.warnings.size(), results.moved.size());
    if (gap < 0.05) continue;
    const MovedBody& moved = results.moved.front();
    EXPECT_EQ(moved.stage, "settle");
    EXPECT_EQ(moved.name, "block");
    EXPECT_NEAR(moved.distance, gap, 1e-3);  // joints of 1e9 Pa/m close by micrometres
    EXPECT_NEAR(moved.place[0], 0.5 + gap, 1e-3);
    EXPECT_FALSE(moved.left_all) << "the floor is still below it";
    EXPECT_NE(results.warnings.front().find("(block) moved by"), std::string::npos) << results.warnings.front();
  }
}

TEST(Settled, ABodyOnAMovedBodyHasMovedToo) {
  const Results results = results_of(slider(1.2, true) + settle);
  ASSERT_EQ(results.moved.size(), 2u);
  for (const MovedBody& moved : results.moved)
    EXPECT_NEAR(moved.distance, 1.2, 0.25) << moved.name << " may slip on the lower block";
}

// A search afterwards would examine another slope.
TEST(Settled, ASearchAfterASlideIsNotBegun) {
  for (const double gap : {0.03, 0.3}) {
    const Results results = results_of(slider(gap, false) + settle + search);
    const bool moved = gap > 0.05;
    EXPECT_EQ(results.moved.size(), moved ? 1u : 0u);
    EXPECT_EQ(results.stages.size(), moved ? 1u : 2u);
    if (moved) {
      EXPECT_EQ(results.outcome, Outcome::incomplete);
      EXPECT_NE(results.message.find("the search that follows"), std::string::npos) << results.message;
    }
  }
}

// A fall onto a floor is not a failure; a block that has slid off its shelf has lost its support.
TEST(Settled, OnlyABodyThatLeftEveryContactEndsTheRun) {
  const std::string floor = box("floor", -5, -1, 30, 1, true);
  const Results fallen = results_of(head() + floor + box("block", 0, 2, 1, 1) + settle);
  EXPECT_EQ(fallen.outcome, Outcome::done) << fallen.message;
  ASSERT_EQ(fallen.moved.size(), 1u);
  EXPECT_NEAR(fallen.moved.front().distance, 2, 1e-3);
  EXPECT_FALSE(fallen.moved.front().left_all);

  const Results off = results_of(head(leaning) + box("floor", -5, -1, 60, 1, true) + box("stop", 30, 0, 1, 20, true) +
                                 box("shelf", 0, 0, 2, 1, true) + box("block", 0.9, 1, 1, 1) + settle);
  EXPECT_EQ(off.outcome, Outcome::incomplete) << off.message;
  ASSERT_EQ(off.moved.size(), 1u);
  EXPECT_TRUE(off.moved.front().left_all);
  EXPECT_NE(off.message.find("lost every contact that it had"), std::string::npos) << off.message;
}

// Soft joints close by far more than the thickness of a plate; none of the plates has moved.
TEST(Settled, JointClosureIsNoMotion) {
  std::string text = head() + box("floor", -5, -1, 10, 1, true);
  for (int k = 0; k < 12; ++k)
    text += box(fmt::format("plate-{}", k), 0, 0.1 * k, 1, 0.1);
  const Results results =
      results_of(text + settle, {"joint_properties.rock.normal_stiffness=2e6",
                                 "joint_properties.rock.shear_stiffness=1e6", "contact.potential_radius=0.5"});
  ASSERT_EQ(results.outcome, Outcome::done) << results.message;
  EXPECT_TRUE(results.moved.empty());
}

// A body that rides on a driven base has not moved relative to it; random motions of a base, compared with a fixed one.
TEST(Settled, MotionIsRelativeToTheSupportingBody) {
  Engine engine(62);
  for (int k = 0; k < 200; ++k) {
    Model<2> model =
        prepare<2>(
            parse_scene(head() + box("base", -5, -1, 10, 1, true) + box("block", 0, 0, 1, 1) + settle, "scene.toml"))
            .model;
    State<2> state = initial_state(model);
    const int base = select(model, {.names = {"base"}, .above = {}, .below = {}, .inside = {}}).front();
    const int block = 1 - base;
    SettleBegin<2> begin{.placed = {}, .near = {{0, 1, true}}};
    for (const Motion<2>& m : state.bodies.motions)
      begin.placed.push_back({m.displacement, m.rotation});
    // the base moves and rotates at random; the block moves with it and, along or off its face, by `slip` more
    const double turn = between(engine, -1, 1), slip = between(engine, 0, 1);
    const Vector<2> way{between(engine, -20, 20), between(engine, -20, 20)};
    const double off = between(engine, 0, 3.1);
    const Vector<2> more = slip * Vector<2>(std::cos(off), std::sin(off));
    const Vector<2> arm = model.bodies[block].reference - model.bodies[base].reference;
    const Matrix<2> axes = matrix(Rotation<2>{turn});
    state.bodies.motions[base].displacement = way;
    state.bodies.motions[base].rotation.angle = turn;
    state.bodies.motions[block].displacement = way + axes * (arm + more) - arm;
    state.bodies.motions[block].rotation.angle = turn;
    const std::vector<MovedBody> moved = moved_bodies(model, begin, state);
    ASSERT_EQ(moved.size(), slip > 0.05 ? 1u : 0u) << slip;
    for (const MovedBody& one : moved)
      EXPECT_NEAR(one.distance, slip, 1e-12);
  }
}

// A body that falls past others when true motion ends has not lost a support.
TEST(Settled, AFallThatIsStoppedIsNoFailure) {
  const std::string fall = "[[stage]]\nname = \"fall\"\nkind = \"run\"\nduration_s = 0.05\n";
  const std::string shelf =
      head() + box("floor", -5, -1, 30, 1, true) + box("edge", -2, 2, 2, 1, true) + box("block", -0.1, 3, 1, 1);
  const Results at_once = results_of(shelf + settle), after = results_of(shelf + fall + settle);
  EXPECT_EQ(at_once.outcome, Outcome::incomplete) << "it tips over the edge that supported it";
  EXPECT_EQ(after.outcome, Outcome::done) << after.message;
  ASSERT_EQ(after.moved.size(), 1u);
  EXPECT_FALSE(after.moved.front().left_all);
}

std::string sentence_of_stage(const Results& results, const std::string& name) {
  for (const StageResult& stage : results.stages)
    if (stage.name == name) return sentence_of(stage.mechanism);
  ADD_FAILURE() << name;
  return {};
}

// A stage that ends away from its begin, by a tenth of an inscribed radius, says what moved and how.
TEST(MotionOfAStage, ASettleStageThatEndsAwayFromItsBegin) {
  for (const double gap : {0.04, 0.06, 0.9}) {
    const Results results = results_of(slider(gap, false) + settle + search);
    const std::string sentence = sentence_of_stage(results, "settle");
    EXPECT_EQ(sentence, gap > 0.05 ? "block 0 (1 m³/m, 22.4 kN/m, all of the free mass) slides on faces that no joint "
                                     "made, 0.0 deg down to the right"
                                   : "")
        << gap;
    EXPECT_EQ(results.message.ends_with("; " + sentence), gap > 0.05) << results.message;
  }
}

TEST(MotionOfAStage, ATimedStageThatLosesEquilibrium) {
  const auto timed = [](double seconds, const std::string& more = "") {
    return fmt::format("[[stage]]\nname = \"go\"\nkind = \"run\"\nduration_s = {}\n{}", seconds, more);
  };
  const auto sentence = [&](const std::string& text) {
    const Results results = results_of(text);
    EXPECT_EQ(results.outcome, Outcome::done) << results.message;
    EXPECT_EQ(results.message, "");
    return sentence_of_stage(results, "go");
  };
  const std::string floor = box("floor", -5, -1, 30, 1, true);
  // on friction of 20 deg under a load inclined by 27 deg
  EXPECT_TRUE(sentence(slider(5, false) + timed(0.5))
                  .starts_with("block 0 (1 m³/m, 22.4 kN/m, all of the free mass) "
                               "slides on faces that no joint made, 0"));
  EXPECT_EQ(sentence(slider(5, false) + timed(0.05)), "") << "it has come 2 mm";
  EXPECT_EQ(sentence(head() + floor + box("block", 0, 2, 1, 1) + timed(0.2)),
            "block 0 (1 m³/m, 20 kN/m, all of the free mass) falls, straight down");
  EXPECT_EQ(sentence(head() + floor + box("block", 0, 0, 1, 1) + timed(0.2)), "") << "in equilibrium";
  // one that rides on a driven base has not lost it
  EXPECT_EQ(sentence(head() + floor + box("block", 0, 0, 1, 1) +
                     timed(2, "move = [{ bodies = [\"floor\"], velocity = [0.1, 0] }]\n")),
            "");
}

// a block of 160 kN/m is pulled off its joint by 400 kN/m, or held by its tensile strength
TEST(MotionOfAStage, CountsTheBondsThatItBreaks) {
  const auto pulled = [](double strength) {
    const Results results = results_of(fmt::format(
        "dimension = 2\ndensity = 2000\nstatics = \"local\"\ngravity = [0, -10]\ndomain = {{ box = {{ min = [-2, -2], "
        "max = [2, 2] }} }}\njoints = [{{ name = \"bed\", dip = 0, dip_direction = 90, point = [0, 0] }}]\n"
        "joint_properties = [{{ name = \"rock\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 40, "
        "tension = {0}, cohesion = {0} }}]\nfix = [{{ below = [\"bed\"] }}]\n{1}"
        "[[stage]]\nname = \"go\"\nkind = \"run\"\nduration_s = 0.3\n"
        "force = [{{ name = \"pull\", inside = [0, 1], force = [0, 4e5] }}]\n",
        strength, settle));
    EXPECT_EQ(results.outcome, Outcome::done) << results.message;
    return sentence_of_stage(results, "go");
  };
  EXPECT_EQ(pulled(1e4),
            "block 1 (8 m³/m, 160 kN/m, all of the free mass) lifts, straight up; bed opens; "
            "4 bonds are broken");
  EXPECT_EQ(pulled(1e6), "");
}

TEST(Settled, AnInterruptedRunNamesTheSameBodies) {
  const Prepared<2> scene = prepare<2>(parse_scene(slider(0.9, false) + settle, "scene.toml"));
  Progress<2> whole = initial_progress(scene);
  ASSERT_TRUE(simulate<2>(scene, whole, {}));
  Progress<2> parts = initial_progress(scene);
  Watcher<2> watcher;
  watcher.pause = [last = -1LL](const Progress<2>& now) mutable {
    const bool stop = now.state.counters.steps >= last + 100;
    if (stop) last = now.state.counters.steps;
    return stop;
  };
  while (!simulate<2>(scene, parts, watcher)) {
    const std::string bytes = checkpoint_bytes(parts, "hash");
    parts = read_checkpoint<2>(bytes, "hash");
  }
  ASSERT_EQ(parts.results.moved.size(), 1u);
  EXPECT_EQ(parts.results.moved.front().distance, whole.results.moved.front().distance);
  EXPECT_TRUE(whole.results.stages.front().mechanism.known());
  EXPECT_EQ(sentence_of(parts.results.stages.front().mechanism), sentence_of(whole.results.stages.front().mechanism));
  EXPECT_EQ(parts.results.state_hash, whole.results.state_hash);
}

}  // namespace
}  // namespace voussoir::settled_test
