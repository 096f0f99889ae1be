// Which bodies a stage that settles has moved away from those that they lay against when it began.
#pragma once

#include <string>
#include <vector>

#include "core/model/state.hpp"
#include "core/output/results.hpp"

namespace voussoir {

// two bodies that were near each other when a stage began
struct NearBodies {
  int a = 0, b = 0;      // a < b
  bool touched = false;  // then
};

template <int Dim>
struct SettleBegin {
  std::vector<Placement<Dim>> placed;  // by body
  std::vector<NearBodies> near;        // by a, then b
};

// Of a state whose contacts have been found. After true motion (`moving`) what touches has met on its way and holds
// nothing: a fall that is brought to rest leaves no contact.
template <int Dim>
SettleBegin<Dim> settle_begin(const Model<Dim>& model, const State<Dim>& state, bool moving);

// The free bodies that have moved by more than their own inscribed radius against all near bodies that have not, the
// farthest first. A body that is held or driven stays, and so does one that has moved by less against one that stays:
// blocks that settle on one another, or ride on what is driven, are none of these. Motion is that of the centroid as
// the other body's frame sees it, without the closure of their joint. `now`: its contacts have been found.
template <int Dim>
std::vector<MovedBody> moved_bodies(const Model<Dim>& model, const SettleBegin<Dim>& begin, const State<Dim>& now);

// One line on these, one at least: a body that lost every contact before others, the farthest first.
template <int Dim>
std::string moved_text(const Model<Dim>& model, const std::vector<MovedBody>& moved);

}  // namespace voussoir
