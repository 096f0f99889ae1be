// Which candidate pairs touch, and how.
#pragma once

#include <functional>
#include <span>

#include "core/base/on_threads.hpp"
#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// some of a group of contacts that have been looked at, while they are in the cache; groups in any order and at the
// same time, the contacts of each in theirs
template <int Dim>
using FoundContacts = std::function<void(int group, std::span<Contact<Dim>* const>)>;

// in each group as many as are summed together
template <int Dim>
std::size_t groups_of_contacts(const State<Dim>& state) {
  return groups_of(state.contacts.list.size());
}

// Point, normal, overlap and area of each candidate, each in its own slot; one that separated forgets its history.
// None has a load until its joint has answered.
// `found` is given those that touch, and some that do not.
template <int Dim>
void find_contacts(const Model<Dim>& model, const Settings& settings, State<Dim>& state,
                   const FoundContacts<Dim>& found = {});

}  // namespace voussoir
