#include "core/model/contacts_state.hpp"

namespace voussoir {

template <int Dim>
void list_by_body(const Model<Dim>& model, ContactsState<Dim>& contacts) {
  std::vector<int>&first = contacts.by_body.first, &places = contacts.by_body.places;
  first.assign(model.bodies.size() + 1, 0);
  places.resize(2 * contacts.list.size());
  const auto each = [&](const auto& visit) {
    for (std::size_t i = contacts.list.size(); i-- > 0;)
      for (const int part : {contacts.list[i].part_a, contacts.list[i].part_b})
        visit(model.parts[part].body, static_cast<int>(i));
  };
  // the end of each body's range, lowered to its begin as contacts are filled in from the last to the first
  each([&](int body, int) { ++first[body]; });
  for (std::size_t b = 0; b + 1 < first.size(); ++b)
    first[b + 1] += first[b];
  each([&](int body, int place) { places[--first[body]] = place; });
}

template void list_by_body<2>(const Model<2>&, ContactsState<2>&);
template void list_by_body<3>(const Model<3>&, ContactsState<3>&);

}  // namespace voussoir
