// One time step: the whole method in five lines.
#pragma once

#include "core/model.hpp"
#include "core/settings.hpp"
#include "core/state.hpp"

namespace voussoir {

// Advances the state by one step. Contacts that found no answer are counted in state.counters.unconverged; the caller
// stops.
template <int Dim>
void step(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

}  // namespace voussoir
