#include "core/model/joint_histories.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace voussoir {

template <int Dim>
JointHistories<Dim> histories_of(const ContactsState<Dim>& contacts) {
  JointHistories<Dim> histories;
  histories.contacts.reserve(contacts.list.size());
  for (const Contact<Dim>& c : contacts.list)
    histories.contacts.push_back({c.part_a, c.part_b, c.cells, c.divided_face, c.bond_due, c.history});
  histories.subs.reserve(contacts.subs.size());
  for (const SubContact<Dim>& s : contacts.subs)
    histories.subs.push_back(s.history);
  histories.rises = contacts.rises;
  return histories;
}

template <int Dim>
void set_histories(const JointHistories<Dim>& histories, ContactsState<Dim>& contacts) {
  for (std::size_t i = 0; i < histories.contacts.size(); ++i) {
    const ContactHistory<Dim>& then = histories.contacts[i];
    Contact<Dim>& c = contacts.list[i];
    if (!contacts.kept.empty() && contacts.kept[i]) continue;
    c.history = then.history;
    c.cells = then.cells;
    c.divided_face = then.divided_face;
    c.bond_due = then.bond_due;
    if (then.history.normal.isZero(0) || c.touching() || c.unanswered()) continue;
    c.status = ContactStatus::separated;
    c.near_until = c.free_until = 0;
  }
  const std::size_t stride = sub_stride(contacts);
  for (std::size_t i = 0; i < histories.subs.size(); ++i)
    if (contacts.kept.empty() || !contacts.kept[i / stride]) contacts.subs[i].history = histories.subs[i];
  contacts.rises = histories.rises;
}

template <int Dim>
std::vector<int> follow_list(const ContactsState<Dim>& contacts, JointHistories<Dim>& histories) {
  const JointHistories<Dim> old = std::move(histories);
  const std::size_t cells = old.contacts.empty() ? 0 : old.subs.size() / old.contacts.size();
  const std::size_t stride = sub_stride(contacts);
  const std::size_t rises = old.contacts.empty() ? 0 : old.rises.size() / old.contacts.size();
  histories.contacts.assign(contacts.list.size(), {});
  histories.subs.assign(contacts.subs.size(), {});
  histories.rises.assign(contacts.rises.size(), {});
  std::vector<int> places(old.contacts.size(), -1);
  std::size_t from = 0;
  for (std::size_t i = 0; i < contacts.list.size(); ++i) {  // both lists ascend
    const auto key_of = [](const auto& c) { return std::pair(c.part_a, c.part_b); };
    const std::pair key = key_of(contacts.list[i]);
    std::tie(histories.contacts[i].part_a, histories.contacts[i].part_b) = key;
    while (from < old.contacts.size() && key_of(old.contacts[from]) < key)
      ++from;
    if (from == old.contacts.size() || key_of(old.contacts[from]) != key) continue;
    histories.contacts[i] = old.contacts[from];
    for (std::size_t k = 0; k < std::min(cells, stride); ++k)
      histories.subs[i * stride + k] = old.subs[from * cells + k];
    for (std::size_t k = 0; k < rises; ++k)
      histories.rises[i * rises + k] = old.rises[from * rises + k];
    places[from] = static_cast<int>(i);
  }
  return places;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                    \
  template JointHistories<Dim> histories_of<Dim>(const ContactsState<Dim>&);         \
  template void set_histories<Dim>(const JointHistories<Dim>&, ContactsState<Dim>&); \
  template std::vector<int> follow_list<Dim>(const ContactsState<Dim>&, JointHistories<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
