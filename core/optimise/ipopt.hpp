// The analytic centre by Ipopt, in the thesis' slack form: the outside reference for our Newton's method. A library of
// its own (CPL/EPL), built with VOUSSOIR_WITH_IPOPT. One call at a time: its linear solver is not safe with threads.
#pragma once

#include "core/optimise/analytic_centre.hpp"

namespace voussoir {

// As solve_analytic_centre, except that `tolerance` is not used: Ipopt's own error measure is brought below 1e-10.
// A start that is not strictly inside, or not finite, gives start_not_interior; any other failure gives singular.
template <int Dim>
CentreResult<Dim> solve_analytic_centre_ipopt(const HalfSpaces<Dim>& planes, const CentreRequest<Dim>& request);

}  // namespace voussoir
