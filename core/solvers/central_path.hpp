// A point on the central path of the feasibility program (feasibility_program.hpp), by its logarithmic barrier:
//   min over x and s of  s - µ Σ w_i log(s + d_i - a_i·x).
// Its multipliers λ_i = µ w_i / (s + d_i - a_i·x) satisfy those of the program, Σ λ_i a_i = 0 and Σ λ_i = 1, but are
// smooth in the planes, as its value and its point are; for µ -> 0 all tend to those of the program (Boyd and
// Vandenberghe 2004, 11.2). When a plane moves, the value changes by λ_i times the plane's displacement at x.
#pragma once

#include <span>

#include "core/geometry/half_space.hpp"

namespace voussoir {

enum class CentralPathStatus { converged, iteration_limit, singular };

template <int Dim>
struct CentralPathResult {
  CentralPathStatus status = CentralPathStatus::iteration_limit;
  Vector<Dim> point = Vector<Dim>::Zero();  // x, m
  double bound = 0;                         // s, m
  int iterations = 0;
};

template <int Dim>
struct CentralPathRequest {
  Vector<Dim> start;        // anywhere, m; near the point is faster
  double weight = 0;        // µ, m
  double tolerance = 1e-5;  // on the Newton decrement before the last step
  int limit = 200;
  std::span<const double> weights = {};  // of each plane's logarithm, positive and at most 1; empty: all are 1
};

// Damped Newton in x and s. Normals need not be unit, but must positively span space.
template <int Dim>
CentralPathResult<Dim> follow_central_path(const HalfSpaces<Dim>& planes, const CentralPathRequest<Dim>& request);

}  // namespace voussoir
