// The change of the load of water as a body moves, for the implicit static solver.
#pragma once

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// StaticSystem::of_water: minus the derivative of each free body's water load with respect to its own motion,
// translations then rotations, by central differences about its present pose, N/m, N and N m. Empty without water.
template <int Dim>
void find_water_stiffness(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                          const BodiesState<Dim>& bodies, std::vector<typename PairStiffness<Dim>::Block>& blocks);

}  // namespace voussoir
