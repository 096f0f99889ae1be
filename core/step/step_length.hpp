// How long a step of Newton's method on the joints may be.
#pragma once

#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/step/static_solver_base.hpp"

namespace voussoir {

// Shortens a step so that no body moves or turns against its neighbours by more than a small fraction of its size, for
// beyond it contacts have another geometry. Where few of many bodies are loose, they alone are held back. Returns how
// many times as long it would have been.
template <int Dim>
double shorten(const Model<Dim>& model, const Unknowns<Dim>& unknowns, const State<Dim>& state, Eigen::VectorXd& dq);

}  // namespace voussoir
