// Changes of a stage before its first step, and records at its end.
#pragma once

#include "core/run/execute_stage.hpp"
#include "core/run/stage_in_force.hpp"
#include "core/run/watcher.hpp"

namespace voussoir {

// Model and settings of the stage at which the progress is, whether it begins or continues; an excavation of a stage
// that begins removes its region from the state, too.
template <int Dim>
void enter_stage(const Prepared<Dim>& scene, Model<Dim>& model, Settings& settings, Progress<Dim>& progress);

// The stage's changes to the state: strength, supports, bonds, water. Bolts that cannot be installed are an outcome.
template <int Dim>
void begin_stage(const StageInForce<Dim>& stage, Progress<Dim>& progress);

// its results, last row and last frame
template <int Dim>
void end_stage(const StageInForce<Dim>& stage, const StageOutcome& done, const Watcher<Dim>& watcher,
               Progress<Dim>& progress);

}  // namespace voussoir
