// Contacts among the candidate pairs.
#pragma once

#include <functional>
#include <span>

#include "core/base/on_threads.hpp"
#include "core/base/settings.hpp"
#include "core/model/bodies_state.hpp"
#include "core/model/contacts_state.hpp"
#include "core/model/ledger.hpp"
#include "core/model/model.hpp"

namespace voussoir {

// part of a group of examined contacts, while they are in the cache; groups run in any order and in parallel, the
// contacts of each in order; a group has as many as are summed together
template <int Dim>
using FoundContacts = std::function<void(int group, std::span<Contact<Dim>* const>)>;

// Point, normal, overlap and area of each candidate, each in its own slot; a separated one loses its history. None has
// a load until its joint force is computed. `found` receives those that touch, and some that do not. `seconds`: of the
// last step, over which joints that dilate rise.
template <int Dim>
void find_contacts(const Model<Dim>& model, const Settings& settings, double seconds, BodiesState<Dim>& bodies,
                   ContactsState<Dim>& contacts, Counters& counters, const FoundContacts<Dim>& found = {});

}  // namespace voussoir
