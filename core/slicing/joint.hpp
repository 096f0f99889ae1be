// A joint in slicing: a plane, its extent within it, and the meaning of its faces (Boon 2013, chapter 3.2).
#pragma once

#include <limits>
#include <vector>

#include "core/geometry/outline.hpp"

namespace voussoir {

enum class JointKind {
  rock,
  boundary,      // one side of it stays in one piece and never moves
  construction,  // the blocks on its two sides are one body: it only shapes slopes and openings
  fictitious     // a plane through intact rock, whose strength its properties state; cuts like rock
};

// which side of a joint, seen along its normal
enum class JointSide { none, below, above };

// The part of a joint's plane that exists: without half-spaces it is infinite. Every half-space that bounds it counts,
// those of an outline, perpendicular to the joint, and those of a subdomain to which it is confined.
template <int Dim>
struct Extent {
  HalfSpaces<Dim> bounds;
  Vector<Dim> centre = Vector<Dim>::Zero();                 // of a ball that holds it, m
  double radius = std::numeric_limits<double>::infinity();  // m

  bool infinite() const { return bounds.empty(); }
};

template <int Dim>
struct Cut {
  HalfSpace<Dim> plane;  // upward normal, unit
  int joint;             // the number stored with the faces that it makes
  Extent<Dim> extent{};
  int set = 0;  // of the same joint set
  JointKind kind = JointKind::rock;
  JointSide fixed_side = JointSide::none;  // boundary: the side that stays in one piece
};

// Outlines about a point of the plane, from coordinates along its axes (m). A polygon has at least three corners, in
// either sense; if it is not convex or has no area, the extent has no bounds: the caller refuses it. An
// ellipse becomes the polygon of `sides` sides that touches it from outside, which is larger by sides/π tan(π/sides).
Extent<3> polygon_extent(const Vector<3>& upward_normal, const Vector<3>& point, const std::vector<Vector<2>>& corners);
Extent<3> rectangle_extent(const Vector<3>& upward_normal, const Vector<3>& centre, double along_strike,
                           double down_dip);
Extent<3> ellipse_extent(const Vector<3>& upward_normal, const Vector<3>& centre, double along_strike, double down_dip,
                         int sides);

// a trace in the plane, of this length about its centre
Extent<2> trace_extent(const Vector<2>& upward_normal, const Vector<2>& centre, double length);

// that of any outline, which lies in the plane with this normal
Extent<2> extent_of(const Vector<2>& upward_normal, const Outline<2>& outline, int ellipse_sides);
Extent<3> extent_of(const Vector<3>& upward_normal, const Outline<3>& outline, int ellipse_sides);

// Except for `given`, boundary joints come first and construction joints last, at any size and of any set.
enum class CuttingOrder {
  given,
  by_size,      // large extents first: a small joint then ends at the large ones; those of one size alternate
  alternating,  // the first of every set, the second of every set, …
};

template <int Dim>
void put_in_order(std::vector<Cut<Dim>>& cuts, CuttingOrder order);

}  // namespace voussoir
