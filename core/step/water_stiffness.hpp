// How the load of water changes as a body moves: what Newton's method on the joints needs of it.
#pragma once

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// StaticSystem::of_water: minus the derivative of each free body's water load with its own motion, translations then
// turns, by central differences about where it stands, N/m, N and N m. None without water.
template <int Dim>
void find_water_stiffness(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                          const BodiesState<Dim>& bodies, std::vector<typename PairStiffness<Dim>::Block>& blocks);

}  // namespace voussoir
