// Bolts put into the blocks as they stand.
#pragma once

#include <string>
#include <vector>

#include "core/model.hpp"
#include "core/state.hpp"

namespace voussoir {

// The springs of a bolt of Model::bolts installed now, from its collar on: where it passes from one block to the next,
// or, end-anchored, from where it enters the first block to its end. None where it lies in one block or in none. An
// offset anchor lies 1.2 diameters from the joint, or in the middle of a block in which the bolt has less than two such
// lengths.
template <int Dim>
std::vector<BoltSpring<Dim>> springs_of(const Model<Dim>& model, const State<Dim>& state, int bolt);

// Whether an anchor lies nearer to its joint than it should.
template <int Dim>
bool shortened(const Model<Dim>& model, const BoltSpring<Dim>& spring);

// Whether its end lies in a block.
template <int Dim>
bool ends_in_rock(const Model<Dim>& model, const State<Dim>& state, int bolt);

// Adds the springs of all bolts of these names to the state; gives the names of which none crosses a joint.
template <int Dim>
std::vector<std::string> install(const Model<Dim>& model, const std::vector<std::string>& names, State<Dim>& state);

// springs in blocks that are no longer there
template <int Dim>
void remove_springs(const Model<Dim>& model, State<Dim>& state);

}  // namespace voussoir
