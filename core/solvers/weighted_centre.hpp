// The analytic centre of planes of different weights: max Σ w log(d - a·x).
#pragma once

#include <span>

#include "core/solvers/analytic_centre.hpp"

namespace voussoir {

// As solve_analytic_centre, which is this with weights of 1. Weights are positive and at most 1; empty: all are 1.
template <int Dim>
CentreResult<Dim> solve_weighted_centre(const HalfSpaces<Dim>& planes, std::span<const double> weights,
                                        const CentreRequest<Dim>& request);

}  // namespace voussoir
