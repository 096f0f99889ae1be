// The feasibility program in twice the digits: some hundred times as slow, for the few programs of slivers and nearly
// parallel faces whose answer in double does not prove itself.
#pragma once

#include "core/optimise/feasibility_program.hpp"

namespace voussoir {

// As solve_feasibility, but never separated_early. The answer is rounded at its end only: the multipliers and the value
// are correct to the last bit or so, wherever the point lies.
template <int Dim>
FeasibilityResult<Dim> solve_feasibility_carefully(const HalfSpaces<Dim>& planes,
                                                   const FeasibilityRequest<Dim>& request);

}  // namespace voussoir
