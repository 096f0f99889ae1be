// Excavation of regions of a model: bodies, and parts of bodies, which keep their ids.
#pragma once

#include <string>
#include <vector>

#include "core/model/model.hpp"

namespace voussoir {

// the mapping of old to new parts and bodies
template <int Dim>
struct Excavated {
  std::vector<int> part;           // of each old part: its index in Model::parts now; -1: excavated
  std::vector<int> origin;         // of each new body: the old body that it was, or was a piece of
  std::vector<Vector<Dim>> shift;  // of each new body: the shift of its centroid in its body's frame, m
};

// the part of a body that contains a point of its frame, or is nearest to it
template <int Dim>
int part_at(const Body<Dim>& body, const Vector<Dim>& point);

// the body that has a part around a point of the reference configuration, model coordinates; -1: none
template <int Dim>
int body_around(const Model<Dim>& model, const Vector<Dim>& point);

// Excavates the parts whose centroids, in the reference configuration, are in one of the named regions of
// Model::excavations. A body that loses all its parts, or all except parts smaller than the regions' least radius, is
// no longer present (a fixed body keeps small parts); one that loses some keeps its id, and mass, centroid and inertia
// are renewed. Pieces that are no longer connected are bodies of their own: the largest keeps the id, the others follow
// at the end of the list. Stresses and forces on the remaining rock continue to act; forces on excavated parts end.
// Unknown names throw std::out_of_range. A second excavation of the same region changes nothing.
template <int Dim>
Excavated<Dim> excavate(Model<Dim>& model, const std::vector<std::string>& names);

// Maps a point of an old body, m in its frame, to the new body and frame. False, and nothing changed, if its part was
// excavated.
template <int Dim>
bool follow(const Model<Dim>& before, const Model<Dim>& model, const Excavated<Dim>& moved, int& body,
            Vector<Dim>& place);

}  // namespace voussoir
