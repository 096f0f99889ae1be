// What looks wrong with the blocks before anything is run: none that will move, sizes far apart, blocks that nothing
// holds, stages that leave none, velocities that are lost.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"

namespace voussoir {

// `model` and `state` as the first stage begins, near pairs and contacts found
template <int Dim>
void judge_bodies(const Prepared<Dim>& prepared, const Model<Dim>& model, const State<Dim>& state,
                  std::vector<std::string>& warnings);

// blocks that no chain of near pairs ties to what is held
template <int Dim>
void judge_ties(const Model<Dim>& model, const State<Dim>& state, std::vector<std::string>& warnings);

// a stage that leaves nothing to move
template <int Dim>
void judge_last_block(const Prepared<Dim>& prepared, std::vector<std::string>& warnings);

// initial velocities that the first stage forgets
template <int Dim>
void judge_velocities(const Prepared<Dim>& prepared, const Model<Dim>& model, std::vector<std::string>& warnings);

}  // namespace voussoir
