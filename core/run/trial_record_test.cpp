// The rows of a search's trials, on a block that slides on a plane.
#include "core/run/trial_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/output/search_csv.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir {
namespace {

constexpr double plane_dip = 35;  // deg

// A block of 2 m2 on a plane; `more`: of the search, and tables after it.
std::string sliding_scene(const std::string& search, const std::string& more = "") {
  return "dimension = 2\ngravity = [0, -9.81]\ndensity = 2600\ndomain = { box = { min = [-1, -1], max = [1, 1] } }\n"
         "joints = [{ name = \"plane\", dip = 35, dip_direction = 90, point = [0, 0] }]\n"
         "joint_properties = [{ name = \"rock\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 60 }]\n"
         "fix = [{ below = [\"plane\"] }]\nrestrain = [{ above = [\"plane\"], rotation = true }]\nstatics = "
         "\"newton\"\n"
         "[[stage]]\nname = \"settle\"\nkind = \"settle\"\ngravity_ramp_s = 0.1\n"
         "[[stage]]\nname = \"critical\"\nkind = \"reduce\"\n" +
         search + "[output]\nframes = false\n" + more;
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
    EXPECT_EQ(results.trials.front().level, 60) << "the start";
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
  EXPECT_NE(table.find("\n2,3,1.25,1,failed,7,0.5,20,1.125"), std::string::npos) << table;
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
}  // namespace voussoir
