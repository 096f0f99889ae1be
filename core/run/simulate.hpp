// A complete scene: its stages one after the other, monitors recorded, results collected.
#pragma once

#include "core/model/prepared.hpp"
#include "core/run/watcher.hpp"

namespace voussoir {

// before the first step
template <int Dim>
Progress<Dim> initial_progress(const Prepared<Dim>& scene);

// Continues until the scene is done (true, results are complete) or the watcher stops it (false).
template <int Dim>
bool simulate(const Prepared<Dim>& scene, Progress<Dim>& progress, const Watcher<Dim>& watcher);

// the rows so far, including those of the stage under way
template <int Dim>
History history_so_far(const Progress<Dim>& progress);

}  // namespace voussoir
