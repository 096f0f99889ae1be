// The bound of a step of the implicit static solver.
#pragma once

#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/step/static_solver_base.hpp"

namespace voussoir {

// Shortens a step so that no body moves or rotates relative to its neighbours by more than a small fraction of its
// size, because beyond it contacts have another geometry. If few of many bodies are loose, only their steps are
// shortened. Returns the ratio of the original to the new length.
template <int Dim>
double shorten(const Model<Dim>& model, const Unknowns<Dim>& unknowns, const State<Dim>& state, Eigen::VectorXd& dq);

}  // namespace voussoir
