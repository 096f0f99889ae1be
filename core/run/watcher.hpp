// What a simulation reports while it is under way.
#pragma once

#include <functional>
#include <string>

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
  // by the output plan; time never goes back
  std::function<void(const Model<Dim>&, const State<Dim>&, double time)> frame;
  // the end of an undone trial of a search, counted from 1
  std::function<void(const Model<Dim>&, const State<Dim>&, int trial)> trial_frame;
  // before every step, with everything that a later `simulate` needs to continue; true stops here
  std::function<bool(const Progress<Dim>&)> pause;
  // once, when the last stage has ended, before the final results are added: from here on another scene with the same
  // stages can continue (begin.hpp)
  std::function<void(const Progress<Dim>&)> ended = {};
};

}  // namespace voussoir
