// What block theory says of a block alone beside the value of a search that moves it with others.
#include "core/run/block_theory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::block_theory_test {
namespace {

Prepared<3> tutorial(const std::vector<std::string>& sets) {
  return prepare<3>(read_scene(std::string(VOUSSOIR_SOURCE_DIR) + "/examples/tutorial/slope.toml", sets));
}

// What joints four times as stiff, or increments of a fifth of the slip, change here, by `voussoir run --budget`: it is
// part of a run's bar, but not of a single search's.
constexpr double of_other_settings = 0.0077;

Results judged(const Prepared<3>& scene) {
  Results results = simulated(scene).results;
  for (auto& [name, value] : results.values)
    if (value.error_bar) *value.error_bar = std::hypot(*value.error_bar, of_other_settings);
  add_block_theory(scene, results);
  return results;
}

const std::vector<std::string> flatter{"joints.A1.dip=43.519", "joints.B1.dip=52.682"};

// Two blocks that slide as one at 1.1436. The upper one by itself has 1.1220, which the search does not find, since the
// lower one gives way before the shear on the face between them acts along that motion; held, it finds it.
TEST(BlockTheory, ABlockAloneMayHaveLessThanTheBlocksThatMove) {
  const Results pair = judged(tutorial(flatter));
  const BlockTheory& theory = pair.at_last_stable_state.back().block_theory.value();
  const Value& found = *pair.find("factor_of_safety");
  EXPECT_NEAR(theory.critical.value(), 1.1436, 5e-5);
  EXPECT_NEAR(found.value, *theory.critical, *found.error_bar);
  EXPECT_EQ(theory.lower_block, 5);
  EXPECT_NEAR(theory.lower, 1.121961, 1e-6);
  EXPECT_TRUE(
      text_of(theory, "1").ends_with("; less, 1.122, for block 5 alone, if the blocks around it do not give way"))
      << text_of(theory, "1");

  std::vector<std::string> held = flatter;
  held.push_back("fix=[{ below = [\"A1\"] }, { below = [\"B1\"] }, { below = [\"A2\"], above = [\"A1\", \"B1\"] }]");
  const Results alone = judged(tutorial(held));
  const Value& lower = *alone.find("factor_of_safety");
  EXPECT_NEAR(lower.value, theory.lower, *lower.error_bar);
  EXPECT_EQ(alone.at_last_stable_state.back().block_theory->lower_block, -1) << "it is the one that moves";
}

// the tutorial's pair has less than both of its blocks
TEST(BlockTheory, NoBlockIsNamedThatHasMore) {
  EXPECT_EQ(judged(tutorial({})).at_last_stable_state.back().block_theory->lower_block, -1);
}

}  // namespace
}  // namespace voussoir::block_theory_test
