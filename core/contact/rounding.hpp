// The bounds of rounding in the kernels.
#pragma once

#include <limits>

namespace voussoir {

// a slack's rounding as a fraction of the coordinates it was computed from: the products and sums of two rotated
// vectors lose at most 13 half-ulps
inline constexpr double slack_rounding = 4 * std::numeric_limits<double>::epsilon();

// a number multiplied by this is a lower bound of its value without its few roundings
inline constexpr double downwards = 1 - 8 * std::numeric_limits<double>::epsilon();

// gradients that differ by less give no direction
inline constexpr double parallel_gradients = 1e-6;

}  // namespace voussoir
