// The analytic centre by Ipopt, in the thesis' slack form, Eqs 3.38 and 3.49: the external reference for our Newton's
// method. A library of its own (CPL/EPL), built with VOUSSOIR_WITH_IPOPT. One call at a time: its linear solver is not
// safe with threads.
#pragma once

#include "core/solvers/analytic_centre.hpp"

namespace voussoir {

// As solve_analytic_centre, except that `tolerance` is not used: Ipopt's own error measure is brought below 1e-10, and
// Newton's step from the result must change no slack by more than 1e-9 of it, beyond rounding; else it is solved again
// from there, at most three times. A start that is not strictly inside, or not finite, gives start_not_interior; any
// other failure gives singular. Axes and units are fitted to the region's shape as seen from the start, and slacks are
// in units of their start.
template <int Dim>
CentreResult<Dim> solve_analytic_centre_ipopt(const HalfSpaces<Dim>& planes, const CentreRequest<Dim>& request);

// The same in the thesis' scaling, Eqs 3.39-3.52: one axis along the contact normal, in units of the overlap along it
// at the start; the others in m; slacks in units of their start. Without `normal` in the request, that of the plane
// along which the region is thinnest takes its place.
template <int Dim>
CentreResult<Dim> solve_analytic_centre_ipopt_scaled(const HalfSpaces<Dim>& planes, const CentreRequest<Dim>& request);

// The same as written in Eq. 3.38: world axes, everything in m. Fails on thin overlaps; for comparison.
template <int Dim>
CentreResult<Dim> solve_analytic_centre_ipopt_unscaled(const HalfSpaces<Dim>& planes,
                                                       const CentreRequest<Dim>& request);

// Rotation that takes the last axis to the unit vector n, about the axis normal to both (Eqs 3.39-3.44); if n is
// opposite to it, half a turn about the first axis. Its last column is n.
Matrix<2> aligning_rotation(const Vector<2>& n);
Matrix<3> aligning_rotation(const Vector<3>& n);

}  // namespace voussoir
