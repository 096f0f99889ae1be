// The feasibility program in extended (double-double) precision: some hundred times as slow, for the few programs of
// slivers and nearly parallel faces whose result in double precision does not certify itself.
#pragma once

#include "core/solvers/feasibility_program.hpp"

namespace voussoir {

// As solve_feasibility, but never separated_early. The result is rounded only at the end: the multipliers and the value
// are correct to the last bit or so, wherever the point is.
template <int Dim>
FeasibilityResult<Dim> solve_feasibility_in_extended_precision(const HalfSpaces<Dim>& planes,
                                                               const FeasibilityRequest<Dim>& request);

}  // namespace voussoir
