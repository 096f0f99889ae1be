// What the displacements of a stage of implicit steps owe to the error of its steps: `time.half_error`.
#pragma once

#include <optional>

#include "core/run/stage_in_force.hpp"
#include "core/run/watcher.hpp"

namespace voussoir {

// Before a stage of true motion begins: runs it with half of its steps' error and keeps where that leaves the bodies in
// Progress::by_half_error; nothing else of the progress changes. False: interrupted, to be begun again.
template <int Dim>
bool run_by_half_error(const RunPlan& timed, const StageInForce<Dim>& stage, const Watcher<Dim>& watcher,
                       Progress<Dim>& progress);

// When it has ended: against that run. Nothing if there was none.
template <int Dim>
std::optional<HalfErrorResult> judge_half_error(const Model<Dim>& model, const Progress<Dim>& progress);

}  // namespace voussoir
