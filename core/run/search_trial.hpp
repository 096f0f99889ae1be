// The outcome of a trial of a search.
#pragma once

#include "core/base/settings.hpp"
#include "core/run/run.hpp"

namespace voussoir {

enum class SearchTrial { stable, failed, undecided, broken };  // broken: a numerical failure

SearchTrial trial_of(StopReason reason);

// in tables: "stable", …
const char* outcome_of(SearchTrial trial);

// two rates: the trials after the one to equilibrium
inline constexpr int faster_fall = 1, coming_nearer = 2, slower_fall = 3;

// Whether a trial, counted from 0, is a detour: its effects are undone, or it only shows failure. The others are the
// path to the result, whose time never goes back.
bool is_detour(ReductionMethod method, int trial, SearchTrial outcome);

}  // namespace voussoir
