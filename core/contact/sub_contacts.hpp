// Sub-contacts: several contact points of one joint, each with its own history. Half-spaces have no faces to divide, so
// the contact itself is divided: the section of the overlap region by the contact plane, along the cells of a grid that
// is fixed to one of the two faces. A point is the place of the resultant of its cell: the overlap is linear between
// two faces, so that mean overlap and pressure centre of a cell are exact, and with them the normal force and its
// moment for any number of cells. Shear, slip and spin converge with their number.
#pragma once

#include <span>

#include "core/contact/contact.hpp"
#include "core/contact/pair.hpp"

namespace voussoir {

// sub-contacts of a face that is divided into `along` cells along each of its directions
template <int Dim>
constexpr int sub_contact_count(int along) {
  return along <= 1 ? 0 : Dim == 2 ? along : along * along;
}

// Fills the sub-contacts of a touching pair that is resolved to QueryLevel::area: point, overlap, spread and area. The
// smaller of the two faces is divided, the first part's if they are equal. Cells that do not touch have no area and
// lose their history; if another face is divided than in the step before, the cells share the old shear force by their
// areas. Needs contact.geometry and contact.proof of this step.
template <int Dim>
void divide(const Pair<Dim>& pair, int along, Contact<Dim>& contact, std::span<SubContact<Dim>> subs);

}  // namespace voussoir
