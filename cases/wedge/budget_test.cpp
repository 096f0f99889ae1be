// Whether error budgets enclose the truth: random wedges against the closed form, by the program itself.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cases/case_tools.hpp"
#include "cases/wedge/wedge_scene.hpp"

namespace voussoir::cases {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;

// what was asked of budgets
constexpr double enclosed = 0.95, widest = 4, dearest = 3;

struct Found {
  double value = 0, bar = 0, bracket = 0, cost = 0;  // deg; evaluations of the budget over the answer's
};

Found with_budget(const reference::Wedge& w, double stiffness) {
  const std::filesystem::path out = verification::case_output("wedge") / "budget";
  std::string command = fmt::format("'{}' run '{}/scene.toml' --budget --overwrite --quiet --out '{}'",
                                    VOUSSOIR_PROGRAM, VOUSSOIR_CASE_DIR, out.string());
  std::vector<std::string> sets = overrides(w);
  sets.push_back("output.frames=false");
  sets.push_back(fmt::format("joint_properties.rock.normal_stiffness={:.17g}", stiffness));
  sets.push_back(fmt::format("joint_properties.rock.shear_stiffness={:.17g}", 0.1 * stiffness));
  for (const std::string& set : sets)
    command += fmt::format(" --set '{}'", set);
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
  std::ifstream file(out / "results.json");
  const nlohmann::json results = nlohmann::json::parse(file);
  const nlohmann::json& angle = results.at("values").at("critical_friction");
  return {angle.at("value"), angle.at("error_bar"), angle.at("bracket"),
          results.at("budget").at("contact_evaluations").get<double>() /
              results.at("counters").at("contact_evaluations").get<double>()};
}

double median(std::vector<double> numbers) {
  std::ranges::sort(numbers);
  return numbers[numbers.size() / 2];
}

// wedges that slide on one plane or on both, no borderline ones, on 10 MPa/m to 1 GPa/m
void try_budgets(CaseReport& report, unsigned seed, int count) {
  boost::random::mt19937_64 random(seed);
  boost::random::uniform_real_distribution<double> dip(20, 80), direction(0, 360), power(7, 9);
  int inside = 0, inside_bracket = 0, drawn = 0;
  std::vector<double> ratios, costs, errors, bars;
  while (drawn < count) {
    const reference::Wedge w = wedge(dip(random), direction(random), dip(random), direction(random));
    const double stiffness = std::pow(10, power(random));
    const std::optional<double> critical = reference::critical_friction(w);
    if (!critical || !reference::classify_wedge(w).non_degenerate ||
        reference::solve_wedge(w).line_plunge / degree < 15)
      continue;
    ++drawn;
    const Found found = with_budget(w, stiffness);
    const double error = std::abs(found.value - *critical / degree);
    inside += error <= found.bar;
    inside_bracket += error <= found.bracket;
    errors.push_back(error);
    bars.push_back(found.bar);
    ratios.push_back(found.bar / error);
    costs.push_back(found.cost);
    fmt::print("{:.3f} deg, {:.2g} Pa/m: off by {:.4f}, bar {:.4f}, {:.2g} times the cost{}\n", found.value, stiffness,
               error, found.bar, found.cost, error <= found.bar ? "" : ", outside");
  }
  const std::string of = fmt::format(" of {} random wedges", count);
  const double share = static_cast<double>(inside) / count;
  report.record({"share" + of + " that the budget's bar encloses",
                 "1",
                 Kind::limit,
                 "Hoek & Bray (1974)",
                 0,
                 {count < 20 ? 1 - 1.0 / count : enclosed, 0, Bound::at_least},
                 "what was asked of budgets; of few, all but one"},
                share);
  report.record({"bar over error, median" + of,
                 "1",
                 Kind::limit,
                 "Hoek & Bray (1974)",
                 0,
                 {widest, 0, Bound::at_most},
                 "what was asked of budgets"},
                median(ratios));
  report.report("cost of the budget, median" + of, "1", median(costs),
                fmt::format("over the answer's; {:g} was asked", dearest));
  report.report("share" + of + " that the bracket alone encloses", "1", static_cast<double>(inside_bracket) / count,
                "what a bar without a budget covers");
  write_csv("wedge", "budget.csv", {"error_deg", "bar_deg", "cost"}, {errors, bars, costs});
}

TEST(Wedge, BudgetsEncloseTheClosedForm) {
  CaseReport report("wedge");
  try_budgets(report, 20133, 10);
}

TEST(WedgeLong, BudgetsEncloseTheClosedForm) {
  CaseReport report("wedge");
  try_budgets(report, 20134, 200);
}

}  // namespace
}  // namespace voussoir::cases
