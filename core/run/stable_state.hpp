// What carried the blocks where a stage last was in equilibrium (Results::at_last_stable_state).
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/output/results.hpp"
#include "core/run/bonded_contacts.hpp"

namespace voussoir {

// Notes what carries the blocks in the state of now, the last stable one of the stage so far: it replaces what the
// stage has noted before. Nothing where there is nothing to tell.
template <int Dim>
void note_stable_state(const Prepared<Dim>& scene, const Model<Dim>& model, const State<Dim>& state,
                       const BondedContacts& bonded, const StableState& at, std::vector<StableState>& noted);

// what of this stage's is doubtful, a line each
std::vector<std::string> doubts_about(const std::vector<StableState>& noted, const std::string& stage);

// Results::bonds, where a stage makes some, with a warning where none was made.
template <int Dim>
void count_all_bonds(const Prepared<Dim>& scene, const State<Dim>& state, Results& results);

// "at rest", "at the last stable state, a factor of 1.2"
std::string moment_text(const StableState& at);

// "2 of 3 bonds whole (rock: 2 of 3, 66.7 % of the bonded area)"
std::string bonds_text(const WholeBonds& bonds);

}  // namespace voussoir
