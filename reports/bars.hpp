#pragma once
// Coverage of the truth by error bars: those of budgets, in the sets that cases draw for it, and those of brackets
// only, in the studies.
#include <string>
#include <vector>

#include "reports/trade.hpp"

namespace voussoir::reports {

// a case's budget.csv: a scene a row, in degrees; cost over that of the result without budget
struct BudgetSet {
  std::string name;
  std::vector<double> error, bar, cost;
};

// throws FileFault, or std::runtime_error if a column is missing
BudgetSet read_budget_set(const std::string& name, const std::string& csv);

// for bars.gp: case, error_deg, bar_deg
std::string bars_csv(const std::vector<BudgetSet>& sets);

// the results.json of a case's scene that was run with its budget
struct SceneBudget {
  std::string name;  // of the case
  nlohmann::json results;
};

// a section of the page "Cost of accuracy"; the figure is bars.svg. Empty if there are no bars.
std::string bars_markdown(const std::vector<BudgetSet>& sets, const std::vector<SceneBudget>& scenes,
                          const std::vector<CaseStudy>& studies);

}  // namespace voussoir::reports
