// Sub-contacts: several points that carry one joint, each with its own history. Half-spaces know no faces to cut up, so
// what is divided is the contact itself: the section of the overlap region by the contact plane, along the cells of a
// grid that is fixed to one of the two faces. A point is where the resultant of its cell acts: the overlap is linear
// between two faces, so that mean overlap and pressure centre of a cell are exact, and with them the normal force and
// its moment however few the cells are. What converges with their number is shear, slip and spin.
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
// smaller of the two faces is divided, the first part's where they are equal. Cells that do not touch have no area and
// forget their history; where another face is divided than the step before, the cells share what shear force there was
// by their areas. Needs contact.geometry and contact.proof of this step.
template <int Dim>
void divide(const Pair<Dim>& pair, int along, Contact<Dim>& contact, std::span<SubContact<Dim>> subs);

}  // namespace voussoir
