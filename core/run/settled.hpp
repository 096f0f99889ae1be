// Bodies that a stage has moved away from those that they were in contact with at its start.
#pragma once

#include <string>
#include <vector>

#include "core/model/state.hpp"
#include "core/output/results.hpp"

namespace voussoir {

// two bodies that were near each other when a stage began
struct NearBodies {
  int a = 0, b = 0;      // a < b
  bool touched = false;  // at that time
};

template <int Dim>
struct SettleBegin {
  std::vector<Placement<Dim>> placed;  // by body
  std::vector<NearBodies> near;        // by a, then b
  ContactsState<Dim> contacts = {};    // those that touched, without sub-contacts
};

// Of a state whose contacts have been found. After true motion (`moving`) touching bodies have met during the motion
// and support nothing: a fall that is stopped does not count as losing contact.
template <int Dim>
SettleBegin<Dim> settle_begin(const Model<Dim>& model, const State<Dim>& state, bool moving);

// The free bodies that have moved by more than `failure_fraction_of_radius` of their own inscribed radius, by which a
// search calls a trial failed, relative to all near bodies that have not, the farthest first. A held or driven body
// counts as staying, and so does one that has moved by less relative to one that stays: blocks that settle on one
// another, or ride on a driven body, are not among them. Motion is that of the centroid in the other body's frame,
// without the closure of their joint. `now`: its contacts have been found.
template <int Dim>
std::vector<MovedBody> moved_bodies(const Model<Dim>& model, const SettleBegin<Dim>& begin, const State<Dim>& now);

// One line on these, at least one: bodies that lost every contact first, then the farthest.
template <int Dim>
std::string moved_text(const Model<Dim>& model, const std::vector<MovedBody>& moved);

}  // namespace voussoir
