// The region that two parts share, as a solid: its centroid is the contact point of those who clip (Boon 2013, 4.7 and
// 4.11).
#pragma once

#include "core/geometry/half_space.hpp"

namespace voussoir {

template <int Dim>
struct OverlapRegion {
  Vector<Dim> centroid = Vector<Dim>::Zero();  // m
  double volume = 0;                           // m³ (2-D: m², unit thickness)
};

// Clips space by the planes of both parts, seen from `inside`, any point strictly inside all of them, and stretched so
// that the region is about a ball. So, however thin the region, in every direction the centroid is right to 1e-12 of
// its extent there, and the volume to 1e-12 of itself, beyond what the rounding of offsets and normals leaves open: 4
// ulp of the coordinates, which over the thickness are a fraction of it. False when `inside` is not, or when the region
// is open or thinner than its coordinates resolve.
template <int Dim>
bool overlap_region(const HalfSpaces<Dim>& planes, const Vector<Dim>& inside, OverlapRegion<Dim>& region);

}  // namespace voussoir
