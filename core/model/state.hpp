// The changing side of a simulation, in parts: a step's functions take those that they change, and the rest const.
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

// Bodies that the model has got since follow at rest.
template <int Dim>
void add_bodies(const Model<Dim>& model, BodiesState<Dim>& bodies, ContactsState<Dim>& contacts, LoadsState<Dim>& loads,
                TimeStep& time_step);

// Forgets lists, poses and loads that are found again from motions and contacts.
template <int Dim>
void forget_lists(BodiesState<Dim>& bodies, ContactsState<Dim>& contacts, TimeStep& time_step);

// rest at the reference configuration
template <int Dim>
State<Dim> initial_state(const Model<Dim>& model);

// of a body under the gravity of now, N
template <int Dim>
Vector<Dim> weight(const Model<Dim>& model, const Schedule& schedule, std::size_t body);

}  // namespace voussoir
