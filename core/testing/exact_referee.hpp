// Exact results for those of the kernels of space (Dim = 3) in double. Doubles are rational numbers, so decisions, LP
// values, vertices and sections are exact; results with a root or a long sum are computed in 113 bits from exact
// vertices. Programs and vertices: cddlib with GMP. Sections, solids and everything else: written here, sharing nothing
// with the core but its plain structs. cddlib is GPL and has global state: tests only, one thread. A programming error
// of the caller (no planes, not closed although required) throws std::logic_error.
#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>
#include <vector>

#include "core/contact/narrow_phase.hpp"

namespace voussoir::exact {

using Rational = mpq_class;
using Point = std::array<Rational, 3>;
using Quad = __float128;
using QuadVector = std::array<Quad, 3>;

// normal·x <= offset; the normal need not be unit
struct Plane {
  Point normal;
  Rational offset;
};
using Planes = std::vector<Plane>;

// the doubles themselves; a point of the plane has z = 0
Planes planes_of(const HalfSpaces<3>& planes);
Point point_of(const Vector<3>& point);
Point point_of(const Vector<2>& point);
Rational dot(const Point& a, const Point& b);

// Both parts' planes in the first body's frame by the pair's doubles, planes of A first: (R a)·x <= d + (R a)·o.
Planes planes_of(const Pair<3>& pair);

// the same with an offset that no double represents
Planes planes_of(const Pair<3>& pair, const Point& offset);

// A pair of the plane as prisms along z: planes of A, of B, then two lids |z| <= H = 4 (radius of A + radius of B). The
// program's value, and x and y of every point, are those of the plane; sections are 2 H times as large.
Planes planes_of(const Pair<2>& pair);
double lid_height(const Pair<2>& pair);

// every half-space grown by the distance (negative: shrunk), taking normals for unit
Planes grown(Planes planes, double distance);

// ---- programs -------------------------------------------------------------------------------------------------------

// min s : a·x - d <= s
struct Program {
  bool bounded = true;  // false: s has no minimum, the planes do not close a region
  Rational value;
};
Program feasibility(const Planes& planes);

// the same over the points of a plane (the section that a joint would cut out, Boon 2013, Eq. 3.7)
Program section_feasibility(const Planes& planes, const Plane& joint);

// max direction·x over a closed, not empty solid
Rational support(const Planes& planes, const Point& direction);

// The same if a guessed corner, three of the planes, proves it; nothing if it does not. Far cheaper.
std::optional<Rational> proven_support(const Planes& planes, const std::array<int, 3>& corner, const Point& direction);

// min over the planes of d - a·x: the depth of the point inside
Rational least_slack(const Planes& planes, const Point& point);

// Bounds of the program's minimum proven by a guessed basis: 4 of the planes, multipliers and point by
// Cramer's rule, then every plane checked. Cheap for thousands of planes, unlike cddlib. `proven` is false when
// the basis proves no lower bound (singular or a negative multiplier).
struct ProgramBounds {
  bool proven = false;
  Rational low, high;
};
ProgramBounds feasibility_bounds(const Planes& planes, const std::array<int, 4>& basis);

// corners of a closed solid, each once, by cddlib
std::vector<Point> vertices(const Planes& planes);

// ---- sections and solids --------------------------------------------------------------------------------------------

// The section by the plane through the point normal to n; 0 when it is empty. The solid must be closed.
struct Section {
  Quad area = 0;
  Quad sensitivity = 0;  // m: growth of the area when every plane moves out by 1 m, to first order
};
Section section(const Planes& planes, const Point& point, const Point& normal);
Quad section_area(const Planes& planes, const Vector<3>& point, const Vector<3>& normal);

// The contact of one face of A and one of B on the plane that halves their angle (contact/face_integral.hpp defines it,
// and the overlap u on it); planes of A are first, normals as they are, unit or not. The solid must be closed.
struct IntegratedContact {
  Quad area = 0;                    // 0: they do not press on each other
  Quad volume = 0;                  // ∫ u
  Quad square = 0;                  // ∫ u²
  Quad polar = 0;                   // ∫ r² about the area's centre
  Quad extent = 0;                  // m: largest distance of a corner from the first
  Quad least_sine = 1;              // of the angles between that plane and unit side planes that bound the polygon
  QuadVector centre{}, pressure{};  // of the area, of u
};
IntegratedContact pressed_face(const Planes& planes, int face_a, int face_b);

struct Solid {
  Quad volume = 0;
  QuadVector centroid{};                       // m
  std::array<QuadVector, 3> second_moment{};   // about the centroid, m⁵
  int facets = 0, edges = 0, vertices = 0;     // vertices counts corners of facets: one for every facet that it is on
  std::vector<std::array<double, 3>> corners;  // rounded, one for every facet that it is on
};

// All facets by clipping, integrals by simplices around a point inside. The solid must be closed; an empty one has
// volume 0. Coincident planes share one facet.
Solid solid(const Planes& planes);

// ---- the contact's point, normal and overlap, in 113 bits -----------------------------------------------------------

// Newton's decrement of -Σ log(d - a·x), which bounds the distance to the analytic centre in the metric of the region:
// along any direction by `decrement/(1 - decrement)` times the region's half width.
struct Centre {
  bool interior = false;
  Quad decrement = 0;
};
Centre centre(const HalfSpaces<3>& planes, const Vector<3>& point);

// Difference of the unit gradients of both parts' potentials Σ <a·x - d + r>². `gradient` is the smaller of both
// gradients' lengths, `difference` the length before it was normalised; the normal is meaningless when one is 0.
struct Normal {
  QuadVector normal{};
  Quad gradient_a = 0, gradient_b = 0, difference = 0;
};
Normal contact_normal(const HalfSpaces<3>& planes, int faces_a, const Vector<3>& point, double radius);

double to_double(const Quad& q);
Quad to_quad(const Rational& q);
Quad root(Quad square);
QuadVector quads(const Vector<3>& v);
Quad dot(const QuadVector& a, const QuadVector& b);

}  // namespace voussoir::exact
