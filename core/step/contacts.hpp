// The step's second line: which candidate pairs touch, and how.
#pragma once

#include "core/model.hpp"
#include "core/settings.hpp"
#include "core/state.hpp"

namespace voussoir {

// Point, normal, overlap and area of each candidate, each in its own slot; one that separated forgets its history.
template <int Dim>
void find_contacts(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

}  // namespace voussoir
