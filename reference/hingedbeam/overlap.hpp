#pragma once

#include <vector>

// The region that two convex bodies in the plane share, and where a contact may be placed in it. Written plainly, apart
// from the core: clipping, the shoelace formula, maximisation of the sum of logarithms.
namespace voussoir::reference {

struct Point {
  double x = 0, y = 0;
};
inline Point operator+(Point a, Point b) {
  return {a.x + b.x, a.y + b.y};
}
inline Point operator-(Point a, Point b) {
  return {a.x - b.x, a.y - b.y};
}
inline Point operator-(Point a) {
  return {-a.x, -a.y};
}
inline Point operator*(double s, Point a) {
  return {s * a.x, s * a.y};
}
inline double dot(Point a, Point b) {
  return a.x * b.x + a.y * b.y;
}

// a half-plane normal · point <= offset, the normal outward and of length 1
struct Plane {
  Point normal;
  double offset = 0;
};
using Planes = std::vector<Plane>;
using Polygon = std::vector<Point>;  // counter-clockwise

// the common region; fewer than three corners: none
Polygon clipped(const Planes& a, const Planes& b);

Point centroid_of(const Polygon& polygon);

// sum of log(offset - normal · p) over all planes of both bodies, whether they bound the common region or not
double sum_of_logarithms(const Planes& a, const Planes& b, Point p);

// Its maximum, by Newton with the damping 1/(1 + λ), λ the decrement, which a self-concordant function allows (Nesterov
// & Nemirovskii 1994), from a point inside. Throws std::domain_error when `inside` is not.
Point analytic_centre(const Planes& a, const Planes& b, Point inside);

// From the point backwards along the normal to the face of `b`, and forwards to that of `a`; the normal points from a
// to b.
double overlap_along(Point normal, const Planes& a, const Planes& b, Point p);

}  // namespace voussoir::reference
