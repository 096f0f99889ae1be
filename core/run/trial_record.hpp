// The records that a trial of a search leaves in the results when it ends.
#pragma once

#include "core/run/progress.hpp"
#include "core/run/search_trial.hpp"
#include "core/run/stage_in_force.hpp"

namespace voussoir {

// The trial under way has ended in this state at this level, in the unit that the search's value has: a row of
// search.csv, and of a stable or failed trial also part of Results::at_last_stable_state.
template <int Dim>
void note_trial(const StageInForce<Dim>& stage, const State<Dim>& state, double level, const char* unit,
                SearchTrial outcome, Progress<Dim>& progress);

// The last failed trial has been followed to this state: what moves there, and how, is its mechanism, unless it has
// come to rest before the place at which it was judged.
template <int Dim>
void note_followed(const StageInForce<Dim>& stage, const State<Dim>& state, Progress<Dim>& progress);

}  // namespace voussoir
