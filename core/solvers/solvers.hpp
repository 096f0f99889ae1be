// The exchangeable solvers of the two convex programs.
#pragma once

#include "core/solvers/analytic_centre.hpp"
#include "core/solvers/feasibility.hpp"

namespace voussoir {

template <int Dim>
struct Solvers {
  FeasibilitySolver<Dim>* feasibility = &solve_feasibility<Dim>;
  CentreSolverFunction<Dim>* centre = &solve_analytic_centre<Dim>;
};

}  // namespace voussoir
