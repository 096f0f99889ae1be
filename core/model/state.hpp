// The changing side of a simulation, in parts: a step's functions take the parts that they change, and the others
// const.
#pragma once

#include "core/model/bodies_state.hpp"
#include "core/model/contacts_state.hpp"
#include "core/model/ledger.hpp"
#include "core/model/loads_state.hpp"
#include "core/model/schedule.hpp"
#include "core/model/solver_states.hpp"
#include "core/model/supports_state.hpp"

namespace voussoir {

template <int Dim>
struct State {
  BodiesState<Dim> bodies;
  ContactsState<Dim> contacts;
  SupportsState<Dim> supports;
  LoadsState<Dim> loads;
  Schedule schedule;
  Ledger ledger;
  Counters counters;
  // of the solvers
  TimeStep time_step;
  Relaxation<Dim> relaxation;
  StaticIncrement<Dim> increment;
};

// Bodies added to the model since then follow without motion.
template <int Dim>
void add_bodies(const Model<Dim>& model, BodiesState<Dim>& bodies, ContactsState<Dim>& contacts, LoadsState<Dim>& loads,
                TimeStep& time_step);

// Clears lists, poses and loads that are recomputed from motions and contacts.
template <int Dim>
void forget_lists(BodiesState<Dim>& bodies, ContactsState<Dim>& contacts, TimeStep& time_step);

// no motion, at the reference configuration
template <int Dim>
State<Dim> initial_state(const Model<Dim>& model);

// of a body under the present gravity, N
template <int Dim>
Vector<Dim> weight(const Model<Dim>& model, const Schedule& schedule, std::size_t body);

}  // namespace voussoir
