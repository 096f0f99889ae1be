#include "core/model/contacts_state.hpp"

namespace voussoir {

template <int Dim>
void turn_round(const Model<Dim>& model, Contact<Dim>& c, std::span<SubContact<Dim>> subs,
                std::span<JointRise<Dim>> rises) {
  const auto reverse = [](JointState<Dim>& history) {
    history.shear_force = -history.shear_force;
    history.normal = -history.normal;
  };
  if (c.divided_face >= 0) {
    const int faces_a = static_cast<int>(model.polytope(c.part_a).faces.size()),
              faces_b = static_cast<int>(model.polytope(c.part_b).faces.size());
    c.divided_face = c.divided_face < faces_a ? faces_b + c.divided_face : c.divided_face - faces_a;
  }
  std::swap(c.part_a, c.part_b);
  std::swap(c.geometry.face_a, c.geometry.face_b);
  c.geometry.normal = -c.geometry.normal;
  c.force = -c.force;
  reverse(c.history);
  for (SubContact<Dim>& s : subs) {
    s.force = -s.force;
    reverse(s.history);
  }
  for (JointRise<Dim>& rise : rises) {
    rise.offset = -rise.offset;
    rise.normal = -rise.normal;
  }
}

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

template void turn_round<2>(const Model<2>&, Contact<2>&, std::span<SubContact<2>>, std::span<JointRise<2>>);
template void turn_round<3>(const Model<3>&, Contact<3>&, std::span<SubContact<3>>, std::span<JointRise<3>>);
template void list_by_body<2>(const Model<2>&, ContactsState<2>&);
template void list_by_body<3>(const Model<3>&, ContactsState<3>&);

}  // namespace voussoir
