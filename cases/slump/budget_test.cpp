// Whether error budgets enclose the truth: random layered slopes against blocks that slip without opening, by the
// program itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include "app/limit/limit_analysis.hpp"
#include "cases/budget_trial.hpp"
#include "cases/slump/layered_scene.hpp"

namespace voussoir::cases::budget_test {
namespace {

using verification::CaseReport;

constexpr double settles = 50, falls = 4;  // deg: the search goes from 60 to 2
constexpr const char* source = "elastic, perfectly plastic blocks without dilation, reference/slump";

// slopes 20 to 50 m high, face and bedding of the same dip, on 5 to 20 GPa/m
std::vector<BudgetScene> draw(unsigned seed, std::size_t count, int most_layers,
                              const std::vector<std::string>& overrides) {
  boost::random::mt19937_64 random(seed);
  const auto between = [&](double low, double high) {
    return boost::random::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<BudgetScene> scenes;
  while (scenes.size() < count) {
    reference::LayeredSlope slope;
    slope.dip = between(50, 70) * degree;
    slope.base_dip = between(-5, 8) * degree;
    slope.thickness = between(2, 6);
    slope.spacing = between(5, 15);
    slope.height = between(20, 50);
    slope.layers = boost::random::uniform_int_distribution<int>(1, most_layers)(random);
    slope.density = 2500;
    slope.gravity = 9.81;
    slope.normal_stiffness = slope.shear_stiffness = 5e9 * std::pow(4, between(0, 1));
    if (has_slivers(slope)) continue;
    const double truth = collapse_of(slope);
    if (truth < falls || truth > settles) continue;
    const std::string label =
        fmt::format("slope {}, dip {:.2f}, base {:.2f}, {} x {:.2f} m, spacing {:.2f} m, height {:.2f} m, {:.2g} Pa/m",
                    scenes.size(), slope.dip / degree, slope.base_dip / degree, slope.layers, slope.thickness,
                    slope.spacing, slope.height, slope.normal_stiffness);
    const std::filesystem::path file =
        verification::case_output("slump") / fmt::format("random_{}_{}.toml", seed, scenes.size());
    write_layered_scene(slope, label, file);
    scenes.push_back({label, file, overrides, truth});
  }
  return scenes;
}

double by_limit_analysis(const BudgetScene& scene) {
  const LimitAnalysis<2> analysis = analyse_limit<2>(load_scene(scene.scene), {.with_dilation = true});
  if (analysis.status != LimitStatus::found) throw std::runtime_error(scene.label + ": " + analysis.message);
  return analysis.values.front().second.value;
}

void try_budgets(unsigned seed, std::size_t count, int most_layers, const std::vector<std::string>& overrides) {
  CaseReport report("slump");
  const std::vector<BudgetScene> scenes = draw(seed, count, most_layers, overrides);
  double largest = 0;
  for (const BudgetScene& scene : scenes)
    largest = std::max(largest, std::abs(by_limit_analysis(scene) - scene.truth));
  report.report(fmt::format("limit analysis off the reference, most of {} random slopes", count), "deg", largest,
                "0.0026 for slopes that fail with opening joints, too");
  judge_budgets(report, "slump", "random slopes", source, scenes);
}

// of one layer, on integrated face contacts and by a coarse search, so that every build can afford them
TEST(SlumpBudget, EnclosesBlocksThatDoNotDilate) {
  try_budgets(52618, 1, 1, {"stage.critical.tolerance_deg=0.2", whole_faces});
}

TEST(SlumpBudgetLong, EnclosesBlocksThatDoNotDilate) {
  try_budgets(52619, 40, 4, {});
}

// the scene as committed
TEST(SlumpBudgetLong, OfTheWholeSearchEnclosesTheReference) {
  CaseReport report("slump");
  const reference::LayeredSlope slope{60 * degree, 5 * degree, 4, 8, 50, 3, 2500, 9.81, 10e9, 10e9};
  judge_budget(report, "slump", source,
               {"S0", std::filesystem::path(VOUSSOIR_CASE_DIR) / "scene.toml", {}, collapse_of(slope)});
}

}  // namespace
}  // namespace voussoir::cases::budget_test
