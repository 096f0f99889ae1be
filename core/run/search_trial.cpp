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

}  // namespace voussoir
