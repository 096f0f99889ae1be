// The factor of safety of a block on joints whose cohesion the first slip takes: it depends on how stiffness shares the
// load among them.
//
// The elastic displacement d under the load R is that of Σ A [kn n nᵀ + ks (1 - n nᵀ)] d = R; the joint with the least
// (c A + N tan φ)/T slips first. The block stands up to the factor of that slip or of friction alone, whichever is
// larger, and further if one joint carries what the other loses (reference/key_blocks/shared_cohesion).
#pragma once

#include <optional>
#include <vector>

#include "core/key_blocks/verdict.hpp"

namespace voussoir {

// Of a factor that divides the strength of these joint properties. Nothing if the closed form does not apply: the block
// does not slide, has bolts, rests on joints that are not divided, without cohesion or with another law of it, or
// elastic shear closes another face.
template <int Dim>
std::optional<double> brittle_factor(const Assembly<Dim>& assembly, const Block<Dim>& block,
                                     const BoltedVerdict<Dim>& bolted, const std::vector<int>& divided);

}  // namespace voussoir
