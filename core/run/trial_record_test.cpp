// The rows of a search's trials, on a block that slides on a plane.
#include "core/run/trial_record.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/output/search_csv.hpp"
#include "core/run/stable_state.hpp"
#include "core/testing/whole_runs.hpp"
#include "text/angle.hpp"

namespace voussoir::trial_record_test {
namespace {

constexpr double plane_dip = 35;  // deg

// A block of 2 m2 on a plane; `more`: tables after the search's; `of_settling`: keys.
std::string sliding_scene(const std::string& search, const std::string& more = "",
                          const std::string& of_settling = "") {
  return "dimension = 2\ngravity = [0, -9.81]\ndensity = 2600\ndomain = { box = { min = [-1, -1], max = [1, 1] } }\n"
         "joints = [{ name = \"plane\", dip = 35, dip_direction = 90, point = [0, 0] }]\n"
         "joint_properties = [{ name = \"rock\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 60 }]\n"
         "fix = [{ below = [\"plane\"] }]\nrestrain = [{ above = [\"plane\"], rotation = true }]\nstatics = "
         "\"newton\"\n"
         "[[stage]]\nname = \"settle\"\nkind = \"settle\"\ngravity_ramp_s = 0.1\n" +
         of_settling + "[[stage]]\nname = \"critical\"\nkind = \"reduce\"\n" + search + "[output]\nframes = false\n" +
         more;
}

constexpr const char* watched =
    "failure_criterion = \"required_strength\"\nfrom_deg = 60\nto_deg = 5\ntolerance_deg = 0.05\n";
constexpr const char* by_displacement =
    "failure_criterion = \"displacement\"\nfailure_displacement = 0.01\nfrom_deg = 60\nto_deg = 5\ntolerance_deg = "
    "0.5\n";

TEST(TrialRecord, EachTrialHasARow) {
  for (const char* search : {watched, by_displacement}) {
    const Results results = whole_run(scene_of<2>(sliding_scene(search))).results;
    const Value* found = results.find("critical_friction");
    ASSERT_TRUE(found);
    ASSERT_GE(results.trials.size(), 4u);
    int number = 0;
    for (const TrialRow& row : results.trials) {
      EXPECT_EQ(row.stage, 2);
      EXPECT_EQ(row.trial, ++number);
      EXPECT_EQ(row.unit, "deg");
      EXPECT_EQ(row.outcome, row.level > plane_dip ? "stable" : "failed") << row.level;
      if (row.outcome != "failed") continue;
      EXPECT_EQ(row.body, 1) << "the block above the plane";
      EXPECT_GT(row.displacement, 0);
      if (search == by_displacement) {
        EXPECT_GT(row.displacement, 0.01);
        EXPECT_FALSE(row.elastic_displacements || row.required) << "not watched";
      } else {
        ASSERT_TRUE(row.elastic_displacements && row.required);
        EXPECT_GE(*row.elastic_displacements, 10) << "of which elasticity is spent";
        EXPECT_NEAR(*row.required, plane_dip, 0.01) << "the loads of a sliding block do not change";
      }
    }
    EXPECT_NEAR(results.trials.front().level, 60, 1e-12) << "the start";
  }
}

TEST(TrialRecord, TheTableHasALineForEachTrial) {
  EXPECT_EQ(search_csv({}), "");
  TrialRow stable{.level = 40, .unit = "deg", .outcome = "stable"};
  TrialRow failed{.stage = 2, .trial = 3, .level = 1.25, .unit = "1", .outcome = "failed", .body = 7};
  failed.displacement = 0.5;
  failed.elastic_displacements = 20;
  failed.required = 1.125;
  const std::string table = search_csv({stable, failed});
  EXPECT_EQ(std::ranges::count(table, '\n'), 3);
  EXPECT_NE(table.find("\n1,1,40,deg,stable,,0,,"), std::string::npos) << table;
  EXPECT_NE(table.find("\n2,3,1.25,1,failed,7,0.5,20,1.125,,,,,\n"), std::string::npos) << table;
}

// ---- bolts ----------------------------------------------------------------------------------------------------------

// along the bolt, 30 degrees from the plane, from the block to the base; down the plane
constexpr double along_x = -0.9962, along_y = 0.0872;
constexpr double down_x = 0.8192, down_y = -0.5736;
constexpr double weight_along = 2600 * 2 * 9.81 * 0.573576;  // N/m, of the block

std::string bolted_scene(const std::string& search, double yield) {
  return sliding_scene(search,
                       fmt::format("[[bolts]]\nname = \"bolt\"\nfrom = [0.6973, -0.0610]\nto = [-0.6973, "
                                   "0.0610]\nstiffness = 1e9\nyield = {}\n",
                                   yield),
                       "install = [\"bolt\"]\n");
}

constexpr const char* by_factor =
    "failure_criterion = \"displacement\"\nfailure_displacement = 0.01\nsearch = \"factor\"\nfrom_factor = 1\n"
    "to_factor = 20\ntolerance_factor = 0.02\n";

TEST(TrialRecord, ABoltTurnsAsItsBlockSlides) {
  const Results results = whole_run(scene_of<2>(bolted_scene(by_displacement, 15e3))).results;
  ASSERT_EQ(results.at_last_stable_state.size(), 1u);
  const StableState& at = results.at_last_stable_state.front();
  ASSERT_TRUE(at.trial && at.failed && at.failed->bolts_turned && at.failed->bolts_use);
  constexpr double apart = 2 * 1.2 * 0.028;  // m, of its anchors: the default
  const double u = at.failed->displacement, x = apart * along_x - u * down_x, y = apart * along_y - u * down_y;
  const double turned = std::acos((x * along_x + y * along_y) / std::hypot(x, y));
  EXPECT_NEAR(*at.failed->bolts_turned, to_degrees(turned), 0.01 * to_degrees(turned));
  EXPECT_NEAR(*at.failed->bolts_use, 1, 1e-9) << "it yields";
  EXPECT_LT(*at.trial->bolts_turned, 0.1 * *at.failed->bolts_turned);
  EXPECT_FALSE(at.failed->water_lost) << "no water";
  EXPECT_NEAR(at.trial->level, *at.level, 0);
}

// The factor that the block has with its bolt, and one that it has at any factor: the plane has no friction then, and
// the bolt's force along it equals the weight's.
TEST(TrialRecord, BlocksThatHangOnBoltsAreSaidToHang) {
  const Results slides = whole_run(scene_of<2>(bolted_scene(by_factor, 15e3))).results;
  ASSERT_TRUE(slides.find("factor_of_safety"));
  const StableState& at = slides.at_last_stable_state.front();
  const std::vector<std::string> lines = search_text(at);
  const auto says = [&](const std::string& words) {
    return std::ranges::any_of(lines, [&](const std::string& line) { return line.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(says("on joint strength; bolts not divided: their largest force is 100 % of their capacity"));
  EXPECT_TRUE(says("bolts had turned by up to "));

  const double yield = 60e3, reserve = yield * std::cos(30 * degree) / weight_along;
  const Prepared<2> scene = scene_of<2>(bolted_scene(by_factor, yield));
  const Progress<2> hangs = simulated(scene);
  EXPECT_EQ(hangs.results.outcome, Outcome::incomplete);
  const std::string& message = hangs.results.message;
  EXPECT_NE(message.find("hang on their bolts at any factor"), std::string::npos) << message;
  EXPECT_EQ(message.find("end higher"), std::string::npos) << message;
  EXPECT_NEAR(std::stod(message.substr(message.rfind(' '))), reserve, 0.01 * reserve) << message;
  EXPECT_EQ(hangs.results.trials.size(), 2u) << "the question is no trial of the search";
  EXPECT_EQ(hangs.results.at_last_stable_state.front().level, 20);

  // interrupted in the question
  const Progress<2> resumed = continued(scene, hangs.state.counters.steps - 1);
  EXPECT_EQ(resumed.results.message, message);
  EXPECT_EQ(resumed.results.state_hash, hangs.results.state_hash);
  EXPECT_EQ(resumed.results.stages.back().ended, hangs.results.stages.back().ended);
}

// no bolt: the end is too low
TEST(TrialRecord, WithoutBoltsASearchThatStaysStableAsksForAHigherEnd) {
  const Results results =
      simulated(
          scene_of<2>(sliding_scene("search = \"factor\"\nfrom_factor = 1\nto_factor = 2\ntolerance_factor = 0.01\n")))
          .results;
  EXPECT_NE(results.message.find("still stable at to_factor = 2: end higher"), std::string::npos) << results.message;
}

// ---- water ----------------------------------------------------------------------------------------------------------

// Water under a block whose table stays in space while the block slides: it loses water in proportion to its way.
TEST(TrialRecord, AWetBlockLeavesItsWaterBehind) {
  const auto lost_at = [](double displacement) {
    const std::string search = fmt::format(
        "failure_criterion = \"displacement\"\nfailure_displacement = {}\nfrom_deg = 60\nto_deg = 20\n"
        "tolerance_deg = 1\n",
        displacement);
    const Results results =
        whole_run(scene_of<2>(sliding_scene(search,
                                            "[[water]]\nname = \"w\"\ntable = [[-1, 0.7], [1, -0.6]]\n"
                                            "faces = [\"plane\"]\n")))
            .results;
    const StableState& at = results.at_last_stable_state.back();
    EXPECT_TRUE(at.trial && at.trial->water_lost && at.failed && at.failed->water_lost);
    EXPECT_NEAR(*at.trial->water_lost, 0, 0.01) << "it has not moved";
    EXPECT_GE(at.failed->displacement, displacement);
    return *at.failed->water_lost / at.failed->displacement;
  };
  const double per_metre = lost_at(0.02);
  EXPECT_GT(std::abs(per_metre), 0.01);
  EXPECT_NEAR(lost_at(0.01), per_metre, 0.1 * std::abs(per_metre));
}

// An interrupted search has the rows of one that was not.
TEST(TrialRecord, AnInterruptedSearchKeepsItsRows) {
  const Prepared<2> scene = scene_of<2>(sliding_scene(watched));
  const Progress<2> whole = whole_run(scene);
  const std::string table = search_csv(whole.results.trials);
  for (const double share : {0.4, 0.8})
    EXPECT_EQ(search_csv(continued(scene, std::lround(share * whole.state.counters.steps)).results.trials), table);
}

}  // namespace
}  // namespace voussoir::trial_record_test
