// The stage under way, const while it runs, and its outcome.
#pragma once

#include <string>

#include "core/model/prepared.hpp"
#include "core/model/state.hpp"
#include "core/output/results.hpp"

namespace voussoir {

template <int Dim>
struct StageInForce {
  const Prepared<Dim>& scene;
  int place;  // from 0
  const Model<Dim>& model;
  const Settings& settings;

  const StagePlan& plan() const { return scene.stages[place]; }
};

// after the changes of the scene's first stages
template <int Dim>
Model<Dim> model_after(const Prepared<Dim>& scene, int stages);

// "settle", "run", "reduce"
const char* kind_of(const StagePlan& stage);

// The state with the forces at its positions, which a step leaves at the previous ones: rows and frames are at one
// time. After a failed run its forces are kept.
template <int Dim>
State<Dim> with_forces(const StageInForce<Dim>& stage, const State<Dim>& state, bool failed);

// the outcome of the results, with the stage's name before the message
void fail(const StagePlan& stage, Outcome outcome, const std::string& message, Results& results);

}  // namespace voussoir
