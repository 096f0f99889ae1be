// The step's third line: what the joints answer.
#pragma once

#include "core/model.hpp"
#include "core/settings.hpp"
#include "core/state.hpp"

namespace voussoir {

// joint forces from overlap and from the slip over the last step
template <int Dim>
void apply_joint_laws(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

// Bonds every closed joint that has tensile strength or cohesion: where it presses at once, elsewhere as soon as it
// first does, unless its faces part by more than a thousandth of the smallest inscribed radius before. No force
// changes.
template <int Dim>
void make_bonds(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

// takes the bonds of bodies that the model no longer has out of the count of those whole
template <int Dim>
void remove_bonds(const Model<Dim>& model, State<Dim>& state);

template <int Dim>
BondCount count_bonds(const State<Dim>& state);

}  // namespace voussoir
