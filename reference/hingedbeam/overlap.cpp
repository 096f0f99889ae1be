#include "reference/hingedbeam/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace voussoir::reference {
namespace {

double slack(const Plane& plane, Point p) {
  return plane.offset - dot(plane.normal, p);
}

Polygon clipped(const Polygon& polygon, const Plane& plane) {
  Polygon left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double at_p = slack(plane, p), at_q = slack(plane, q);
    if (at_p >= 0) left.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) left.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return left;
}

}  // namespace

Polygon clipped(const Planes& a, const Planes& b) {
  double far = 0;
  for (const Planes* planes : {&a, &b})
    for (const Plane& plane : *planes)
      far = std::max(far, 4 * std::abs(plane.offset));
  Polygon region{{-far, -far}, {far, -far}, {far, far}, {-far, far}};
  for (const Planes* planes : {&a, &b})
    for (const Plane& plane : *planes)
      region = clipped(region, plane);
  return region;
}

Point centroid_of(const Polygon& polygon) {
  // from a corner, so that a small region far from the origin keeps its digits
  const Point origin = polygon.front();
  double twice_area = 0;
  Point sum;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point p = polygon[i] - origin, q = polygon[(i + 1) % polygon.size()] - origin;
    const double cross = p.x * q.y - p.y * q.x;
    twice_area += cross;
    sum = sum + cross * (p + q);
  }
  return origin + 1 / (3 * twice_area) * sum;
}

double sum_of_logarithms(const Planes& a, const Planes& b, Point p) {
  double sum = 0;
  for (const Planes* planes : {&a, &b})
    for (const Plane& plane : *planes) {
      const double s = slack(plane, p);
      if (!(s > 0)) return -std::numeric_limits<double>::infinity();
      sum += std::log(s);
    }
  return sum;
}

Point analytic_centre(const Planes& a, const Planes& b, Point p) {
  if (!std::isfinite(sum_of_logarithms(a, b, p)))
    throw std::domain_error("analytic centre: the start is outside the region");
  constexpr int most = 100;
  constexpr double converged = 1e-24;  // square of Newton's decrement: the point is then right to 1e-12 of the region
  for (int i = 0; i < most; ++i) {
    Point gradient;
    double xx = 0, xy = 0, yy = 0;  // of minus the Hessian, which is positive definite
    for (const Planes* planes : {&a, &b})
      for (const Plane& plane : *planes) {
        const Point row = 1 / slack(plane, p) * plane.normal;
        gradient = gradient - row;
        xx += row.x * row.x;
        xy += row.x * row.y;
        yy += row.y * row.y;
      }
    const double determinant = xx * yy - xy * xy;
    const Point step{(yy * gradient.x - xy * gradient.y) / determinant,
                     (xx * gradient.y - xy * gradient.x) / determinant};
    const double decrement = dot(gradient, step);
    if (decrement < converged) return p + step;
    // a sum of logarithms is self-concordant: such steps stay inside and grow it, full ones from a quarter on
    const double length = std::sqrt(decrement);
    p = p + (length > 0.25 ? 1 / (1 + length) : 1.0) * step;
  }
  return p;
}

double overlap_along(Point normal, const Planes& a, const Planes& b, Point p) {
  double forwards = std::numeric_limits<double>::infinity(), backwards = forwards;
  for (const Plane& plane : a)
    if (const double along = dot(plane.normal, normal); along > 0)
      forwards = std::min(forwards, slack(plane, p) / along);
  for (const Plane& plane : b)
    if (const double along = -dot(plane.normal, normal); along > 0)
      backwards = std::min(backwards, slack(plane, p) / along);
  return forwards + backwards;
}

}  // namespace voussoir::reference
