// The work of every load over a step, for the energy balance.
#pragma once

#include <vector>

#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/step/integrate.hpp"

namespace voussoir {

// Adds to the ledger the work of each source in LoadsState::by_source along the kicks: force times path plus moment
// times rotation. The balance is checked between the halves, at the time of the positions. Under relaxation there is no
// kinetic energy.
template <int Dim>
void add_work(const Model<Dim>& model, int threads, const std::vector<Kick<Dim>>& kicks, const LoadsState<Dim>& loads,
              const Relaxation<Dim>& relaxation, EnergyBalance& energy);

}  // namespace voussoir
