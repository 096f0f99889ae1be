// How much each face of a part counts where a contact sums over faces: in the analytic centre (Eq. 3.28), the potential
// of the normal (Eqs 3.31-3.35), the barrier of the central path and the inner potential particle. There a face that is cut into facets, coplanar but
// for the rounding of a file or of its corners, would count once for each of them and draw the contact point to one
// side of the body; merging the facets within a tolerance only moves the noise at which that begins.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/polytope.hpp"

namespace voussoir {

// Faces that lean by less than this (rad) are facets of one face in part, wholly so when they are parallel. A face that
// counts double tilts a block by some overlap over its size: a tenth of the largest overlap that the kernels expect,
// the potential's radius of 0.02, over the inscribed radius keeps that below ten times the angle between the facets.
inline constexpr double leans_apart = 2e-3;

// whether some faces of the part lean by less, so that not all of them count 1
template <int Dim>
bool has_facets(const Polytope<Dim>& part);

// A face's weight is one over the sum of 1 - angle / leans_apart over the faces that lean against it by less, itself
// among them: m parallel facets count 1/m each, and weights are continuous in the planes.
template <int Dim>
void append_weights(const Polytope<Dim>& part, std::vector<double>& weights);

// of both parts' planes, those of A first; empty when every face counts 1
template <int Dim>
void facet_weights(const Polytope<Dim>& a, const Polytope<Dim>& b, std::vector<double>& weights);

// of one plane
inline double weight_of(std::span<const double> weights, std::size_t plane) {
  return weights.empty() ? 1 : weights[plane];
}

}  // namespace voussoir
