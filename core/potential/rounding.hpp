// The bounds of rounding for potential particles.
#pragma once

#include <limits>

namespace voussoir {

inline constexpr double machine_epsilon = std::numeric_limits<double>::epsilon();

// a slack's rounding as a fraction of the coordinates it is computed from: the products and sums of two rotated vectors
// lose at most 13 half-ulps
inline constexpr double placed_rounding = 8 * machine_epsilon;

}  // namespace voussoir
