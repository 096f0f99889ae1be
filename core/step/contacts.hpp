// Which candidate pairs touch, and how.
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

// some of a group of contacts that have been looked at, while they are in the cache; groups in any order and at the
// same time, the contacts of each in theirs; as many in each group as are summed together
template <int Dim>
using FoundContacts = std::function<void(int group, std::span<Contact<Dim>* const>)>;

// Point, normal, overlap and area of each candidate, each in its own slot; one that separated forgets its history.
// None has a load until its joint has answered.
// `found` is given those that touch, and some that do not.
template <int Dim>
void find_contacts(const Model<Dim>& model, const Settings& settings, BodiesState<Dim>& bodies,
                   ContactsState<Dim>& contacts, Counters& counters, const FoundContacts<Dim>& found = {});

}  // namespace voussoir
