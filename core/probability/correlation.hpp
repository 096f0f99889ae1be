// Nataf's model (1962): values that are functions of correlated standard normals z = L u, u independent. The stated
// correlation is Pearson's, of the values; that of the normals follows from it, pair by pair.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/probability/distribution.hpp"

namespace voussoir {

// the correlations of the values that some correlation of the normals gives: those at -1 and at 1
struct CorrelationRange {
  double least = -1, most = 1;
};
CorrelationRange reachable_correlation(const Distribution& a, const Distribution& b);

// The correlation of the normals at which the values have `of_values`, which lies within reach. In closed form between
// normal and lognormal laws that are not cut, else by quadrature and a root, to 1e-12.
double correlation_of_normals(const Distribution& a, const Distribution& b, double of_values);

// of two keys, by their numbers
struct CorrelatedPair {
  std::size_t a = 0, b = 0;
  double of_values = 0, of_normals = 0;
};

// L, lower triangular, row by row: L Lᵀ is the correlation of the normals, 0 for pairs that are not listed. None if it
// is not positive definite.
std::optional<std::vector<std::vector<double>>> cholesky_factor(std::size_t keys,
                                                                const std::vector<CorrelatedPair>& pairs);

// Keys, ascending, whose pairs alone contradict each other, and do not once any of the keys is left out; empty: all is
// well.
std::vector<std::size_t> inconsistent_keys(std::size_t keys, const std::vector<CorrelatedPair>& pairs);

}  // namespace voussoir
