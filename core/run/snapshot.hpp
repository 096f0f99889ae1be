// A simulation between two steps, for tables and drawings: the content of a frame at this moment.
#pragma once

#include "core/model/prepared.hpp"
#include "core/run/progress.hpp"

namespace voussoir {

template <int Dim>
struct Snapshot {
  Model<Dim> model;  // after the stages so far, including that under way
  State<Dim> state;  // forces are those at the positions; if the simulation failed, those at failure
};

// of a simulation that pauses, has ended, or has not begun
template <int Dim>
Snapshot<Dim> snapshot(const Prepared<Dim>& scene, const Progress<Dim>& progress);

// only the model
template <int Dim>
Model<Dim> model_of(const Prepared<Dim>& scene, const Progress<Dim>& progress);

}  // namespace voussoir
