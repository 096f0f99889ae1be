// How far a trial of a search may go before the static solver keeps the increment so far: slip is mapped along a chord
// from the base, on which shear locked in by settling dies away as the inverse square of the slip over the elastic
// displacement, not exponentially as on the path.
#pragma once

#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/step/static_solver_base.hpp"

namespace voussoir {

// Shortens a step to two elastic displacements of the bodies that move, or to what the trial has moved so far if that
// is longer; gives by how many times it was too long, 0 if it was not.
template <int Dim>
double shorten_in_trial(const Unknowns<Dim>& unknowns, const StaticIncrement<Dim>& increment, Eigen::VectorXd& dq);

// Whether a body has moved by `slip` elastic displacements since the base (StaticsSettings::slip), and the bodies slide
// rather than turn: if they turn, a base that moves along would cost a thousand times the evaluations.
template <int Dim>
bool has_slipped_far(const Model<Dim>& model, double slip, const Unknowns<Dim>& unknowns,
                     const StaticIncrement<Dim>& increment);

}  // namespace voussoir
