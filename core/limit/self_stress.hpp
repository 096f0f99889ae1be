// Forces in equilibrium without any load, as in blocks jammed between walls.
#pragma once

#include <vector>

#include "core/limit/corner_cones.hpp"

namespace voussoir {

// The faces that can have normal forces in equilibrium without any load and move in the mechanism, if the loads are not
// supported without the forces there; else none. No velocities: all such faces count.
template <int Dim>
std::vector<int> may_rest_on_self_stress(const CornerAssembly<Dim>& assembly, const Loads<Dim>& loads,
                                         const std::vector<BodyVelocity<Dim>>& velocities);

// Whether loads that are not supported are, as soon as the faces that `gain` friction have any: faces with self-stress
// then carry any force, and may in turn make self-stress in others possible.
template <int Dim>
bool carried_by_any_friction(const CornerAssembly<Dim>& assembly, const Loads<Dim>& loads,
                             const std::vector<bool>& gain);

}  // namespace voussoir
