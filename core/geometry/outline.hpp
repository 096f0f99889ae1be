// Where a joint ends within its plane, how much of it lies inside a solid, and the sections of solids.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/geometry/polytope.hpp"

namespace voussoir {

enum class OutlineForm {
  none,       // persistent: the joint never ends
  ellipse,    // 2-D: ellipse and rectangle are both a trace, from end to end
  rectangle,  //
  polygon     // convex; 3-D only
};

// columns: unit, in the plane and perpendicular, along the strike and down the dip; 2-D: down the dip alone
template <int Dim>
using PlaneAxes = FixedMatrix<Dim, Dim - 1>;

template <int Dim>
struct Outline {
  OutlineForm shape = OutlineForm::none;
  Vector<Dim> centre = Vector<Dim>::Zero();  // m, in the plane
  PlaneAxes<Dim> axes = PlaneAxes<Dim>::Zero();
  std::array<double, Dim - 1> half_sizes{};  // m, along the axes; of the ellipse its half axes
  std::vector<Vector<2>> corners{};          // of the polygon: counter-clockwise along the axes from the centre, m
};

// The axes of a plane with this upward normal (Boon 2013, Eqs 3.11-3.13): the horizontal strike, 90 degrees
// counter-clockwise from the dip direction seen from above, and the line of the steepest descent (2-D: the trace alone,
// downwards). Of a horizontal plane the strike is x. Only +, *, / and square roots: the same bits on every platform.
PlaneAxes<3> plane_axes(const Vector<3>& upward_normal);
PlaneAxes<2> plane_axes(const Vector<2>& upward_normal);

// The corners of a convex polygon, given in either sense, counter-clockwise; none if they are not convex, not in order
// around it, or have no area.
std::vector<Vector<2>> counter_clockwise(std::vector<Vector<2>> corners);

// Area (2-D: length) of the joint inside the solid, in the solid's coordinates, m² (2-D: m); for a persistent joint,
// the area of the full section. Exact up to rounding, ellipses too.
double measure_inside(const HalfSpace<3>& plane, const Outline<3>& outline, const Polytope<3>& solid);
double measure_inside(const HalfSpace<2>& plane, const Outline<2>& outline, const Polytope<2>& solid);

// Corners of the polygon in which a plane cuts a solid, in the solid's coordinates, m, counter-clockwise seen from
// where the plane's normal points; none if it misses the solid.
std::vector<Vector<3>> section_of(const HalfSpace<3>& plane, const Polytope<3>& solid);

// whether a point of the plane lies within the outline
template <int Dim>
bool contains(const Outline<Dim>& outline, const Vector<Dim>& point);

// The segment of the line `start + t direction` inside the solid; none when it misses.
template <int Dim>
std::optional<std::array<double, 2>> stretch_inside(const Vector<Dim>& start, const Vector<Dim>& direction,
                                                    const HalfSpaces<Dim>& solid);

}  // namespace voussoir
