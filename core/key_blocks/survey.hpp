// Verdicts of a mass: every block with its neighbours held, clusters of blocks that move as one, successive failure.
#pragma once

#include <functional>

#include "core/key_blocks/verdict.hpp"

namespace voussoir {

// what acts on a block besides its own loads, as an earthquake; empty: nothing
template <int Dim>
using FurtherLoad = std::function<Vector<Dim>(const Block<Dim>&)>;

// Of every body, by body; of fixed and absent ones `undecided`, without a factor.
template <int Dim>
std::vector<BoltedVerdict<Dim>> judge_all(const Assembly<Dim>& assembly, const FurtherLoad<Dim>& more);

template <int Dim>
struct Cluster {
  std::vector<int> bodies;  // ascending
  BoltedVerdict<Dim> verdict;
};

template <int Dim>
struct ClusterSearch {
  long pairs = 0, moving_pairs = 0;  // of free neighbours
  std::size_t largest = 2;           // blocks in the largest cluster looked at
  std::vector<Cluster<Dim>> lower;   // that move with a lower factor than any of their blocks; ascending factor
};

// All pairs of free neighbours as one body; from each that is lower than its blocks, clusters of up to `most` blocks
// are grown by the neighbour that gives the lowest factor, while it falls. A larger cluster may be lower still.
template <int Dim>
ClusterSearch<Dim> find_clusters(const Assembly<Dim>& assembly, const std::vector<BoltedVerdict<Dim>>& single,
                                 const FurtherLoad<Dim>& more, std::size_t most = 8);

enum class FailureRule {
  below_factor,  // the factor is below the stated one
  moves          // the block moves without friction
};

struct SuccessiveFailure {
  std::vector<std::vector<int>> rounds;  // the blocks of each round, ascending
  std::vector<double> volumes;           // m³, by round
  std::vector<int> round_of;             // by body, from 1; 0: it stays
};

// Removes all blocks that fail, judges the neighbours of these again, and so on. A round is judged completely before it
// is removed.
template <int Dim>
SuccessiveFailure fail_in_rounds(const Assembly<Dim>& assembly, FailureRule rule, double factor,
                                 const FurtherLoad<Dim>& more);

}  // namespace voussoir
