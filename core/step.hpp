// One time step: the method in five lines.
#pragma once

#include <functional>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// The forces at the present positions, all lines of a step except the last: afterwards positions, forces and time
// belong to the same instant. To get them without a step, use a copy of the state, because histories are updated.
template <int Dim>
void find_forces(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

// Advances the state by one step; `with_forces`, which may be empty, is called between its forces and its motion.
// Contacts without a solution are counted in state.counters.unconverged; the caller stops.
template <int Dim>
void step(const Model<Dim>& model, const Settings& settings, State<Dim>& state,
          const std::function<void(State<Dim>&)>& with_forces = {});

}  // namespace voussoir
