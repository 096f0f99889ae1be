// One implicit step of a given length.
#pragma once

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// Moves everything on by h, s. `within`, m: the geometry of the contacts at half of the motion is found again until
// that moves no body by more. False: the equations were not solved, their geometry did not settle, or a body goes too
// far; the state is spoilt, but for the counters.
template <int Dim>
bool advance(const Model<Dim>& model, const Settings& settings, double h, double within, State<Dim>& state);

}  // namespace voussoir
