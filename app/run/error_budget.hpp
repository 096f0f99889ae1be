// The error budget of a run, `[accuracy] budget = true`: numerical settings, of the program and of the scene, are
// varied one at a time (budget_variations.hpp), each in an additional run, and every value lists its shifts.
//
//   bar² = bracket² + bracket of the others² + criterion² + Σ (1.25 left)²
//
// (half brackets, of results that are the middle of theirs). `left` is the remaining error that follows from a shift:
// if an order p is known and the setting was refined by a factor f, Richardson's shift f^p / (f^p - 1), with Roache's
// margin of 1.25. A search that finds the result's own bracket has not shifted. `criterion` is the error of a result
// that follows from the strength that a failing motion requires, and costs nothing.
//
// Of searches that the required strength judges, the budget takes at most six evaluations of the result, and the
// stiffness' error is nearly all of it: it is first order, and a second factor measures that if it matters. Those that
// fail by displacement look near the result's bracket first, which costs a fraction of a full search; if they shift, a
// run that varies nothing else gives the part that is due to the other path.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/base/run_scene.hpp"

namespace voussoir {

bool wants_budget(const LoadedScene& scene);

// whether searches are to have bars that cover stiffness, without a budget: [accuracy] error_bar = "stiffness"
bool wants_stiffness_bar(const LoadedScene& scene);

// the folders of its runs, within that of the run, in all rounds in which the result may be refined
// (accuracy_on_order.hpp)
std::vector<std::string> budget_folders(const LoadedScene& scene);

struct BudgetRuns {
  std::string name;                   // identifies scene, program and round
  std::vector<std::string> settings;  // overrides of scene.toml with which the result was found
};
BudgetRuns budget_runs(const LoadedScene& stated, int round, const std::vector<std::string>& settings);

// Carries out the missing runs in `folder`, which contains scene.toml, and gives the values their budgets and bars.
// Failed variations are reported in the warnings. False: a signal stopped it; completed runs are kept.
bool add_budget(const LoadedScene& scene, const BudgetRuns& runs, const std::filesystem::path& folder, int threads,
                bool quiet, Results& results);

// The same for error_bar = "stiffness": one run with stiffer joints and shorter increments, in which the error of first
// order is seen that sliding searches have; others keep their bars, as do results of which no stiffness is assumed.
bool add_stiffness_bar(const LoadedScene& scene, const BudgetRuns& runs, const std::filesystem::path& folder,
                       int threads, bool quiet, Results& results);

}  // namespace voussoir
