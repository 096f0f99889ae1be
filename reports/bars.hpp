#pragma once
// Whether error bars cover the truth: those of budgets, in the sets that cases draw for it, and those of brackets
// alone, in the studies.
#include <string>
#include <vector>

#include "reports/trade.hpp"

namespace voussoir::reports {

// what a case's budget.csv holds: a scene a row, in degrees; cost over the answer's
struct BudgetSet {
  std::string name;
  std::vector<double> error, bar, cost;
};

// throws FileFault, or std::runtime_error where a column is missing
BudgetSet read_budget_set(const std::string& name, const std::string& csv);

// for bars.gp: case, error_deg, bar_deg
std::string bars_csv(const std::vector<BudgetSet>& sets);

// the results.json of a case's scene that was run with its budget
struct SceneBudget {
  std::string name;  // of the case
  nlohmann::json results;
};

// a section of the page "What accuracy costs"; the figure is bars.svg. Empty where there is neither.
std::string bars_markdown(const std::vector<BudgetSet>& sets, const std::vector<SceneBudget>& scenes,
                          const std::vector<CaseStudy>& studies);

}  // namespace voussoir::reports
