// Forces of linings on their nodes and on the rock (core/support/lining.hpp): the entries of their row in
// support_table.hpp. In 2-D; in 3-D there are none.
#pragma once

#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/load_row.hpp"
#include "core/step/support_questions.hpp"

namespace voussoir {

template <int Dim>
bool has_linings(const Model<Dim>& model, const LoadInputs<Dim>& now);

// of beams and of the interface of every node
template <int Dim>
void find_lining_forces(const Model<Dim>& model, const Schedule& schedule, const JointStep& last,
                        const BodiesState<Dim>& bodies, SupportsState<Dim>& supports, Ledger& ledger,
                        Counters& counters);

template <int Dim>
void lining_loads(const Model<Dim>& model, int threads, const LoadInputs<Dim>& now, std::vector<Load<Dim>>& loads);

template <int Dim>
void add_lining_stiffness(const Model<Dim>& model, const LoadInputs<Dim>& now, std::vector<BodyStiffness>& stiffness);

// a pair for each beam and for each half node at rock
template <int Dim>
void add_lining_pairs(const Model<Dim>& model, const Settings& settings, const State<Dim>& state,
                      std::vector<PairStiffness<Dim>>& pairs);

// of interfaces
template <int Dim>
void add_interface_forces(const SupportsState<Dim>& supports, ForcesAtRest& sums);

// the nodes of a lining, and the blocks whose faces it was cast against
template <int Dim>
void tie_linings(const Model<Dim>& model, const SupportsState<Dim>& supports, const TwoBodies& tie);

// each node with the block opposite
template <int Dim>
void tell_touching_nodes(const Model<Dim>& model, const SupportsState<Dim>& supports, const TwoBodies& tell);

// A node has no face: its beams and its interface.
template <int Dim>
void scale_nodes(const Model<Dim>& model, const std::vector<int>& place, Eigen::VectorXd& scale);

// a lining that had rock opposite and does not touch any now
template <int Dim>
std::string loose_lining(const Model<Dim>& model, const SupportsState<Dim>& supports);

}  // namespace voussoir
