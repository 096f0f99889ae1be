// An excavation within a simulation: the model's (excavation.hpp), and what the state makes of it.
#pragma once

#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/stage/excavation.hpp"

namespace voussoir {

// Takes named regions out of model and state. Bodies that lose parts go on as they moved, and the joints that are left
// keep forces and histories. With `hold` the forces by which the rock that is gone held the others go on acting as
// loads, State::loads.relief: every body that is left has the acceleration that it had. Returns what has become of the
// bodies.
template <int Dim>
Excavated<Dim> excavate(const std::vector<std::string>& names, const Settings& settings, bool hold, Model<Dim>& model,
                        State<Dim>& state);

}  // namespace voussoir
