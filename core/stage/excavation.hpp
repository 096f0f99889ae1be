// Regions taken out of a model: bodies, and parts of bodies, which keep their ids.
#pragma once

#include <string>
#include <vector>

#include "core/model/model.hpp"

namespace voussoir {

// what has become of parts and bodies
template <int Dim>
struct Excavated {
  std::vector<int> part;           // of each part as it was: its place in Model::parts now; -1: taken out
  std::vector<int> origin;         // of each body now: which body it was, or was a piece of
  std::vector<Vector<Dim>> shift;  // of each body now: how its centroid moved in its body's frame, m
};

// the part of a body that a point of its frame lies in, or nearest to
template <int Dim>
int part_at(const Body<Dim>& body, const Vector<Dim>& point);

// the body that has a part around a point of the reference configuration, model coordinates; -1: none
template <int Dim>
int body_around(const Model<Dim>& model, const Vector<Dim>& point);

// Takes out the parts whose centroids lie, where the scene has them, in one of the named regions of Model::excavations.
// A body that loses all of them, or all but parts smaller than the regions' least radius, is no longer present (a fixed
// body keeps what is left); one that loses some keeps its id, and mass, centroid and inertia are renewed. Pieces that
// no longer hang together are bodies of their own: the largest keeps the id, the others follow at the end of the list.
// Stresses and forces go on acting on what is left; a force that acted on what was taken out is gone. Names that the
// model does not know throw std::out_of_range. Taking out twice changes nothing.
template <int Dim>
Excavated<Dim> excavate(Model<Dim>& model, const std::vector<std::string>& names);

// Follows a point of a body of the model as it was, m in its frame: body and place become those of now. False, and
// nothing changed, where its part was taken out.
template <int Dim>
bool follow(const Model<Dim>& before, const Model<Dim>& model, const Excavated<Dim>& moved, int& body,
            Vector<Dim>& place);

}  // namespace voussoir
