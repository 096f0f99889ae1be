// A simulation that starts from the end of another equals the complete simulation, bit for bit.
#include "core/run/begin.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "core/run/simulate.hpp"
#include "core/scene/scene.hpp"
#include "core/testing/end_bytes.hpp"

namespace voussoir::begin_test {
namespace {

// A block on a fixed floor; half of it is excavated, then the rest slips.
const std::string in_space = R"(
dimension = 3
gravity = [2, 0, -10]
density = 2000
domain = { box = { min = [0, 0, 0], max = [4, 2, 3] } }
joint_properties = [{ name = "default", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40, sub_contacts = 4 }]
joints = [{ name = "floor", dip = 0, point = [0, 0, 1] }, { name = "bed", dip = 0, point = [0, 0, 2.2] }]
fix = [{ below = ["floor"] }]
[[excavations]]
name = "gate"
box = { min = [2.5, -1, 1.0], max = [5, 3, 2.2] }
outline = true
[[bolts]]
name = "pin"
from = [1, 1, 1.5]
to = [1, 1, 2.8]
stiffness = 1e7
[[stage]]
name = "settle"
kind = "settle"
gravity_ramp_s = 0.1
install = ["pin"]
[[stage]]
name = "dig"
kind = "settle"
excavate = ["gate"]
excavation_forces = { remaining = 0.3, duration_s = 0.1 }
[[stage]]
name = "fall"
kind = "run"
duration_s = 0.02
excavation_forces = { remaining = 0, duration_s = 0.02 }
[[monitors]]
name = "upper"
quantities = ["displacement", "rotation"]
inside = [1, 1, 2.5]
since = "settle"
)";

template <int Dim>
Prepared<Dim> scene_of(const std::string& text, int threads = 1) {
  Prepared<Dim> scene = prepare<Dim>(parse_scene(text, "scene.toml", {}));
  scene.settings.threads = threads;
  return scene;
}

// clocks and frames are not compared
template <int Dim>
std::string bits(Progress<Dim> progress) {
  progress.results.seconds = 0;
  progress.frames.clear();
  return bits_of(progress);
}

// until its last stage has ended
template <int Dim>
Progress<Dim> left_off(Prepared<Dim> scene, int stage) {
  scene.last_stage = stage;
  Progress<Dim> progress = initial_progress(scene);
  std::optional<Progress<Dim>> end;
  Watcher<Dim> watcher;
  watcher.ended = [&](const Progress<Dim>& now) { end = now; };
  EXPECT_TRUE(simulate(scene, progress, watcher));
  EXPECT_EQ(progress.results.outcome, Outcome::done) << progress.results.message;
  return end.value();
}

TEST(Begin, InThreeDimensionsEveryBitIsThatOfTheCompleteSimulation) {
  const Prepared<3> scene = scene_of<3>(in_space);
  Progress<3> whole = initial_progress(scene);
  ASSERT_TRUE(simulate<3>(scene, whole, {}));
  ASSERT_EQ(whole.results.outcome, Outcome::done) << whole.results.message;
  for (int stage = 0; stage < 2; ++stage)
    for (int threads = 1; threads <= 2; ++threads) {
      Progress<3> begun = begin_at_end(scene, left_off(scene, stage), {.monitors = {"upper"}, .own = {}});
      ASSERT_TRUE(simulate<3>(scene_of<3>(in_space, threads), begun, {}));
      EXPECT_TRUE(bits(begun) == bits(whole)) << "from stage " << stage + 1 << " on, " << threads << " threads";
    }
}

// unused joint properties may differ, and more may follow
TEST(Begin, UnusedJointPropertiesAreThoseOfTheNewScene) {
  const auto with = [](const std::string& more) {
    std::string text = in_space;
    return text.insert(text.find(" }]\njoints") + 2, more);
  };
  const auto spare = [](const std::string& name, int friction) {
    return ", { name = \"" + name +
           "\", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = " + std::to_string(friction) + " }";
  };
  const std::string theirs = with(spare("liner", 30)), ours = with(spare("liner", 12) + spare("other", 20));
  const Scene scene = parse_scene(ours, "scene.toml", {}), other = parse_scene(theirs, "other.toml", {});
  const SharedStages shared = require_shared(scene, other, "other", 1);
  EXPECT_EQ(shared.own, (std::vector<std::string>{"liner", "other"}));
  EXPECT_EQ(shared.monitors, std::vector<std::string>{"upper"});
  Progress<3> whole = initial_progress(scene_of<3>(ours));
  ASSERT_TRUE(simulate<3>(scene_of<3>(ours), whole, {}));
  Progress<3> begun = begin_at_end(scene_of<3>(ours), left_off(scene_of<3>(theirs), 0), shared);
  ASSERT_TRUE(simulate<3>(scene_of<3>(ours), begun, {}));
  EXPECT_TRUE(bits(begun) == bits(whole));
}

TEST(Begin, OtherBlocksDoNotFit) {
  std::string other = in_space;
  other.replace(other.find("{ name = \"bed\", dip = 0"), 23,
                "{ name = \"cross\", dip = 90, dip_direction = 90, point = [1.7, 0, 0] }, "
                "{ name = \"bed\", dip = 0");
  const Progress<3> end = left_off(scene_of<3>(in_space), 0);
  EXPECT_THROW(begin_at_end(scene_of<3>(other), end, {}), BeginError);
}

}  // namespace
}  // namespace voussoir::begin_test
