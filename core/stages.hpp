// The stages of a step: each takes what the kernels need out of Model and State and puts their answers back.
#pragma once

#include "core/model.hpp"
#include "core/neighbours.hpp"
#include "core/settings.hpp"
#include "core/state.hpp"

namespace voussoir {

// geometry of each candidate; one that separated forgets its history
template <int Dim>
void find_contacts(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

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

// gravity, boundary stress and contact forces summed on each body, in the order of the contacts
template <int Dim>
void sum_loads(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

// a time step that today's contacts allow, then velocities, then positions
template <int Dim>
void move_bodies(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

}  // namespace voussoir
