// How much each face of a part counts if a contact sums over faces: in the analytic centre (Eq. 3.28), the potential of
// the normal (Eqs 3.31-3.35), the barrier of the central path and the inner potential particle. A face that is cut into
// facets, coplanar but for the rounding of a file or of its corners, would count once for each of them and shift the
// contact point to one side of the body; merging the facets within a tolerance only moves the noise at which that
// begins.
#pragma once

#include <vector>

#include "core/geometry/half_space.hpp"

namespace voussoir {

// Faces at an angle below this (rad) count in part as facets of one face, fully if they are parallel. A face that
// counts twice tilts a block by some overlap over its size: a tenth of the largest overlap that the kernels expect, the
// potential's radius of 0.02, over the inscribed radius keeps that below ten times the angle between the facets.
inline constexpr double leans_apart = 2e-3;

// One over the sum of 1 - angle / leans_apart over the faces at a smaller angle to it, itself included: m
// parallel facets count 1/m each, and weights are continuous in the planes. Empty: every face counts 1.
template <int Dim>
std::vector<double> facet_weights(const HalfSpaces<Dim>& faces);

}  // namespace voussoir
