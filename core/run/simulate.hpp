// A whole scene: its stages one after the other, monitors recorded, results gathered.
#pragma once

#include <functional>

#include "core/model/prepared.hpp"
#include "core/run/progress.hpp"

namespace voussoir {

struct ProgressReport {
  std::string stage;
  int stage_number = 0, stage_count = 0;  // from 1
  std::string detail;                     // e.g. "trial at 33.4 deg"
  long long steps = 0;                    // of the whole simulation
  double time = 0;                        // s simulated
  double unbalanced = 0;                  // the equilibrium measure
  double done = -1;                       // fraction of the stage done, 0..1; negative when unknown
};

// Callbacks; each may be empty. None can change the simulation.
template <int Dim>
struct Watcher {
  std::function<void(const ProgressReport&)> progress;  // every thousand steps or so
  // as the output plan asks; time never goes back
  std::function<void(const Model<Dim>&, const State<Dim>&, double time)> frame;
  // the end of a search's trial, counted from 1, that is taken back
  std::function<void(const Model<Dim>&, const State<Dim>&, int trial)> trial_frame;
  // before every step, with all that a later `simulate` needs to continue; true stops here
  std::function<bool(const Progress<Dim>&)> pause;
  // once, when the last stage has ended, before the results of the end are added: from here on another scene of the
  // same stages can go on (begin.hpp)
  std::function<void(const Progress<Dim>&)> ended = {};
};

// before the first step
template <int Dim>
Progress<Dim> initial_progress(const Prepared<Dim>& scene);

// Continues until the scene is done (true, results are complete) or the watcher stops it (false).
template <int Dim>
bool simulate(const Prepared<Dim>& scene, Progress<Dim>& progress, const Watcher<Dim>& watcher);

// the rows so far, those of the stage under way included
template <int Dim>
History history_so_far(const Progress<Dim>& progress);

}  // namespace voussoir
