// The histories of a state's joints, apart from their contacts: the part that a solver copies and restores when it
// tries motions.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/model/contacts_state.hpp"

namespace voussoir {

// of a contact
template <int Dim>
struct ContactHistory {
  int part_a = 0, part_b = 0;
  int cells = 0, divided_face = -1;
  bool bond_due = false;
  JointState<Dim> history;
};

template <int Dim>
struct JointHistories {
  std::vector<ContactHistory<Dim>> contacts;  // in the order of ContactsState::list
  std::vector<JointState<Dim>> subs;          // as many places for each contact
  std::vector<JointRise<Dim>> rises;          // likewise
};

// the places of a contact's sub-contacts
template <int Dim>
std::span<const JointState<Dim>> subs_of(const JointHistories<Dim>& histories, int contact) {
  const std::size_t stride = histories.contacts.empty() ? 0 : histories.subs.size() / histories.contacts.size();
  return std::span(histories.subs).subspan(contact * stride, stride);
}

// the places of a contact's joint, as ContactsState::rises has them
template <int Dim>
std::span<const JointRise<Dim>> rises_of(const JointHistories<Dim>& histories, int contact) {
  const std::size_t count = histories.contacts.empty() ? 0 : histories.rises.size() / histories.contacts.size();
  return std::span(histories.rises).subspan(contact * count, count);
}

template <int Dim>
JointHistories<Dim> histories_of(const ContactsState<Dim>& contacts);

// Restores them, but for those of contacts that are kept. The contacts are those of the histories, in their order. What
// a contact was when it was last found must not matter: one that has parted since is looked at again.
template <int Dim>
void set_histories(const JointHistories<Dim>& histories, ContactsState<Dim>& contacts);

// Puts them in the order of contacts that have been listed again; those that are new have none. The new places, by the
// old ones; -1: no longer listed.
template <int Dim>
std::vector<int> follow_list(const ContactsState<Dim>& contacts, JointHistories<Dim>& histories);

}  // namespace voussoir
