// The step's fourth line: what acts on each body.
#pragma once

#include "core/model.hpp"
#include "core/settings.hpp"
#include "core/state.hpp"

namespace voussoir {

// gravity, boundary stress and contact forces summed on each body, in the order of the contacts
template <int Dim>
void sum_loads(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

}  // namespace voussoir
