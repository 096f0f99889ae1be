// The records of a stage: rows of the history, frames, reports of progress, stable states, bonds. Each function adds to
// Progress, and none changes the state.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/run/run.hpp"
#include "core/run/stage_in_force.hpp"
#include "core/run/watcher.hpp"

namespace voussoir {

// of the history, of this state; trial 0: the path to the result
template <int Dim>
std::vector<double> row_of(const StageInForce<Dim>& stage, const State<Dim>& state,
                           const std::vector<StageEnd<Dim>>& ends, int trial = 0);

template <int Dim>
void add_frame(const StageInForce<Dim>& stage, const State<Dim>& state, const Watcher<Dim>& watcher,
               Progress<Dim>& progress);

// of a trial that is undone
template <int Dim>
void add_trial_frame(const StageInForce<Dim>& stage, const State<Dim>& state, int trial, const Watcher<Dim>& watcher,
                     Progress<Dim>& progress);

template <int Dim>
void report_progress(const StageInForce<Dim>& stage, const State<Dim>& state, const std::string& detail,
                     double unbalanced, double done, const Watcher<Dim>& watcher);

// rows, frames and progress while a run continues; `end` is its end time if known
template <int Dim>
RunHooks<Dim> record_run(const StageInForce<Dim>& stage, std::optional<double> end, const Watcher<Dim>& watcher,
                         Progress<Dim>& progress);

// a search records the end of each trial
template <int Dim>
RunHooks<Dim> report_trials(const StageInForce<Dim>& stage, const Watcher<Dim>& watcher, Progress<Dim>& progress);

// the rows of the stage, the last of this state, to the history
template <int Dim>
void finish_rows(const StageInForce<Dim>& stage, const State<Dim>& state, Progress<Dim>& progress);

// Results::at_last_stable_state; of a search with its trial
template <int Dim>
void note_stable(const StageInForce<Dim>& stage, const State<Dim>& state, Progress<Dim>& progress,
                 const std::optional<TrialRow>& trial = {});

// a detail after others: "; …", or empty
std::string and_more(const std::string& detail);

}  // namespace voussoir
