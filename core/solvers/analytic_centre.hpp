// The analytic centre (Boon 2013, Eq. 3.28):  max sum log(d_i - a_i·x), from a strictly interior start.
#pragma once

#include "core/geometry/half_space.hpp"

namespace voussoir {

enum class CentreStatus { converged, start_not_interior, iteration_limit, singular };

template <int Dim>
struct CentreResult {
  CentreStatus status = CentreStatus::iteration_limit;
  Vector<Dim> point = Vector<Dim>::Zero();  // m
  int iterations = 0;
};

template <int Dim>
struct CentreRequest {
  Vector<Dim> start;        // strictly inside, m
  double tolerance = 1e-5;  // on the Newton decrement before the last step
  int limit = 200;

  // unit: the contact's normal, if known from the step before; zero: unknown. Only Ipopt's scaling uses it
  Vector<Dim> normal = Vector<Dim>::Zero();
};

// Damped Newton from the start as origin, in axes fitted to the thin directions of the region, slacks updated
// incrementally (the thesis' 3.3.6 without its scaling factors): overlaps of 1e-12 of the size stay exact.
template <int Dim>
CentreResult<Dim> solve_analytic_centre(const HalfSpaces<Dim>& planes, const CentreRequest<Dim>& request);

template <int Dim>
using CentreSolverFunction = CentreResult<Dim>(const HalfSpaces<Dim>&, const CentreRequest<Dim>&);

}  // namespace voussoir
