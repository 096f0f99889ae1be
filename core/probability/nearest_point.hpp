// The point nearest to the medians that several half-spaces call failed.
#pragma once

#include <optional>
#include <vector>

#include "core/probability/limit_state.hpp"

namespace voussoir {

double dot(const StandardPoint& a, const StandardPoint& b);
double length(const StandardPoint& a);
double distance(const StandardPoint& a, const StandardPoint& b);

struct NearestFailed {
  StandardPoint u;
  std::vector<double> pulls;  // by half-space, u = Σ pull direction; > 0: it holds u where it is
};

// Least |u| with direction·u >= distance of at most some five half-spaces: all sets of active ones are tried, each by
// its Gram matrix. None if no point lies in all of them, or if the medians do.
std::optional<NearestFailed> nearest_failed(const std::vector<FailedHalfSpace>& half_spaces);

}  // namespace voussoir
