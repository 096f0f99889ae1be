// Water in scenes: its changes by stages, and results that do not depend on threads, interruptions or the static
// solution method.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/model/state_hash.hpp"
#include "core/model/water_surfaces.hpp"
#include "core/run/checkpoint.hpp"
#include "core/run/simulate.hpp"
#include "core/scene/scene.hpp"
#include "core/testing/end_bytes.hpp"
#include "core/testing/whole_runs.hpp"
#include "text/angle.hpp"

namespace voussoir::water_scene_test {
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
  return scene_of(stack + stages, overrides);
}

TEST(WaterOfAScene, ChangesByItsStages) {
  const Prepared<2> scene = prepared(settle + flow + rise);
  // the level has the points of the later table
  EXPECT_EQ(scene.model.waters[0].values.size(), 6u);
  const Progress<2> progress = simulated(scene);
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
    const std::string once = bits_of(simulated(prepared(stages)).state);
    EXPECT_EQ(bits_of(simulated(prepared(stages, {})).state), once);
    Prepared<2> threads = prepared(stages);
    threads.settings.threads = 3;
    EXPECT_EQ(bits_of(simulated(threads).state), once);

    const Prepared<2> scene = prepared(stages);
    Progress<2> progress = initial_progress(scene);
    int pauses = 0;
    while (!simulate<2>(
        scene, progress,
        {.progress = {}, .frame = {}, .trial_frame = {}, .pause = [&, steps = 0](const Progress<2>&) mutable {
           return ++steps > 5;
         }})) {
      progress = read_checkpoint<2>(checkpoint_bytes(progress, "hash"), "hash");
      ++pauses;
    }
    EXPECT_GT(pauses, 3);
    EXPECT_EQ(bits_of(progress.state), once);
  }
}

TEST(WaterOfAScene, IsPartOfTheHash) {
  const Prepared<2> scene = prepared(settle);
  State<2> state = scene.state;
  const std::string before = state_hash(scene.model, state);
  state.schedule.water[0][1] += 1e-9;
  EXPECT_NE(state_hash(scene.model, state), before);
}

// Newton's method finds the same equilibrium as relaxation, on its own, in increments of the level
TEST(WaterOfAScene, IsSolvedByNewtonsMethod) {
  const std::string up = settle + "[[stage]]\nname = \"up\"\nkind = \"settle\"\n" + rise;
  const Progress<2> relaxed = simulated(prepared(up));
  const Progress<2> newton = simulated(prepared(up, {"statics=newton", "static_increments=3"}));
  ASSERT_EQ(newton.results.outcome, Outcome::done) << newton.results.message;
  EXPECT_GT(newton.state.counters.static_iterations, 0);
  EXPECT_EQ(newton.state.counters.static_fallbacks, 0);
  EXPECT_EQ(newton.state.schedule.water, relaxed.state.schedule.water);
  double largest = 0;
  for (const Motion<2>& m : relaxed.state.bodies.motions)
    largest = std::max(largest, m.displacement.norm());
  for (std::size_t b = 0; b < relaxed.state.bodies.motions.size(); ++b)
    EXPECT_LT((newton.state.bodies.motions[b].displacement - relaxed.state.bodies.motions[b].displacement).norm(),
              1e-3 * largest);
}

// a block of 20 kN, 1 m wide and high, on a floor, with a crack at x = 1 between it and a fixed one
const std::string cracked = R"(dimension = 2
gravity = [0, -10]
density = 2000
domain = { box = { min = [0, -1], max = [3, 1] } }
joints = [{ name = "floor", dip = 0, point = [0, 0] },
          { name = "crack", dip = 90, dip_direction = 90, point = [1, 0.5], ends_at = ["floor"] }]
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 30 }]
fix = [{ below = ["floor"] }, { inside = [2, 0.5] }]
restrain = [{ inside = [0.5, 0.5], rotation = true }]
monitors = [{ name = "m", inside = [0.5, 0.5], quantities = ["water_load"] }]
)";

using Table = std::vector<Vector<2>>;

std::string water_text(const Table& table, const std::string& faces, double beside = 0) {
  std::string text = "water = [{ name = \"w\", unit_weight = 10000, faces = [" + faces + "], table = [";
  for (const Vector<2>& point : table)
    text += fmt::format("[{:.17g}, {:.17g}], ", point[0] + beside, point[1]);
  return text + "] }]\n";
}

// whose first, last or middle point is at the crack or at a side of the domain, 1 m above the floor at the crack
const std::vector<Table> bent_tables{{{0, 0}, {1, 1}},   {{1, 1}, {2, 0}},
                                     {{1, 1}, {3, 0.5}}, {{0, 0.4}, {1, 1}, {2, 0}},
                                     {{0, 1}, {3, 1}},   {{-1, 0}, {1, 1}, {3, 0.2}},
                                     {{-5, 3}, {1, 1}},  {{0.5, 1}, {1, 1}, {1.5, -2}}};

TEST(WaterOfAScene, AtAKinkIsContinuous) {
  for (const Table& table : bent_tables)
    for (const std::string faces :
         {"\"crack\"", "\"outer\"", "\"all\"", "\"floor\", \"crack\"", "\"outer\", \"crack\""}) {
      const auto loads = [&](double beside) {
        return water_loads_at_reference<2>(
            prepare<2>(parse_scene(cracked + water_text(table, faces, beside) + settle, "scene.toml")).model);
      };
      const std::vector<Load<2>> at = loads(0);
      for (const double beside : {-1e-9, 1e-9}) {
        const std::vector<Load<2>> there = loads(beside);
        for (std::size_t b = 0; b < at.size(); ++b) {
          // a slope of 4 at most, faces of 3 m at most, 10 kN/m³
          EXPECT_LT((at[b].force - there[b].force).norm(), 1e-9 * 4 * 3 * 1e4 * 4) << faces << ", body " << b;
          EXPECT_NEAR(at[b].moment[0], there[b].moment[0], 1e-9 * 4 * 9 * 1e4 * 4) << faces << ", body " << b;
        }
      }
      Vector<2> both = Vector<2>::Zero();
      for (const Load<2>& load : at)
        both += load.force;
      if (faces == "\"crack\"") {
        EXPECT_LT(both.norm(), 1e-9) << "its two faces are pushed apart";
      }
    }
}

// the thrust of 1 m of water, 5 kN, in a run and in a search: the block slides below atan 5/20
TEST(WaterOfAScene, AtAKinkPushesInRunAndSearch) {
  const std::string instant = "[[stage]]\nname = \"instant\"\nkind = \"run\"\nduration_s = 1e-4\n";
  const std::string reduce = settle +
                             "[[stage]]\nname = \"reduce\"\nkind = \"reduce\"\nfrom_deg = 30\nto_deg = "
                             "5\ntolerance_deg = 0.1\nfailure_displacement = 1e-3\n";
  for (const Table& table : {bent_tables[0], bent_tables[1], bent_tables[3]}) {
    const std::string scene = cracked + water_text(table, "\"crack\"");
    const Progress<2> run = simulated(prepare<2>(parse_scene(scene + instant, "scene.toml")));
    EXPECT_NEAR(run.results.find("m_water_load_x")->value, -5000, 1e-3);
    const Progress<2> search = simulated(prepare<2>(parse_scene(scene + reduce, "scene.toml")));
    ASSERT_EQ(search.results.outcome, Outcome::done) << search.results.message;
    // the bracket, and 1 mm of slip out of the water, which reduces its thrust by 0.2 %
    EXPECT_NEAR(search.results.find("critical_friction")->value, std::atan(0.25) / degree, 0.1 + 0.03);
  }
}

}  // namespace
}  // namespace voussoir::water_scene_test
