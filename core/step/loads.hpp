// The step's fourth line: what acts on each body.
#pragma once

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// All forces and moments on each body by source, and their sums; contact forces in the order of the contacts. The
// relief loads among them are read.
template <int Dim>
void sum_loads(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
               const BodiesState<Dim>& bodies, const ContactsState<Dim>& contacts, const SupportsState<Dim>& supports,
               LoadsState<Dim>& loads);

// Minus the derivative of the loads other than contacts with the motion of their own body, translations, then turns,
// N/m, N and N m: how a force that acts at a lever, or turns with the body, changes with the pose. By body; empty where
// no load does.
template <int Dim>
std::vector<typename PairStiffness<Dim>::Block> load_stiffness(const Model<Dim>& model, const State<Dim>& state);

}  // namespace voussoir
