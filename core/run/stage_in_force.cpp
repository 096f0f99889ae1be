#include "core/run/stage_in_force.hpp"

#include <utility>

#include "core/step.hpp"

namespace voussoir {

template <int Dim>
Model<Dim> model_after(const Prepared<Dim>& scene, int stages) {
  Model<Dim> model = scene.model;
  for (int s = 0; s < stages; ++s)
    model = apply(std::move(model), scene.stages[s].change);
  return model;
}

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

template Model<2> model_after<2>(const Prepared<2>&, int);
template Model<3> model_after<3>(const Prepared<3>&, int);
template State<2> with_forces<2>(const StageInForce<2>&, const State<2>&, bool);
template State<3> with_forces<3>(const StageInForce<3>&, const State<3>&, bool);

}  // namespace voussoir
