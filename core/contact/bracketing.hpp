// The overlap along the normal by bracketing (Boon 2013, Eq. 3.37): the reference for the closed form, Eq. 3.36.
#pragma once

#include "core/geometry/half_space.hpp"

namespace voussoir {

// As overlap_along: g(t) = max over a part's planes of a·(p + t n) - d is negative inside the part and positive
// outside; its root ahead of the point, for B behind it, ends the part. An interval around the root is halved until it
// contains no other number. False when a part does not end within 2^64 times its slack at the point, or when the point
// does not lie strictly inside both parts.
template <int Dim>
bool overlap_by_bracketing(const HalfSpaces<Dim>& planes, int faces_a, const Vector<Dim>& point,
                           const Vector<Dim>& normal, double& overlap, int& face_a, int& face_b);

}  // namespace voussoir
