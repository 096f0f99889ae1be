// The step's fourth line: the loads on each body.
#pragma once

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// All forces and moments on each body by source, and their sums; contact forces in the order of the contacts. Relief
// loads among them are only read.
template <int Dim>
void sum_loads(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
               const BodiesState<Dim>& bodies, const ContactsState<Dim>& contacts, const SupportsState<Dim>& supports,
               LoadsState<Dim>& loads);

// Minus the derivative of all loads except contacts with respect to the motion of their own body, translations, then
// rotations, N/m, N and N m: the change with the pose of a force with a lever arm, or of one that turns with the body.
// By body; empty if no load changes.
template <int Dim>
std::vector<typename PairStiffness<Dim>::Block> load_stiffness(const Model<Dim>& model, const State<Dim>& state);

}  // namespace voussoir
