#include "core/run/bonded_contacts.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace voussoir {
namespace {

// of the bonds of a contact that are not lost
template <int Dim>
double bonded_area(const Model<Dim>& model, const State<Dim>& state, std::size_t place) {
  const Contact<Dim>& c = state.contacts.list[place];
  if (c.cells == 0) {
    if (c.history.bond == Bond::lost) return 0;
    if (model.properties[c.properties].constant_stiffness) return 1;
    return c.history.area > 0 ? c.history.area : c.geometry.area;  // it has no history before its first force
  }
  double area = 0;
  for (const SubContact<Dim>& s : subs_of(state.contacts, place))
    if (s.area > 0 && s.history.bond != Bond::lost) area += s.area;
  return area;
}

bool is_before(const BondedContact& a, const BondedContact& b) {
  return std::tie(a.part_a, a.part_b) < std::tie(b.part_a, b.part_b);
}

BondedContact& remembered(int part_a, int part_b, std::vector<BondedContact>& all) {
  const BondedContact sought{.part_a = part_a, .part_b = part_b};
  auto place = std::ranges::lower_bound(all, sought, is_before);
  if (place == all.end() || is_before(sought, *place)) place = all.insert(place, sought);
  return *place;
}

}  // namespace

template <int Dim>
void remember_bonds(const Model<Dim>& model, const State<Dim>& state, BondedContacts& bonded) {
  bonded.made = state.ledger.bonds.made;
  if (bonded.made == 0) return;
  for (std::size_t i = 0; i < state.contacts.list.size(); ++i) {
    const Contact<Dim>& c = state.contacts.list[i];
    const long long held = bonds_of(state.contacts, i).held();
    if (held == 0) continue;
    BondedContact& contact = remembered(c.part_a, c.part_b, bonded.contacts);
    if (held < contact.bonds) continue;
    contact.joint = c.joint;
    contact.bonds = held;
    contact.area = bonded_area(model, state, i);
  }
}

template <int Dim>
void carry(const Excavated<Dim>& moved, BondedContacts& bonded) {
  for (BondedContact& contact : bonded.contacts)
    std::tie(contact.part_a, contact.part_b) =
        std::tuple(std::minmax({moved.part[contact.part_a], moved.part[contact.part_b]}));
  std::erase_if(bonded.contacts, [](const BondedContact& contact) { return contact.part_a < 0; });
  std::ranges::sort(bonded.contacts, is_before);
}

template <int Dim>
std::vector<JointBonds> bonds_by_joint(const Model<Dim>& model, const State<Dim>& state, const BondedContacts& bonded) {
  std::map<int, JointBonds> by_joint;
  for (const BondedContact& contact : bonded.contacts) {
    if (!model.bodies[model.parts[contact.part_a].body].present ||
        !model.bodies[model.parts[contact.part_b].body].present)
      continue;
    JointBonds& bonds = by_joint[contact.joint];
    bonds.made += contact.bonds;
    bonds.made_area += contact.area;
    const auto pair = [](const Contact<Dim>& c) { return std::pair(c.part_a, c.part_b); };
    const auto found =
        std::ranges::lower_bound(state.contacts.list, std::pair(contact.part_a, contact.part_b), {}, pair);
    if (found == state.contacts.list.end() || pair(*found) != std::pair(contact.part_a, contact.part_b)) continue;
    const auto place = static_cast<std::size_t>(found - state.contacts.list.begin());
    const Bonds now = bonds_of(state.contacts, place);
    bonds.whole += now.whole;
    bonds.slipped += now.slipped;
    bonds.held_area += bonded_area(model, state, place);
  }
  std::vector<JointBonds> all;
  for (auto& [joint, bonds] : by_joint) {
    bonds.joint = joint;
    all.push_back(bonds);
  }
  return all;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                           \
  template void remember_bonds<Dim>(const Model<Dim>&, const State<Dim>&, BondedContacts&); \
  template void carry<Dim>(const Excavated<Dim>&, BondedContacts&);                         \
  template std::vector<JointBonds> bonds_by_joint<Dim>(const Model<Dim>&, const State<Dim>&, const BondedContacts&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
