// What a simulation is between two steps, for those who list or draw it: what a frame of this moment shows.
#pragma once

#include "core/model/prepared.hpp"
#include "core/run/progress.hpp"

namespace voussoir {

template <int Dim>
struct Snapshot {
  Model<Dim> model;  // as the stages so far have made it, that under way included
  State<Dim> state;  // forces are those at the positions; where the simulation failed, those that it failed with
};

// of a simulation that pauses, has ended, or has not begun
template <int Dim>
Snapshot<Dim> snapshot(const Prepared<Dim>& scene, const Progress<Dim>& progress);

// the model alone
template <int Dim>
Model<Dim> model_of(const Prepared<Dim>& scene, const Progress<Dim>& progress);

}  // namespace voussoir
