#include "core/run/search_trial.hpp"

namespace voussoir {

SearchTrial trial_of(StopReason reason) {
  switch (reason) {
    case StopReason::equilibrium:
      return SearchTrial::stable;
    case StopReason::lost_equilibrium:
    case StopReason::moved_away:
      return SearchTrial::failed;
    case StopReason::no_contact_answer:
    case StopReason::not_finite:
      return SearchTrial::broken;
    default:
      return SearchTrial::undecided;
  }
}

const char* outcome_of(SearchTrial trial) {
  constexpr const char* names[] = {"stable", "failed", "undecided", "broken"};  // in the order of the enumeration
  return names[static_cast<int>(trial)];
}

bool is_detour(ReductionMethod method, int trial, SearchTrial outcome) {
  switch (method) {
    case ReductionMethod::bisection:
    case ReductionMethod::steps:
      return outcome != SearchTrial::stable;
    case ReductionMethod::rate:
      return false;
    case ReductionMethod::two_rates:
      return trial == faster_fall || (trial == coming_nearer && outcome != SearchTrial::stable);
  }
  return false;
}

}  // namespace voussoir
