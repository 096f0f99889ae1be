// A contact between two parts resolved once, and the conditions that every contact must satisfy.
#pragma once

#include <gtest/gtest.h>

#include "core/contact/pair_geometry.hpp"
#include "core/testing/one_pair.hpp"
#include "core/testing/oracles.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::contacts {

// closed forms of unit blocks: rounding of the planes (1e-16) and of the centre's Newton steps
inline constexpr double exact = 1e-12;

// Newton ends with 1e-9 of the overlap (ContactSettings::newton_tolerance), the cold face contact with a little more
inline constexpr double point_tolerance = 1e-6;

// sections through a point and a normal that both have rounding; in long double they have neither
inline constexpr double area_tolerance = 1e-6;

// if a cube's corner meets a face, the normal is between the face's and the corner's diagonal, 54.7 degrees away:
// the cosine of half of that
inline constexpr double halfway_to_a_corner = 0.887;

// a gap below this fraction of the size is decided by rounding: ContactSettings::tolerance with room
inline constexpr double undecided = 1e-11;

// the same for the LP's value, which is closer to the rounding: twice the tolerance of a unit cube's half edge
inline constexpr double undecided_value = 1e-13;

template <int Dim>
Outcome<Dim> touch(const Polytope<Dim>& a, const Polytope<Dim>& b, const Vector<Dim>& offset) {
  return touch<Dim>(a, b, Matrix<Dim>::Identity(), offset);
}

template <int Dim>
Polytope<Dim> unit_cube() {
  return shapes::block<Dim>(shapes::cube<Dim>(0.5));
}

// m: the distance of B's centroid along the direction when the parts touch, to 6 m / 2^40; a little more rather than
// less
template <int Dim>
double distance_of_touching(const Polytope<Dim>& a, const Polytope<Dim>& b, const Matrix<Dim>& turn,
                            const Vector<Dim>& along) {
  double inside = 0, outside = 6;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (inside + outside);
    (oracle::separation<Dim>(a, b, turn, middle * along) > 0 ? outside : inside) = middle;
  }
  return outside;
}

// all planes in the first body's frame, seen from its centroid
template <int Dim>
HalfSpaces<Dim> planes_of(const Polytope<Dim>& a, const Polytope<Dim>& b, const Matrix<Dim>& turn,
                          const Vector<Dim>& offset) {
  HalfSpaces<Dim> planes = a.faces;
  for (const HalfSpace<Dim>& p : shapes::placed<Dim>(b.faces, turn, offset))
    planes.push_back(p);
  return planes;
}

// the conditions of every contact: point inside, near the analytic centre, overlap positive, unit normal, right area
template <int Dim>
void expect_sound(const Polytope<Dim>& a, const Polytope<Dim>& b, const Matrix<Dim>& turn, const Vector<Dim>& offset,
                  const ContactGeometry<Dim>& g) {
  const HalfSpaces<Dim> planes = planes_of<Dim>(a, b, turn, offset);
  EXPECT_NEAR(g.normal.norm(), 1, exact);
  EXPECT_GT(g.overlap, 0);
  EXPECT_GE(g.face_a, 0);
  EXPECT_LT(g.face_a, static_cast<int>(a.faces.size()));
  EXPECT_GE(g.face_b, 0);
  EXPECT_LT(g.face_b, static_cast<int>(b.faces.size()));
  // the planes above are rounded again: 1e-16 of slack is the input's own uncertainty
  const auto barrier = oracle::barrier<Dim>(planes, g.point.template cast<oracle::Real>());
  EXPECT_TRUE(barrier.interior);
  EXPECT_LT(static_cast<double>(barrier.decrement), point_tolerance + 1e-14 / g.overlap);
  const double area = static_cast<double>(
      oracle::section<Dim>(planes, g.point.template cast<oracle::Real>(), g.normal.template cast<oracle::Real>()));
  // the ends of a wedge move by the rounding of the coordinates over its height
  EXPECT_NEAR(g.area, area, (area_tolerance + 1e-15 / g.overlap) * area + 1e-14);
}

template <int Dim>
Vector<Dim> lowest_corner(const Polytope<Dim>& part, const Matrix<Dim>& turn) {
  Vector<Dim> lowest = turn * part.vertices.front();
  for (const Vector<Dim>& v : part.vertices)
    if ((turn * v)[Dim - 1] < lowest[Dim - 1]) lowest = turn * v;
  return lowest;
}

}  // namespace voussoir::contacts
