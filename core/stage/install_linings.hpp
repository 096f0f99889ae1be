// Installation of linings against the present rock surface.
#pragma once

#include <string>
#include <vector>

#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/stage/excavation.hpp"

namespace voussoir {

// The faces of blocks against which a lining would be cast in their present position.
std::vector<LiningRock> rock_around(const Model<2>& model, const State<2>& state, const Lining& lining);

// The nodes of linings become bodies without parts, at the end of the list.
template <int Dim>
void add_lining_nodes(Model<Dim>& model, const std::vector<std::string>& names);

// Adds to the state the beams and interfaces of the linings of these names, without force; their nodes are in the
// model. Returns the names of which no node has rock opposite.
template <int Dim>
std::vector<std::string> install_linings(const Model<Dim>& model, const std::vector<std::string>& names,
                                         State<Dim>& state);

// about a lining that has no rock opposite
std::string describe_idle_lining(const std::string& name);

// number of nodes of an installed lining without rock opposite
int nodes_without_rock(const LiningState& state);

// Removes faces of excavated blocks or parts: nodes there lose them.
template <int Dim>
void release_linings(const Model<Dim>& model, State<Dim>& state);
template <int Dim>
void carry_linings(const Model<Dim>& before, const Model<Dim>& model, const Excavated<Dim>& moved, State<Dim>& state);

// The rock face opposite to half a node in the present poses: the previous one, as long as the node is within its ends,
// else the nearest, but none farther away than the length of the half.
int rock_opposite(const Lining& lining, const LiningState& lined, int half_node, const BodiesState<2>& bodies);

// a node in a block's frame, relative to the corner of its side there, m
Vector<2> seen_from_rock(const LiningRock& rock, int node_body, const BodiesState<2>& bodies);

}  // namespace voussoir
