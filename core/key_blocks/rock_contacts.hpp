// The areas in which blocks touch along faces, from the planes that cut them: no overlap, no stiffness, no time.
#pragma once

#include <span>
#include <vector>

#include "core/model/model.hpp"

namespace voussoir {

template <int Dim>
struct RockContact {
  int body_a = 0, body_b = 0;
  Vector<Dim> normal;                          // unit, from a to b
  int joint = no_joint;                        // of the two faces' joints the later cut, as in a contact of a run
  int properties = 0;                          // Model::properties
  bool one_joint = true;                       // both faces are of this joint: a stated cohesion acts
  double area = 0;                             // m² (2-D: m)
  Vector<Dim> centroid = Vector<Dim>::Zero();  // m, model coordinates
  int first_corner = 0, corners = 0;           // in RockContacts::corners
};

template <int Dim>
struct RockContacts {
  std::vector<RockContact<Dim>> list;
  std::vector<Vector<Dim>> corners;  // m, model coordinates, in order around each contact
  std::vector<int> first;            // by body and one more: its first place in `of_bodies`
  std::vector<int> of_bodies;        // contacts by body
  std::vector<double> surface;       // by body: area of its outer faces, m² (2-D: m)

  std::span<const int> of(int body) const {
    return {of_bodies.data() + first[body], static_cast<std::size_t>(first[body + 1] - first[body])};
  }
  std::span<const Vector<Dim>> corners_of(const RockContact<Dim>& contact) const {
    return {corners.data() + contact.first_corner, static_cast<std::size_t>(contact.corners)};
  }
};

// Every area in which faces of two present bodies touch in the reference configuration. Faces match by the joint that
// made them, else by plane: faces of no joint, and joints of one plane, within 1e-6 of the smallest block. Areas below
// 1e-9 of the smaller face's box are none, nor are edges and corners. Faces between the parts of one body are no
// contact and no part of its surface.
template <int Dim>
RockContacts<Dim> find_rock_contacts(const Model<Dim>& model);

}  // namespace voussoir
