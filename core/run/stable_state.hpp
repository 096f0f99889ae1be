// The bonds and supports that held the blocks when a stage was last in equilibrium (Results::at_last_stable_state).
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/output/results.hpp"
#include "core/run/bonded_contacts.hpp"

namespace voussoir {

// Records them for the present state, the last stable one of the stage so far, in place of the stage's earlier record.
// Nothing if there are none and
// the stage is no search.
template <int Dim>
void note_stable_state(const Prepared<Dim>& scene, const Model<Dim>& model, const State<Dim>& state,
                       const BondedContacts& bonded, const StableState& at, std::vector<StableState>& noted);

// doubtful results of this stage, one line each
std::vector<std::string> doubts_about(const std::vector<StableState>& noted, const std::string& stage);

// Results::bonds and cohesion, if some are to be made, with a warning if none was made.
template <int Dim>
void count_all_bonds(const Prepared<Dim>& scene, const State<Dim>& state, Results& results);

// "in equilibrium", "at the last stable state, a factor of 1.2"
std::string moment_text(const StableState& at);

// Of a search: how far its trials moved and turned, what an extrapolation took out, why it was not used; a line each.
std::vector<std::string> search_text(const StableState& at);

// what slip does to the cohesion of these joint properties, and where it acts
std::string cohesion_text(const JointProperties& properties);

// "2 of 3 bonds intact (rock: 2 of 3, 66.7 % of the bonded area)"
std::string bonds_text(const WholeBonds& bonds);

}  // namespace voussoir
