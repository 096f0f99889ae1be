// The error budget of a run, `[accuracy] budget = true`: what the program chose, and the scene's author with it, is
// varied one thing at a time (budget_variations.hpp), each in a run of its own beside the answer, and every value says
// by how much it moved.
// Searches look near the answer's bracket first, which costs a fraction of it; where they move, one that varies nothing
// else tells what of it the other path did.
//
//   bar² = bracket² + bracket of the others² + Σ (1.25 left)²
//
// (half brackets). `left` is what a shift says is still open: where an order p is known and the thing was refined by a
// factor f, Richardson's shift f^p / (f^p - 1), with Roache's margin of 1.25 on it. A search that finds the answer's
// own bracket has not moved.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/base/run_scene.hpp"

namespace voussoir {

bool wants_budget(const LoadedScene& scene);

// the folders of its runs, below that of the answer, in all rounds in which the answer may be refined
// (accuracy_on_order.hpp)
std::vector<std::string> budget_folders(const LoadedScene& scene);

struct BudgetRuns {
  std::string name;                   // tells scene, program and round apart from all others
  std::vector<std::string> settings;  // overrides of scene.toml that the answer was found with
};
BudgetRuns budget_runs(const LoadedScene& stated, int round, const std::vector<std::string>& settings);

// Carries the runs out, or what is missing of them, in `folder`, where scene.toml stands, and gives the values their
// budgets and bars. What cannot be varied is told in the warnings. False: a signal stopped it; what is done is kept.
bool add_budget(const LoadedScene& scene, const BudgetRuns& runs, const std::filesystem::path& folder, int threads,
                bool quiet, Results& results);

}  // namespace voussoir
