// An excavation within a simulation: the change of the model (excavation.hpp) and of the state.
#pragma once

#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/stage/excavation.hpp"

namespace voussoir {

// Removes named regions from model and state. Bodies that lose parts keep their motion, and the remaining joints keep
// forces and histories. With `hold` the forces by which the excavated rock supported the rest continue to act as loads,
// State::loads.relief: every remaining body has the same acceleration as before. Returns the mapping of old to new
// bodies.
template <int Dim>
Excavated<Dim> excavate(const std::vector<std::string>& names, const Settings& settings, bool hold, Model<Dim>& model,
                        State<Dim>& state);

}  // namespace voussoir
