// Our solver of the feasibility program.
#pragma once

#include "core/solvers/feasibility_program.hpp"

namespace voussoir {

// Dual simplex with an explicit inverse of the Dim+1 tight planes; a result that does not certify itself is computed
// again in extended (double-double) precision (extended_precision_feasibility.hpp). Normals need not be unit; zero
// normals are legal.
template <int Dim>
FeasibilityResult<Dim> solve_feasibility(const HalfSpaces<Dim>& planes, const FeasibilityRequest<Dim>& request);

// A lower bound of s that the multipliers certify by weak duality, however rounded; negative ones are left out: s >=
// -(Σ λ d + |Σ λ a| |x|) / Σ λ for all x within the reach (m). The planes count as exact.
template <int Dim>
double certified_lower_bound(const HalfSpaces<Dim>& planes, const FeasibilityResult<Dim>& result, double reach);

}  // namespace voussoir
