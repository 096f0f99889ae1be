// The feasibility program (Boon 2013, Eqs 3.7 and 3.27):  min s  subject to  a_i·x - d_i <= s.
// s < 0: the half-spaces share an interior, and -s is the depth of x inside (the Chebyshev radius for unit normals);
// s > 0: they do not, and the multipliers prove it: sum λ_i a_i = 0, sum λ_i = 1, λ >= 0, s = -sum λ_i d_i.
#pragma once

#include <array>
#include <limits>

#include "core/geometry/half_space.hpp"

namespace voussoir {

enum class FeasibilityStatus { optimal, separated_early, unbounded, iteration_limit };

template <int Dim>
struct FeasibilityResult {
  FeasibilityStatus status = FeasibilityStatus::iteration_limit;
  double value = 0;                           // s, m; a lower bound of it when separated_early
  Vector<Dim> point = Vector<Dim>::Zero();    // x, m
  std::array<int, Dim + 1> basis{};           // the tight planes
  std::array<double, Dim + 1> multipliers{};  // their λ
  int pivots = 0;
};

template <int Dim>
struct FeasibilityRequest {
  const std::array<int, Dim + 1>* start =
      nullptr;  // planes whose normals contain 0 in their hull; null: a start is built
  // m: stop as soon as s is proven larger (the parts are separated)
  double stop_above = std::numeric_limits<double>::infinity();
  double tolerance = 0;  // m: a plane violated by no more than this counts as satisfied
};

template <int Dim>
using FeasibilitySolver = FeasibilityResult<Dim>(const HalfSpaces<Dim>&, const FeasibilityRequest<Dim>&);

}  // namespace voussoir
