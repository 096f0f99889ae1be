// What looks wrong with a scene's bolts and linings before anything is run.
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

}  // namespace voussoir
