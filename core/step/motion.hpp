// The step's last line: where the loads take the bodies.
#pragma once

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// Gravity that grows lifts or lowers the potential energy of what has already moved, and a water that rises that of
// what lies in it: counted where it is. Relaxation learns what of the loads' change the water has imposed.
template <int Dim>
void add_ramps(const Model<Dim>& model, const Settings& settings, const BodiesState<Dim>& bodies,
               const LoadsState<Dim>& loads, Schedule& schedule, EnergyBalance& energy, Relaxation<Dim>& relaxation);

// A time step that today's contacts allow, then velocities, then positions; or one of relaxation. Contacts change in
// nothing but the area that they are rated with.
template <int Dim>
void move_bodies(const Model<Dim>& model, const Settings& settings, const Counters& counters, BodiesState<Dim>& bodies,
                 ContactsState<Dim>& contacts, LoadsState<Dim>& loads, Schedule& schedule, Ledger& ledger,
                 TimeStep& time_step, Relaxation<Dim>& relaxation);

}  // namespace voussoir
