// The factor of safety of a block of block theory that may turn as well as slide.
#pragma once

#include <optional>

#include "core/key_blocks/assembly.hpp"

namespace voussoir {

// The factor by which tan(friction) and cohesion of its faces may be divided while forces at their corners, within
// Coulomb's cones, hold it against the rock around it: with any pressure, and the moments of all forces balanced. An
// upper bound: joints that do not dilate may hold less. 0: it turns at any friction. Infinite: it needs none. None: the
// programs lost their digits, or nothing acts on it. Bolts act up to their capacity.
template <int Dim>
std::optional<double> factor_with_moments(const Assembly<Dim>& assembly, const Block<Dim>& block);

}  // namespace voussoir
