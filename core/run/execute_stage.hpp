// Executes the stage under way: it settles, runs for a time, or searches.
#pragma once

#include <optional>
#include <string>

#include "core/run/stage_in_force.hpp"
#include "core/run/watcher.hpp"

namespace voussoir {

// a stage that has ended
struct StageOutcome {
  std::string ended;
  double unbalanced = -1;  // StageResult::unbalanced
};

// Continues with the stage under way: its state, its rows and frames, its results. Nothing: interrupted. A stage that
// cannot be executed ends with the outcome in the results; results of stages before it are kept.
template <int Dim>
std::optional<StageOutcome> execute_stage(const StageInForce<Dim>& stage, const Watcher<Dim>& watcher,
                                          Progress<Dim>& progress);

}  // namespace voussoir
