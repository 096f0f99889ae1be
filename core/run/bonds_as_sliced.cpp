#include "core/run/bonds_as_sliced.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/key_blocks/rock_contacts.hpp"
#include "core/step/joint_forces.hpp"

namespace voussoir {

template <int Dim>
bool has_bonds_as_sliced(const Model<Dim>& model) {
  return std::ranges::any_of(model.properties, &JointProperties::bonds_as_sliced);
}

template <int Dim>
void make_bonds_as_sliced(const Model<Dim>& model, const Settings& settings, State<Dim>& state) {
  if (!has_bonds_as_sliced(model)) return;
  std::vector<std::pair<int, int>> between;
  for (const RockContact<Dim>& contact : find_rock_contacts(model).list)
    if (contact.one_joint && contact.joint != no_joint && model.properties[contact.properties].bonds_as_sliced())
      between.emplace_back(std::minmax({contact.body_a, contact.body_b}));
  std::ranges::sort(between);
  make_bonds(model, settings, state.bodies, state.contacts, state.ledger.bonds, state.counters, &between);
}

template bool has_bonds_as_sliced<2>(const Model<2>&);
template bool has_bonds_as_sliced<3>(const Model<3>&);
template void make_bonds_as_sliced<2>(const Model<2>&, const Settings&, State<2>&);
template void make_bonds_as_sliced<3>(const Model<3>&, const Settings&, State<3>&);

}  // namespace voussoir
