// The start of the feasibility program when no better one is known: a regular simplex of far planes that encloses
// everything, numbered -1, -2, … They are a legal basis for any input and leave it unless the program is unbounded.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/geometry/half_space.hpp"

namespace voussoir {

template <int Dim>
HalfSpace<Dim> far_plane(int k, double distance) {
  Vector<Dim> n;
  if (k < Dim)
    n = -Vector<Dim>::Unit(k);
  else
    n = Vector<Dim>::Constant(1 / std::sqrt(static_cast<double>(Dim)));
  return {n, distance};
}

template <int Dim>
HalfSpace<Dim> basis_plane(const HalfSpaces<Dim>& planes, int index, double far) {
  return index >= 0 ? planes[index] : far_plane<Dim>(-1 - index, far);
}

template <int Dim>
std::array<int, Dim + 1> far_basis() {
  std::array<int, Dim + 1> planes;
  for (int k = 0; k <= Dim; ++k)
    planes[k] = -1 - k;
  return planes;
}

// The planes' extent is the largest of their offsets. The region that they enclose is within this multiple of it:
inline constexpr double beyond_extent = 10;

// m
template <int Dim>
double reach_of(const HalfSpaces<Dim>& planes) {
  double largest = 0;
  for (const HalfSpace<Dim>& p : planes)
    largest = std::max(largest, std::abs(p.offset));
  return beyond_extent * (largest + std::numeric_limits<double>::min());
}

// and how far the far planes are, in reaches
inline constexpr double far_in_reaches = 100;

// a program is unbounded when a far plane bounds it with a larger multiplier: smaller ones are due to faces tilted by
// rounding
inline constexpr double far_multiplier = 1e-11;

}  // namespace voussoir
