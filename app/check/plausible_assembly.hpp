// What the places of the blocks say before anything is run: which nothing holds, which lie in one another, which meet
// on one point a face, after which stage none is left, which leave their water before a search counts them as failed.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"

namespace voussoir {

// a block for a warning: its name or else its number
template <int Dim>
std::string name_of(const Model<Dim>& model, int body);

// `model` and `state` as the first stage begins, near pairs and contacts found
template <int Dim>
void judge_assembly(const Prepared<Dim>& prepared, const Model<Dim>& model, const State<Dim>& state,
                    std::vector<std::string>& warnings);

}  // namespace voussoir
