// Water of scenes: how stages change it, and that no thread, pause or way to rest changes what comes of it.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/checkpoint/checkpoint.hpp"
#include "core/checkpoint/fields.hpp"
#include "core/scene/scene.hpp"
#include "core/simulate.hpp"
#include "core/state_hash.hpp"

namespace voussoir {
namespace {

const std::string stack = R"(dimension = 2
gravity = [0, -9.81]
density = 2500
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_deg = 40
[[blocks]]
name = "ground"
box = { min = [-2, -1], max = [2, 0] }
fixed = true
[[blocks]]
name = "lower"
vertices = [[-1, 0], [1, 0], [0.8, 1], [-1, 1]]
[[blocks]]
name = "upper"
box = { min = [-0.8, 1], max = [0.6, 2] }
[[monitors]]
name = "upper"
quantities = ["water_load"]
bodies = ["upper"]
[[monitors]]
name = "lake"
quantities = ["level"]
water = "lake"
[[water]]
name = "lake"
level = 0.3
)";
const std::string settle = "[[stage]]\nname = \"rest\"\nkind = \"settle\"\n";
const std::string flow = "[[stage]]\nname = \"rise\"\nkind = \"run\"\nduration_s = 0.01\ndamping = { local = 0.5 }\n";
const std::string rise = "water = [{ name = \"lake\", table = [[-1, 1], [0, 1.5], [1, 1.2]], duration_s = 0.01 }]\n";

Prepared<2> prepared(const std::string& stages, const std::vector<std::string>& overrides = {}) {
  return prepare<2>(parse_scene(stack + stages, "scene.toml", overrides));
}

Progress<2> done(const Prepared<2>& scene) {
  Progress<2> progress = initial_progress(scene);
  simulate<2>(scene, progress, {});
  return progress;
}

TEST(WaterOfAScene, ChangesAsItsStagesSay) {
  const Prepared<2> scene = prepared(settle + flow + rise);
  // the level has the points of the table that it becomes
  EXPECT_EQ(scene.model.waters[0].values.size(), 6u);
  const Progress<2> progress = done(scene);
  ASSERT_EQ(progress.results.outcome, Outcome::done) << progress.results.message;
  const auto value = [&](const char* name) { return progress.results.find(name)->value; };
  EXPECT_DOUBLE_EQ(value("lake_level_1"), 1);
  EXPECT_DOUBLE_EQ(value("lake_level_2"), 1.5);
  EXPECT_DOUBLE_EQ(value("lake_level_3"), 1.2);
  const std::vector<std::string>& columns = progress.results.history.columns;
  const auto column = std::ranges::find(columns, "water_lake_level_2_m");
  ASSERT_NE(column, columns.end());
  EXPECT_DOUBLE_EQ(progress.results.history.rows.front()[column - columns.begin()], 0.3);
  EXPECT_DOUBLE_EQ(progress.results.history.rows.back()[column - columns.begin()], 1.5);
  // h(-0.8) = 1.1, h(0) = 1.5, h(0.6) = 1.32, less 1
  EXPECT_NEAR(value("upper_water_load_y"), 9810 * (0.8 * 0.3 + 0.6 * 0.41), 10);
}

TEST(WaterOfAScene, GivesTheSameBitsForThreadsAndAfterAPause) {
  for (const std::string& stages :
       {settle + flow + rise, settle + "[[stage]]\nname = \"up\"\nkind = \"settle\"\n" + rise}) {
    const std::string once = bytes_of(done(prepared(stages)).state);
    EXPECT_EQ(bytes_of(done(prepared(stages, {})).state), once);
    Prepared<2> threads = prepared(stages);
    threads.settings.threads = 3;
    EXPECT_EQ(bytes_of(done(threads).state), once);

    const Prepared<2> scene = prepared(stages);
    Progress<2> progress = initial_progress(scene);
    int pauses = 0;
    while (!simulate<2>(
        scene, progress,
        {.progress = {}, .frame = {}, .trial_frame = {}, .pause = [&, steps = 0](const Progress<2>&) mutable {
           return ++steps > 23;
         }})) {
      progress = read_checkpoint<2>(checkpoint_bytes(progress, "hash"), "hash");
      ++pauses;
    }
    EXPECT_GT(pauses, 3);
    EXPECT_EQ(bytes_of(progress.state), once);
  }
}

TEST(WaterOfAScene, IsKnownToTheHash) {
  const Prepared<2> scene = prepared(settle);
  State<2> state = scene.state;
  const std::string before = state_hash(scene.model, state);
  state.schedule.water[0][1] += 1e-9;
  EXPECT_NE(state_hash(scene.model, state), before);
}

// Newton's method comes to the same rest as relaxation, by itself, in increments of the level
TEST(WaterOfAScene, IsMetByNewtonsMethod) {
  const std::string up = settle + "[[stage]]\nname = \"up\"\nkind = \"settle\"\n" + rise;
  const Progress<2> relaxed = done(prepared(up));
  const Progress<2> newton = done(prepared(up, {"damping.statics=newton", "damping.increments=3"}));
  ASSERT_EQ(newton.results.outcome, Outcome::done) << newton.results.message;
  EXPECT_GT(newton.state.counters.static_iterations, 0);
  EXPECT_EQ(newton.state.counters.static_fallbacks, 0);
  EXPECT_EQ(newton.state.schedule.water, relaxed.state.schedule.water);
  double largest = 0;
  for (const Motion<2>& m : relaxed.state.motions)
    largest = std::max(largest, m.displacement.norm());
  for (std::size_t b = 0; b < relaxed.state.motions.size(); ++b)
    EXPECT_LT((newton.state.motions[b].displacement - relaxed.state.motions[b].displacement).norm(), 1e-3 * largest);
}

}  // namespace
}  // namespace voussoir
