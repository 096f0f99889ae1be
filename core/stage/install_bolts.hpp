// Installation of bolts in the present position of the blocks.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/stage/excavation.hpp"

namespace voussoir {

// The springs of a bolt of Model::bolts installed now, from its collar on: at each transition from one block to the
// next, or, end-anchored, from its entry into the first block to its end. None if it is in one block or in none. An
// offset anchor is 1.2 diameters from the joint, or in the middle of a block in which the bolt has less than two such
// lengths. For a grouted bolt they are the joints that its bar crosses.
template <int Dim>
std::vector<BoltSpring<Dim>> springs_of(const Model<Dim>& model, const State<Dim>& state, int bolt);

// Whether an anchor is closer to its joint than intended.
template <int Dim>
bool shortened(const Model<Dim>& model, const BoltSpring<Dim>& spring);

// Whether its end is in a block.
template <int Dim>
bool ends_in_rock(const Model<Dim>& model, const State<Dim>& state, int bolt);

// The bar of a grouted bolt installed now, whose joints are its `springs`: from its entry into the first block to its
// end in the last, tightened to its pretension. Gaps between two blocks that are wider than a node spacing have no
// grout. None if it crosses no joint or nothing holds it. Throws std::invalid_argument if the grout in rock is too weak
// for the pretension.
template <int Dim>
std::optional<GroutedBolt<Dim>> bar_of(const Model<Dim>& model, const State<Dim>& state, int bolt,
                                       const std::vector<BoltSpring<Dim>>& springs);

// Adds the springs and bars of all bolts of these names to the state; returns the names of which none crosses a joint.
template <int Dim>
std::vector<std::string> install_bolts(const Model<Dim>& model, const std::vector<std::string>& names,
                                       State<Dim>& state);

// about bolts of which none crosses a joint
std::string describe_idle_bolts(const std::string& name);

// Reduces all bolts to the remaining rock after an excavation. `is_left`: whether a point in a body's frame remains,
// and then its new body and position. A spring remains if both its anchors do. A grouted bar is cut at its excavated
// nodes and joints; each piece that still crosses a joint is a bar of its own, with free ends, and a plate is removed
// with its rock.
template <int Dim>
void cut_bolts(const std::function<bool(int& body, Vector<Dim>& place)>& is_left, State<Dim>& state);

// Keeps springs and bars in parts that remain after an excavation.
template <int Dim>
void carry_bolts(const Model<Dim>& before, const Model<Dim>& model, const Excavated<Dim>& moved, State<Dim>& state);

// removes springs and bars in blocks that no longer exist
template <int Dim>
void remove_springs(const Model<Dim>& model, State<Dim>& state);

}  // namespace voussoir
