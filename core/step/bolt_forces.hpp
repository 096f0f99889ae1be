// What bolts do to their blocks (core/support/bolt.hpp, core/support/grouted_bolt.hpp).
#pragma once

#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// Answers every spring and every grouted bar at the poses of now, which must be cached; the ledger gets the energy that
// they hold, which it must already have of the contacts, and what yield took. A bar without equilibrium counts as
// unconverged.
template <int Dim>
void find_bolt_forces(const Model<Dim>& model, State<Dim>& state);

// adds what the springs do, as they were answered
template <int Dim>
void bolt_loads(const Model<Dim>& model, int threads, const State<Dim>& state, std::vector<Load<Dim>>& loads);

// adds what they stiffen each body by, at most
template <int Dim>
void add_bolt_stiffness(const Model<Dim>& model, const State<Dim>& state, std::vector<BodyStiffness>& stiffness);

// Adds a pair for each unbroken spring with a free body, with no contact (-1), and of a grouted bar one for any two of
// its stretches: between neighbours with the force at their joint, between others as if the bar were straight.
template <int Dim>
void add_bolt_pairs(const Model<Dim>& model, const State<Dim>& state, std::vector<PairStiffness<Dim>>& pairs);

}  // namespace voussoir
