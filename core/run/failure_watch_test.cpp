// Trials judged by the strength that their motion requires: closed forms of a sliding block, by each static solution
// method and whatever lies beside it.
#include "core/run/failure_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/run/simulate.hpp"
#include "core/scene/scene.hpp"
#include "core/testing/limit_models.hpp"
#include "text/angle.hpp"

namespace voussoir::failure_watch_test {
namespace {

using limit_models::box;
using limit_models::TestBlock;
using limit_models::turned;

constexpr double dip = 35 * degree, strength = 60 * degree;

// A block of 1.2 m by 0.8 m on a slope, and blocks on level ground far from it.
std::string slope_scene(const std::string& search, const std::string& statics, const std::vector<TestBlock>& beside) {
  std::vector<TestBlock> blocks{{"base", turned(box(-4, -1, 4, 0), -dip), true},
                                {"block", turned(box(-0.6, 0, 0.6, 0.8), -dip)}};
  if (!beside.empty()) blocks.push_back({"ground", box(9, -1, 21, 0), true});
  blocks.insert(blocks.end(), beside.begin(), beside.end());
  return limit_models::text_of(blocks, to_degrees(strength)) + "gravity_ramp_s = 0.1\nstatics = \"" + statics +
         "\"\n[[restrain]]\nbodies = [\"block\"]\nrotation = true\n"
         "[[stage]]\nname = \"critical\"\nkind = \"reduce\"\nfailure_criterion = \"required_strength\"\nstatics = \"" +
         statics + "\"\n" + search + "[output]\nframes = false\n";
}

constexpr const char* by_friction = "from_deg = 60\nto_deg = 5\ntolerance_deg = 0.05\n";
constexpr const char* by_factor = "search = \"factor\"\nfrom_factor = 1\nto_factor = 6\ntolerance_factor = 0.01\n";

Results results_of(const std::string& search, const std::string& statics, const std::vector<TestBlock>& beside = {}) {
  const Prepared<2> scene = prepare<2>(parse_scene(slope_scene(search, statics, beside), "slope.toml"));
  Progress<2> progress = initial_progress(scene);
  EXPECT_TRUE(simulate(scene, progress, {}));
  EXPECT_EQ(progress.results.outcome, Outcome::done) << progress.results.message;
  return progress.results;
}

// The line is exact here: the block's loads do not change as it slides. Left are rounding and what relaxation calls
// equilibrium, a millionth of the contact force.
TEST(FailureWatch, EachMethodFindsTheAngleOfASlope) {
  for (const std::string statics : {"adaptive", "local", "newton"}) {
    const Results results = results_of(by_friction, statics);
    const Value* found = results.find("critical_friction");
    ASSERT_TRUE(found) << statics;
    EXPECT_EQ(found->covers, "criterion") << statics;
    EXPECT_NEAR(found->value, 35, 1e-3) << statics;
    EXPECT_NEAR(found->value, 35, *found->error_bar + 1e-4) << statics;
    ASSERT_TRUE(found->bracket);
    EXPECT_GT(*found->bracket, *found->error_bar) << "the bracket does not limit the result";
  }
}

TEST(FailureWatch, AFactorOfSafetyIsThatOfTheSlope) {
  for (const std::string statics : {"adaptive", "newton"}) {
    const Results results = results_of(by_factor, statics);
    const Value* found = results.find("factor_of_safety");
    ASSERT_TRUE(found) << statics;
    EXPECT_EQ(found->covers, "criterion") << statics;
    EXPECT_NEAR(found->value, std::tan(strength) / std::tan(dip), 2e-4) << statics;
  }
}

// Neither a stone a hundred times smaller nor a column that settles ten times as far.
TEST(FailureWatch, BlocksBesideDoNotChangeTheResult) {
  const double alone = results_of(by_friction, "newton").find("critical_friction")->value;
  std::vector<TestBlock> column;
  for (int i = 0; i < 8; ++i)
    column.push_back({"of the column " + std::to_string(i), box(18, 2.0 * i, 20, 2.0 * (i + 1))});
  for (const std::vector<TestBlock>& beside : {std::vector<TestBlock>{{"stone", box(10, 0, 10.01, 0.01)}}, column}) {
    const Results results = results_of(by_friction, "newton", beside);
    const Value* found = results.find("critical_friction");
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->value, alone, 1e-3);
    EXPECT_EQ(found->covers, "criterion");
  }
}

TEST(FailureWatch, NamesTheKindsThatItDoesNotJudge) {
  const Prepared<2> scene = prepare<2>(parse_scene(slope_scene(by_friction, "newton", {}), "slope.toml"));
  ReducePlan plan;
  EXPECT_EQ(not_watched(scene.model, plan, scene.state.supports), "");
  plan.method = ReductionMethod::steps;
  EXPECT_NE(not_watched(scene.model, plan, scene.state.supports), "");
  plan = {.failure_fraction = 0.1};
  EXPECT_NE(not_watched(scene.model, plan, scene.state.supports), "");
  Model<2> softening = scene.model;
  softening.properties.front().laws.friction = FrictionLaw::softening;
  EXPECT_NE(not_watched(softening, ReducePlan{}, scene.state.supports), "");
}

}  // namespace
}  // namespace voussoir::failure_watch_test
