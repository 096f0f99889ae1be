// What looks wrong with a scene's bolts and linings before anything is run, and what linings cost.
#pragma once

#include <string>
#include <vector>

#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// bolts that would hold nothing, end in the open, or lie where others or a joint do
template <int Dim>
void judge_bolts(const Model<Dim>& model, const State<Dim>& state, std::vector<std::string>& warnings);

// linings whose nodes are too far apart, for their outline or for the joints that cross it, or too near for beams
template <int Dim>
void judge_linings(const Model<Dim>& model, const State<Dim>& state, std::vector<std::string>& warnings);

// Of linings together. A chain of n beams bends in modes whose frequencies range as n² to 1: so many steps a method
// that goes by the stiffest takes until the slowest is at rest.
struct LiningCost {
  double step_limit;  // s: of the beams' stiffest mode
  double steps = 0;   // to rest, about; not by Newton's method
};

template <int Dim>
LiningCost cost_of_linings(const Model<Dim>& model, const std::vector<std::string>& names);

}  // namespace voussoir
