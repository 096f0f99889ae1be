// Whether a block that slides can do so without turning.
#pragma once

#include <optional>

#include "core/key_blocks/verdict.hpp"

namespace voussoir {

// κ: how far out the pressure on the loaded faces must be for the moments of pure sliding to balance, as a fraction of
// the way from the faces' centroids to their edge. At 1 the pressure is at the edge, above 1 the block must turn.
// Infinite: no pressure on the loaded faces balances the moments, as that of a twist. In the limit state every shear
// force points against the motion, so that with f_i = n_i - (tan φ_i/F) v/|v|, c_i the centroid of face i, p its
// corners, M the moment of all other forces about the block's centroid x
//
//   minimise κ:  Σ_i [ N_i (c_i - x) × f_i + Σ_p μ_ip (p - c_i) × f_i ] + M = 0,   Σ_p μ_ip <= κ N_i,   μ >= 0     (2)
//
// Its dual, the largest w·m with w·z <= 1 for the corners z of the moments that the faces can give, is solved as a
// feasibility program. None for blocks that do not slide or have no strength.
template <int Dim>
std::optional<double> pressure_eccentricity(const Assembly<Dim>& assembly, const Block<Dim>& block,
                                            const BoltedVerdict<Dim>& bolted);

}  // namespace voussoir
