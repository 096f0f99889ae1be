// Candidate pairs of parts: those that touch have the history of their joint.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/contact/contact.hpp"
#include "core/contact/integrated_contact.hpp"
#include "core/geometry/types.hpp"
#include "core/joint_laws/joint_rise.hpp"
#include "core/model/model.hpp"

namespace voussoir {

// The contacts of each body in their order: those of body b are in `places` from first[b] up to first[b + 1].
struct ContactsByBody {
  std::vector<int> first, places;
};

// The load of a contact on its bodies, apart from its other data: bodies read loads in another order than that of the
// contacts.
template <int Dim>
struct ContactLoad {
  int second = -1;                             // the second body; -1: they do not touch
  Vector<Dim> force = Vector<Dim>::Zero();     // N on the second body
  Spin<Dim> about_first = Spin<Dim>::Zero();   // N m: this force's moment about the first body's centroid
  Spin<Dim> about_second = Spin<Dim>::Zero();  // N m: about its own
};

template <int Dim>
struct ContactsState {
  std::vector<Contact<Dim>> list;     // candidate pairs by (part a, part b); those that touch have a history
  std::vector<SubContact<Dim>> subs;  // as many places for each contact, in their order; none if no joint has any
  std::vector<JointRise<Dim>> rises;  // of each contact, or of each of its sub-contacts; none if no joint remembers
                                      // its place
  std::vector<IntegratedContact<Dim>> faces;  // by contact, of the integrated ones; none if no joint is
  ContactsByBody by_body;                     // places in `list`; rebuilt with it
  std::vector<ContactLoad<Dim>> loads;        // by contact
  std::vector<char> kept;  // by contact: that it is not found again in the next step, nor its force, since its bodies
                           // and its history are those of the last; cleared by that step; empty: none
};

// the places of a contact's sub-contacts among those of all contacts
template <int Dim>
std::size_t sub_stride(const ContactsState<Dim>& contacts) {
  return contacts.list.empty() ? 0 : contacts.subs.size() / contacts.list.size();
}

// The sub-contacts of a contact, none if its force acts at its own point; `place` counts in ContactsState::list.
template <class AnyContacts>
auto subs_of(AnyContacts& contacts, std::size_t place) {
  const std::size_t stride = sub_stride(contacts);
  return std::span(contacts.subs).subspan(place * stride, std::min<std::size_t>(stride, contacts.list[place].cells));
}

// The places of a contact's joint, one for its own point or for each of its sub-contacts; none if no joint has any.
template <class AnyContacts>
auto rises_of(AnyContacts& contacts, std::size_t place) {
  const std::size_t count = contacts.rises.empty() ? 0 : contacts.rises.size() / contacts.list.size();
  return std::span(contacts.rises).subspan(place * count, count);
}

// the highest of a contact's points; none if it has not risen
template <int Dim>
const JointRise<Dim>* highest(std::span<const JointRise<Dim>> rises) {
  if (rises.empty()) [[likely]]
    return nullptr;
  const JointRise<Dim>& most = *std::ranges::max_element(rises, {}, &JointRise<Dim>::rise);
  return most.rise > 0 ? &most : nullptr;
}

struct Bonds {
  long long whole = 0, slipped = 0;

  long long held() const { return whole + slipped; }  // those that are not lost
};

// those of a contact: its own, or those of its sub-contacts
template <int Dim>
Bonds bonds_of(const ContactsState<Dim>& contacts, std::size_t place) {
  Bonds bonds;
  const auto count = [&](Bond state) {
    bonds.whole += state == Bond::whole;
    bonds.slipped += state == Bond::slipped;
  };
  const Contact<Dim>& c = contacts.list[place];
  if (c.cells == 0) count(c.history.bond);
  for (const SubContact<Dim>& s : subs_of(contacts, place))
    if (s.area > 0) count(s.history.bond);
  return bonds;
}

// of all contacts
template <int Dim>
Bonds bonds_of(const ContactsState<Dim>& contacts) {
  Bonds all;
  for (std::size_t i = 0; i < contacts.list.size(); ++i) {
    const Bonds bonds = bonds_of(contacts, i);
    all.whole += bonds.whole;
    all.slipped += bonds.slipped;
  }
  return all;
}

// the places of a body's contacts in ContactsState::list
template <int Dim>
std::span<const int> contacts_of(const ContactsState<Dim>& contacts, int body) {
  const auto& [first, places] = contacts.by_body;
  if (first.empty()) return {};  // no candidates have been listed
  return std::span(places).subspan(first[body], first[body + 1] - first[body]);
}

// A contact seen from its other body; points stay relative to the one that was first.
template <int Dim>
void turn_round(const Model<Dim>& model, Contact<Dim>& c, std::span<SubContact<Dim>> subs,
                std::span<JointRise<Dim>> rises);

// ContactsState::by_body from its list
template <int Dim>
void list_by_body(const Model<Dim>& model, ContactsState<Dim>& contacts);

}  // namespace voussoir
