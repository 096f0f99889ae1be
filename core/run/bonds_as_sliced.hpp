// The bonds with which a simulation begins: a stated strength acts where the slicing left rock in one piece with a
// joint through it.
#pragma once

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// whether some joint properties have bonds as sliced
template <int Dim>
bool has_bonds_as_sliced(const Model<Dim>& model);

// Bonds the joints with such properties whose two faces, both of this joint, are opposite each other in the reference
// configuration; each when it is first compressed, as make_bonds does.
template <int Dim>
void make_bonds_as_sliced(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

}  // namespace voussoir
