// A whole scene: its stages one after the other, monitors recorded, results gathered.
#pragma once

#include <functional>

#include "core/results.hpp"
#include "core/scene/prepared.hpp"

namespace voussoir {

struct ProgressReport {
  std::string stage;
  int stage_number = 0, stage_count = 0;  // from 1
  std::string detail;                     // e.g. "trial at 33.4 deg"
  long long steps = 0;                    // of the whole simulation
  double time = 0;                        // s simulated
  double unbalanced = 0;                  // the equilibrium measure
  double done = -1;                       // share of the stage done, 0..1; negative when unknown
};

// Callbacks; each may be empty. Neither can change the simulation.
template <int Dim>
struct Watcher {
  std::function<void(const ProgressReport&)> progress;                           // every thousand steps or so
  std::function<void(const Model<Dim>&, const State<Dim>&, double time)> frame;  // as the output plan asks
};

template <int Dim>
Results simulate(Prepared<Dim> scene, const Watcher<Dim>& watcher);

}  // namespace voussoir
