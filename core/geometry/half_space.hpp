// Half-spaces a·x <= d, of which every block is made (Boon 2013, Eqs 3.1 and 3.2).
#pragma once

#include <vector>

#include "core/geometry/types.hpp"

namespace voussoir {

// In both dimensions as long as four numbers, which the contact kernel loads together.
template <int Dim>
struct alignas(2 * sizeof(double)) HalfSpace {
  Vector<Dim> normal;  // unit, outward
  double offset;       // m
};

template <int Dim>
using HalfSpaces = std::vector<HalfSpace<Dim>>;

// distance of a point to the plane, negative inside
template <int Dim>
double signed_distance(const HalfSpace<Dim>& plane, const Vector<Dim>& point);

// whether a point lies inside all of them, not on a face
template <int Dim>
bool lies_inside(const HalfSpaces<Dim>& region, const Vector<Dim>& point);

// the same half-space seen from an origin moved by `shift` (Eqs 3.19 and 3.20)
template <int Dim>
HalfSpace<Dim> moved_origin(const HalfSpace<Dim>& plane, const Vector<Dim>& shift);

// of the entries of a normal as stated, and whether it is that of a unit normal written with six digits
double squared_length(const std::vector<double>& normal);
bool is_unit(double squared_length);

// Upward unit normal of a joint plane from its dip (0..pi/2 below horizontal) and dip direction (clockwise from north);
// x east, y north, z up: (sin dip sin dd, sin dip cos dd, cos dip). In 2-D (x right, y up) the section looks north:
// dip direction pi/2 dips to the right, 3 pi/2 to the left.
Vector<3> upward_normal_3d(double dip, double dip_direction);
Vector<2> upward_normal_2d(double dip, double dip_direction);

}  // namespace voussoir
