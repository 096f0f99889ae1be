#include "core/run/stage_in_force.hpp"

#include "core/step.hpp"

namespace voussoir {

const char* kind_of(const StagePlan& stage) {
  constexpr const char* kinds[] = {"settle", "run", "reduce"};  // in the order of the variant
  return kinds[stage.plan.index()];
}

template <int Dim>
State<Dim> with_forces(const StageInForce<Dim>& stage, const State<Dim>& state, bool failed) {
  State<Dim> copy = state;
  if (!failed) find_forces(stage.model, stage.settings, copy);
  return copy;
}

void fail(const StagePlan& stage, Outcome outcome, const std::string& message, Results& results) {
  results.outcome = outcome;
  results.message = "stage " + stage.name + ": " + message;
}

template State<2> with_forces<2>(const StageInForce<2>&, const State<2>&, bool);
template State<3> with_forces<3>(const StageInForce<3>&, const State<3>&, bool);

}  // namespace voussoir
