// Bolts put into the blocks as they stand.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/stage/excavation.hpp"

namespace voussoir {

// The springs of a bolt of Model::bolts installed now, from its collar on: where it passes from one block to the next,
// or, end-anchored, from where it enters the first block to its end. None where it lies in one block or in none. An
// offset anchor lies 1.2 diameters from the joint, or in the middle of a block in which the bolt has less than two such
// lengths. Of a grouted bolt they are the joints that its bar crosses.
template <int Dim>
std::vector<BoltSpring<Dim>> springs_of(const Model<Dim>& model, const State<Dim>& state, int bolt);

// Whether an anchor lies nearer to its joint than it should.
template <int Dim>
bool shortened(const Model<Dim>& model, const BoltSpring<Dim>& spring);

// Whether its end lies in a block.
template <int Dim>
bool ends_in_rock(const Model<Dim>& model, const State<Dim>& state, int bolt);

// The bar of a grouted bolt installed now, whose joints are its `springs`: from where it enters the first block to
// where it ends in the last, tightened to its pretension. Air between two blocks that is wider than a node spacing has
// no grout. None where it crosses no joint or nothing holds it. Throws std::invalid_argument where the grout, as much
// of it as lies in rock, does not hold the pretension.
template <int Dim>
std::optional<GroutedBolt<Dim>> bar_of(const Model<Dim>& model, const State<Dim>& state, int bolt,
                                       const std::vector<BoltSpring<Dim>>& springs);

// Adds the springs and bars of all bolts of these names to the state; gives the names of which none crosses a joint.
template <int Dim>
std::vector<std::string> install_bolts(const Model<Dim>& model, const std::vector<std::string>& names,
                                       State<Dim>& state);

// about bolts of which none crosses a joint
std::string describe_idle_bolts(const std::string& name);

// Leaves what is left of all bolts where rock goes. `is_left`: whether a place in a body's frame is, which then takes
// the body and the place that it is now. A spring stays with both its anchors. A grouted bar is cut where its nodes or
// joints go; each piece that crosses a joint yet is a bar of its own, with free ends, and a plate goes with its rock.
template <int Dim>
void cut_bolts(const std::function<bool(int& body, Vector<Dim>& place)>& is_left, State<Dim>& state);

// Leaves what is fixed in parts that an excavation has left.
template <int Dim>
void carry_bolts(const Model<Dim>& before, const Model<Dim>& model, const Excavated<Dim>& moved, State<Dim>& state);

// springs and bars in blocks that are no longer there
template <int Dim>
void remove_springs(const Model<Dim>& model, State<Dim>& state);

}  // namespace voussoir
