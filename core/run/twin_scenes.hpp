// A scene with a little less and a little more of one of its numbers, to differentiate its run.
#pragma once

#include <string>

#include "core/model/prepared.hpp"

namespace voussoir {

// a number of the scene: the scene with less and with more of it
template <int Dim>
struct TwinScenes {
  Prepared<Dim> below, above;
  double step = 0;  // from the scene's value to either; the unit of the number
};

// Why a scene's run cannot be differentiated; empty: it can. Every stage must reach equilibrium by Newton's method; a
// search, by bisection.
template <int Dim>
std::string not_differentiable(const Prepared<Dim>& scene);

// Why two scenes have not the same blocks, faces and joints in the same order; empty: they have.
template <int Dim>
std::string not_twins(const Model<Dim>& model, const Model<Dim>& other);

}  // namespace voussoir
