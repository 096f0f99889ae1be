// The outcome of a trial of a search.
#pragma once

#include "core/run/run.hpp"

namespace voussoir {

enum class SearchTrial { stable, failed, undecided, broken };  // broken: a numerical failure

SearchTrial trial_of(StopReason reason);

// in tables: "stable", …
const char* outcome_of(SearchTrial trial);

}  // namespace voussoir
