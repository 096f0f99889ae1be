// The step's last line: motion of the bodies under their loads.
#pragma once

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// s: the next step of a motion, as long as allowed, or shorter so that equal steps end exactly when `left` has passed;
// infinity: the motion has no end
double equal_step(double longest, double left);

// Increasing gravity changes the potential energy of displaced bodies, and rising water that of submerged ones: counted
// in their present position. Relaxation receives the change of loads that the water has imposed.
template <int Dim>
void add_ramps(const Model<Dim>& model, const Settings& settings, const BodiesState<Dim>& bodies,
               const LoadsState<Dim>& loads, Schedule& schedule, EnergyBalance& energy, Relaxation<Dim>& relaxation);

// A time step that the present contacts allow, then velocities, then positions; or a step of relaxation. Of contacts
// only the rated area changes.
template <int Dim>
void move_bodies(const Model<Dim>& model, const Settings& settings, const Counters& counters, BodiesState<Dim>& bodies,
                 ContactsState<Dim>& contacts, LoadsState<Dim>& loads, Schedule& schedule, Ledger& ledger,
                 TimeStep& time_step, Relaxation<Dim>& relaxation);

}  // namespace voussoir
