// Whether error budgets enclose the truth: random wedges against the closed form, by the program itself.
#include <gtest/gtest.h>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include "cases/budget_trial.hpp"
#include "cases/wedge/wedge_scene.hpp"

namespace voussoir::cases {
namespace {

using verification::CaseReport;

// wedges that slide on one plane or on both, no borderline ones, on 10 MPa/m to 1 GPa/m
std::vector<BudgetScene> draw(unsigned seed, std::size_t count) {
  boost::random::mt19937_64 random(seed);
  boost::random::uniform_real_distribution<double> dip(20, 80), direction(0, 360), power(7, 9);
  std::vector<BudgetScene> scenes;
  while (scenes.size() < count) {
    const reference::Wedge w = wedge(dip(random), direction(random), dip(random), direction(random));
    const double stiffness = std::pow(10, power(random));
    const std::optional<double> critical = reference::critical_friction(w);
    if (!critical || !reference::classify_wedge(w).non_degenerate ||
        reference::solve_wedge(w).line_plunge / degree < 15)
      continue;
    BudgetScene scene{fmt::format("wedge {}, {:.2g} Pa/m", scenes.size(), stiffness),
                      std::filesystem::path(VOUSSOIR_CASE_DIR) / "scene.toml", overrides(w), *critical / degree};
    scene.overrides.push_back(fmt::format("joint_properties.rock.normal_stiffness={:.17g}", stiffness));
    scene.overrides.push_back(fmt::format("joint_properties.rock.shear_stiffness={:.17g}", 0.1 * stiffness));
    scenes.push_back(scene);
  }
  return scenes;
}

TEST(Wedge, BudgetsEncloseTheClosedForm) {
  CaseReport report("wedge");
  judge_budgets(report, "wedge", "random wedges", "Hoek & Bray (1974)", draw(41907, 10));
}

TEST(WedgeLong, BudgetsEncloseTheClosedForm) {
  CaseReport report("wedge");
  judge_budgets(report, "wedge", "random wedges", "Hoek & Bray (1974)", draw(20134, 200));
}

}  // namespace
}  // namespace voussoir::cases
