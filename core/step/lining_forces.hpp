// What linings do to their nodes and to the rock (core/support/lining.hpp). In the plane; elsewhere there are none.
#pragma once

#include <vector>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// Answers the interface of every node at the poses of now, which must be cached; the ledger gets the energy that
// linings hold, which it must already have of contacts and bolts, and what slip and damping took.
template <int Dim>
void find_lining_forces(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

// adds what beams and interfaces do, as they were answered
template <int Dim>
void lining_loads(const Model<Dim>& model, int threads, const State<Dim>& state, std::vector<Load<Dim>>& loads);

// adds what they stiffen each body by, at most
template <int Dim>
void add_lining_stiffness(const Model<Dim>& model, const State<Dim>& state, std::vector<BodyStiffness>& stiffness);

// adds a pair for each beam and for each half node at rock, with no contact (-1); the state is that of a trial
template <int Dim>
void add_lining_pairs(const Model<Dim>& model, const Settings& settings, const State<Dim>& state,
                      std::vector<PairStiffness<Dim>>& pairs);

}  // namespace voussoir
