// Warnings about blocks before a run: none that will move, very different sizes, blocks without support, stages that
// leave no free block, velocities that are lost.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"

namespace voussoir {

// `model` and `state` as the first stage begins, near pairs and contacts found
template <int Dim>
void judge_bodies(const Prepared<Dim>& prepared, const Model<Dim>& model, const State<Dim>& state,
                  std::vector<std::string>& warnings);

// blocks that no chain of near pairs connects to a fixed one
template <int Dim>
void judge_ties(const Model<Dim>& model, const State<Dim>& state, std::vector<std::string>& warnings);

// a stage that leaves no block to move
template <int Dim>
void judge_last_block(const Prepared<Dim>& prepared, std::vector<std::string>& warnings);

// initial velocities that the first stage sets to zero
template <int Dim>
void judge_velocities(const Prepared<Dim>& prepared, const Model<Dim>& model, std::vector<std::string>& warnings);

}  // namespace voussoir
