// The region that two parts share, as a solid: its centroid is the contact point of codes that clip (Boon 2013, 4.7
// and 4.11).
#pragma once

#include "core/geometry/half_space.hpp"

namespace voussoir {

template <int Dim>
struct OverlapRegion {
  Vector<Dim> centroid = Vector<Dim>::Zero();  // m
  double volume = 0;                           // m³ (2-D: m², unit thickness)
};

// Clips space by the planes of both parts, seen from `inside`, any point strictly inside all of them, and stretched so
// that the region is about a ball. So, for a region of any thickness, the error of the centroid in every direction is
// 1e-12 of the extent there, and the relative error of the volume 1e-12, beyond the effect of rounding in offsets and
// normals: 4 ulp of the coordinates, which over the thickness are a fraction of it. False when `inside` is not, or when
// the region is open or thinner than its coordinates resolve.
template <int Dim>
bool overlap_region(const HalfSpaces<Dim>& planes, const Vector<Dim>& inside, OverlapRegion<Dim>& region);

}  // namespace voussoir
