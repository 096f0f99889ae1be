// The feasibility program by GLPK's simplex method: the external reference for ours. A library of its own (GPL), built
// with VOUSSOIR_WITH_GLPK.
#pragma once

#include "core/solvers/feasibility_program.hpp"

namespace voussoir {

// As solve_feasibility, with these differences: `start` and `stop_above` are not used, so the result is never
// `separated_early`; `tolerance` is not used, GLPK's own is 1e-10 of the largest offset. The basis is complete whenever
// the normals span the space, as those of a bounded part do; else its missing planes are -1 and their multipliers 0.
// Input that is not finite gives iteration_limit: GLPK would call it optimal.
template <int Dim>
FeasibilityResult<Dim> solve_feasibility_glpk(const HalfSpaces<Dim>& planes, const FeasibilityRequest<Dim>& request);

}  // namespace voussoir
