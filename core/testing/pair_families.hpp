// Pairs of blocks by number, for the tests of the contact kernel: the difficult families L1, L2, L4-L7 and L10 of the
// catalogue of extremes, in space and in the plane. A seed and a number name the same pair in any process.
#pragma once

#include <cstdint>
#include <string>

#include "core/geometry/polytope.hpp"

namespace voussoir::families {

// a pair as the kernel gets it, and the same pair after a small move
template <int Dim>
struct Case {
  std::string family;
  Polytope<Dim> a, b;
  Matrix<Dim> rotation, rotation_after;  // frame of the second body -> frame of the first
  Vector<Dim> offset, offset_after;      // centroid of the second body in the frame of the first, m
};

// Gaps and overlaps are 0 and 10^-17 .. 1 of the smaller inscribed radius, set after every rounding of the pose.
template <int Dim>
Case<Dim> numbered_case(std::uint64_t seed, long long number);

// The two parts and poses as C++ literals, to paste into a test.
template <int Dim>
std::string literals(const Case<Dim>& c);

}  // namespace voussoir::families
