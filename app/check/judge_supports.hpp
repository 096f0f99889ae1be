// Warnings about a scene's bolts and linings before a run.
#pragma once

#include <string>
#include <vector>

#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// bolts that would support nothing, end outside of all blocks, overlap others or are in the plane of a joint
template <int Dim>
void judge_bolts(const Model<Dim>& model, const State<Dim>& state, std::vector<std::string>& warnings);

// linings whose nodes are too far apart for their outline or the joints that cross it, or too close for beams
template <int Dim>
void judge_linings(const Model<Dim>& model, const State<Dim>& state, std::vector<std::string>& warnings);

}  // namespace voussoir
