// Whether error budgets enclose the truth: random roof wedges against joint relaxation, by the program itself.
#include <gtest/gtest.h>

#include "cases/budget_trial.hpp"
#include "cases/roofwedge/random_wedge.hpp"

namespace voussoir::cases::budget_test {
namespace {

using verification::CaseReport;

constexpr double duration = 0.02;  // s, of scene.toml's stage stress

std::vector<std::string> overrides(const reference::RoofWedge& wedge) {
  const double tall = 2 * wedge.height;
  std::vector<std::string> sets{fmt::format("domain.box={{ min = [{0}, {0}, 0], max = [{1}, {1}, {2}] }}",
                                            -roof_half_width, roof_half_width, tall),
                                "joint_properties.rock.measured=true",
                                fmt::format("joint_properties.rock.normal_stiffness={:.17g}", wedge.normal_stiffness),
                                fmt::format("joint_properties.rock.shear_stiffness={:.17g}", wedge.shear_stiffness),
                                "stage.critical.tolerance_deg=0.01"};
  const std::array<RoofMove, 3> moves = roof_moves(wedge);
  for (int i = 0; i < 3; ++i) {
    const char joint = static_cast<char>('A' + i);
    sets.push_back(fmt::format("joints.{}.dip={:.17g}", joint, wedge.planes[i].dip / degree));
    sets.push_back(fmt::format("joints.{}.dip_direction={:.17g}", joint, wedge.planes[i].dip_direction / degree));
    sets.push_back(fmt::format("stage.stress.move.{}.inside={}", joint, list_of(moves[i].inside)));
    sets.push_back(fmt::format("stage.stress.move.{}.velocity={}", joint, list_of(moves[i].way / duration)));
  }
  return sets;
}

// every other one is symmetric
std::vector<BudgetScene> draw(unsigned seed, std::size_t count) {
  boost::random::mt19937_64 random(seed);
  std::vector<BudgetScene> scenes;
  while (scenes.size() < count) {
    const bool symmetric = scenes.size() % 2 == 0;
    const DrawnRoofWedge drawn = random_roof_wedge(random, symmetric);
    scenes.push_back(
        {fmt::format("roof wedge {}, {}symmetric, K0 {:.2f}, {:.2g} and {:.2g} Pa/m", scenes.size(),
                     symmetric ? "" : "a", drawn.k0, drawn.wedge.normal_stiffness, drawn.wedge.shear_stiffness),
         std::filesystem::path(VOUSSOIR_CASE_DIR) / "scene.toml", overrides(drawn.wedge), drawn.truth});
  }
  return scenes;
}

TEST(RoofWedge, BudgetsEncloseJointRelaxation) {
  CaseReport report("roofwedge");
  judge_budgets(report, "roofwedge", "random roof wedges", "Goodman, Shi & Boyle (1982)", draw(30511, 6));
}

TEST(RoofWedgeLong, BudgetsEncloseJointRelaxation) {
  CaseReport report("roofwedge");
  judge_budgets(report, "roofwedge", "random roof wedges", "Goodman, Shi & Boyle (1982)", draw(30512, 60));
}

}  // namespace
}  // namespace voussoir::cases::budget_test
