// One time step: the whole method in five lines.
#pragma once

#include <functional>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// The forces at the positions of now, all but the last stage of a step: afterwards positions, forces and time are those
// of one moment. To have them without a step, take a copy of the state, for histories continue.
template <int Dim>
void find_forces(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

// Advances the state by one step; `with_forces`, which may be empty, is called between its forces and its motion.
// Contacts that found no answer are counted in state.counters.unconverged; the caller stops.
template <int Dim>
void step(const Model<Dim>& model, const Settings& settings, State<Dim>& state,
          const std::function<void(State<Dim>&)>& with_forces = {});

}  // namespace voussoir
