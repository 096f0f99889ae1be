// What of the forces of excavated rock acts after each stage.
#include "core/scene/stage_excavations.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace voussoir::stage_excavations_test {
namespace {

using Engine = std::mt19937_64;

// Stages at random: each may take out one more pit, and may let off to a share of few digits, so that equal ones
// abound. The oracle keeps a share for every pit; a stage is refused when it lets off, takes out none, and asks of
// every pit for more than acts.
TEST(StageExcavations, AShareAboveTheOneInForceIsRefused) {
  Engine engine(4);
  const auto whole = [&](int low, int high) { return std::uniform_int_distribution<>(low, high)(engine); };
  int refused = 0, read = 0;
  for (int k = 0; k < 400; ++k) {
    std::string text =
        "dimension = 2\ndensity = 2000\ngravity = [0, -10]\ndomain = { box = { min = [0, 0], max = [9, 3] } }\n";
    std::string stages;
    std::vector<double> shares;
    std::string wrong;
    double most = 0;
    bool letting = false;
    const int count = whole(1, 5);
    for (int s = 0; s < count; ++s) {
      stages += fmt::format("[[stage]]\nname = \"s{}\"\nkind = \"settle\"\n", s);
      const bool digs = s == 0 || whole(0, 2) == 0, lets_off = whole(0, 3) > 0;
      const double share = 0.25 * whole(0, 4);
      if (digs) {
        text += fmt::format("[[excavations]]\nname = \"pit{0}\"\nbox = {{ min = [{0}, 0], max = [{0}.5, 1] }}\n", s);
        stages += fmt::format("excavate = [\"pit{}\"]\n", s);
        shares.push_back(lets_off ? 1 : 0);
      }
      if (!lets_off) continue;
      stages += fmt::format("excavation_forces = {{ remaining = {}, duration_s = 1 }}\n", share);
      if (wrong.empty() && !digs && share > *std::ranges::max_element(shares)) {
        wrong = fmt::format("stage.s{}.excavation_forces.remaining", s);
        most = *std::ranges::max_element(shares);
        letting = most > 0;
      }
      for (double& one : shares)
        one = std::min(one, share);
    }
    try {
      const Scene scene = parse_scene(text + stages, "scene.toml");
      check_excavations(scene);
      EXPECT_EQ(wrong, "") << stages;
      ActingForces acting;
      for (const StageSpec& stage : scene.stages)
        acting.follow(stage.plan);
      EXPECT_EQ(acting.remaining, *std::ranges::max_element(shares)) << stages;
      ++read;
    } catch (const SceneError& error) {
      EXPECT_EQ(error.key, wrong) << error.what() << '\n' << stages;
      if (letting) {
        EXPECT_NE(std::string(error.what()).find(fmt::format("{:g} remains after stage.s", most)), std::string::npos)
            << error.what();
      }
      ++refused;
    }
  }
  EXPECT_GT(refused, 50);
  EXPECT_GT(read, 50);
}

}  // namespace
}  // namespace voussoir::stage_excavations_test
