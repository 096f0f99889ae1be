// Whether error budgets enclose the truth: random wedges against the closed form, by the program itself.
#include <gtest/gtest.h>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include "cases/budget_trial.hpp"
#include "cases/wedge/wedge_scene.hpp"

namespace voussoir::cases::budget_test {
namespace {

using verification::CaseReport;

// wedges that slide on one plane or on both, without borderline ones, on 10 MPa/m to 1 GPa/m
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

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string without_line(std::string text, const std::string& key) {
  const std::size_t begin = text.find("\n" + key) + 1;
  return text.erase(begin, text.find('\n', begin) + 1 - begin);
}

TEST(Wedge, BudgetsEncloseTheClosedForm) {
  CaseReport report("wedge");
  judge_budgets(report, "wedge", "random wedges", "Hoek & Bray (1974)", draw(41907, 4));
}

TEST(WedgeLong, BudgetsEncloseTheClosedForm) {
  CaseReport report("wedge");
  judge_budgets(report, "wedge", "random wedges", "Hoek & Bray (1974)", draw(20134, 200));
}

// A requested error, for wedges without a tolerance of their own; against the finest level, without a budget.
TEST(WedgeLong, AnErrorOfATenthOfAPercentIsReached) {
  CaseReport report("wedge");
  constexpr double asked = 1e-3;
  const std::filesystem::path scene = verification::case_output("wedge") / "without_tolerance.toml";
  std::ofstream(scene) << without_line(read_text(std::filesystem::path(VOUSSOIR_CASE_DIR) / "scene.toml"),
                                       "tolerance_deg");
  int reached = 0, told = 0;
  std::vector<double> costs;
  const std::vector<BudgetScene> scenes = draw(20136, 40);
  for (BudgetScene wedge : scenes) {
    wedge.scene = scene;
    const nlohmann::json refined = results_of(wedge, "accuracy.error=\"0.1 %\"", "wedge");
    const nlohmann::json finest = results_of(wedge, "accuracy.level=\"reference\"", "wedge");
    const nlohmann::json& angle = refined.at("values").at("critical_friction");
    const double value = angle.at("value"), bar = angle.at("error_bar");
    reached += std::abs(value - wedge.truth) <= asked * wedge.truth;
    told += bar <= asked * value;
    double evaluations = 0;
    for (const nlohmann::json& round : refined.at("accuracy"))
      evaluations += round.at("contact_evaluations").get<double>();
    costs.push_back(evaluations / finest.at("counters").at("contact_evaluations").get<double>());
    fmt::print("{}: {:.4f} deg, off by {:+.5f}, bar {:.5f}, {} rounds, {:.2g} times the finest level\n", wedge.label,
               value, value - wedge.truth, bar, refined.at("accuracy").size(), costs.back());
  }
  const auto judge = [&](const char* what, int count) {
    report.record({what,
                   "1",
                   verification::Kind::limit,
                   "Hoek & Bray (1974)",
                   0,
                   {0.95, 0, verification::Bound::at_least},
                   "requirement on error = \"0.1 %\""},
                  static_cast<double>(count) / static_cast<double>(scenes.size()));
  };
  judge("share of 40 random wedges found to 0.1 % as asked", reached);
  judge("share of 40 random wedges whose bar is 0.1 % as asked", told);
  report.report("cost of 0.1 % as asked over the finest level's, median of 40 random wedges", "1", median(costs),
                "required: 0.5");
}

}  // namespace
}  // namespace voussoir::cases::budget_test
