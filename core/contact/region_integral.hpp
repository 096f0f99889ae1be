// The overlap of two parts of any shape, corners and edges included, as a spring with a potential. The depth of a point
// of the overlap is the least of its distances to all planes of both parts,
//
//   phi(x) = min_i (d_i - a_i·x),   E = 2 k ∫ phi dV   over where phi >= 0,
//
// with k in Pa/m. Between two parallel faces phi is u/2 half way, and E is ½ k ∫ u² dA, that of the contact polygon
// (face_integral.hpp) but for a strip as wide as the overlap along its edges. No normal is chosen: a plane of the
// second part that moves takes along the points for which it is the nearest, so that by the divergence theorem force
// and moment on the second part are
//
//   F = 2 k ∫ phi n dS,   M = 2 k ∫ phi x × n dS
//
// over the surface of points as far from the nearest plane of one part as from that of the other, n its normal
// from the first part to the second: the exact derivative of E in every motion, as long as no two of the planes
// coincide. Phi and the region together are the polytope {(x, t): a_i·x + t <= d_i, t >= 0} of one more dimension, E is
// 2 k times its volume, the surface is the set where two of its facets of different parts meet.
#pragma once

#include <span>

#include "core/geometry/half_space.hpp"

namespace voussoir {

template <int Dim>
struct RegionIntegral {
  double square = 0;                           // 4 ∫ phi dV, m^(Dim + 1): E is half of it, times k
  Vector<Dim> force = Vector<Dim>::Zero();     // over k, m^Dim
  Spin<Dim> moment = Spin<Dim>::Zero();        // over k, about the origin of the planes, m^(Dim + 1)
  Vector<Dim> pressure = Vector<Dim>::Zero();  // ∫ phi x dS / ∫ phi dS, m
  double area = 0;    // |∫ n dS|: the surface seen along the mean of its normals, m^(Dim - 1)
  double spread = 0;  // m²: largest distance, squared, of the surface from `pressure`
};

enum class RegionStatus { ok, empty, too_many_planes };

// Integrates over the overlap. `planes`: of both parts, the first `faces_a` the first one's, seen from a point in the
// overlap; `reach`, m: no point of the overlap is farther from there along any axis. Empty if there is no overlap with
// a volume; at most 58 planes may bound it. The error of corners is 1e-11 of the region's extent, and the relative
// error of all else that, times the extent over the thickness; moment and place relative to the extent.
template <int Dim>
RegionStatus integrate_region(const HalfSpaces<Dim>& planes, int faces_a, double reach, RegionIntegral<Dim>& region);

// The integrals over the region of `planes` after each of a few small motions, to first order: `moved[k]` are the same
// planes after motion k. The region is cut once, then its corners follow the planes that meet there. Without `energy`,
// `square` has no meaning. False where a corner lies on more planes than determine it, or where they nearly depend on
// each other: then it parts, and each motion needs a cut of its own.
template <int Dim>
bool integrate_moved_regions(const HalfSpaces<Dim>& planes, int faces_a, double reach, bool energy,
                             std::span<const HalfSpaces<Dim>> moved, std::span<RegionIntegral<Dim>> regions);

}  // namespace voussoir
