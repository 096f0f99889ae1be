#include "core/geometry/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/geometry/half_space_inl.hpp"

namespace voussoir {
namespace {

using Polygon = std::vector<Vector<2>>;

// a plane of smaller dip (rad) has no strike that its normal would resolve
constexpr double least_dip = 1e-12;

double cross(const Vector<2>& a, const Vector<2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

// the part of a convex polygon where a·x <= d (Sutherland and Hodgman 1974)
Polygon clipped(const Polygon& polygon, const Vector<2>& normal, double offset) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector<2>&p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = normal.dot(p) - offset, at_q = normal.dot(q) - offset;
    if (at_p <= 0) kept.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) kept.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return kept;
}

double polygon_area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return twice / 2;
}

// twice the area, with its sign, of the unit disc's part in the wedge that the chord p-q spans from the origin
double disc_wedge(const Vector<2>& p, const Vector<2>& q) {
  const auto sector = [](const Vector<2>& a, const Vector<2>& b) { return std::atan2(cross(a, b), a.dot(b)); };
  const Vector<2> d = q - p;
  const double a = d.squaredNorm(), b = p.dot(d), c = p.squaredNorm() - 1, root_squared = b * b - a * c;
  if (a == 0) return 0;
  if (root_squared <= 0) return sector(p, q);
  // where the chord is inside the circle it bounds a triangle, elsewhere the arc bounds
  const double root = std::sqrt(root_squared);
  const double from = std::clamp((-b - root) / a, 0.0, 1.0), to = std::clamp((-b + root) / a, 0.0, 1.0);
  if (to <= from) return sector(p, q);
  const Vector<2> enters = p + from * d, leaves = p + to * d;
  return sector(p, enters) + cross(enters, leaves) + sector(leaves, q);
}

double area_in_unit_disc(const Polygon& polygon) {
  constexpr double rounding = 1e-14;  // of the angles' sum: points outside reach as much
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    twice += disc_wedge(polygon[i], polygon[(i + 1) % polygon.size()]);
  return twice > rounding ? twice / 2 : 0;
}

// the part of a persistent joint that may be in the solid: a rectangle around the solid's projection
Outline<3> bounded(const HalfSpace<3>& plane, const Outline<3>& outline, const Polytope<3>& solid) {
  if (outline.shape != OutlineForm::none) return outline;
  Outline<3> whole;
  whole.shape = OutlineForm::rectangle;
  whole.centre = solid.centre - signed_distance<3>(plane, solid.centre) * plane.normal;
  whole.axes = plane_axes(plane.normal);
  double reach = 0;
  for (const Vector<3>& v : solid.vertices)
    reach = std::max(reach, (v - solid.centre).norm());
  whole.half_sizes = {reach, reach};
  return whole;
}

Polygon corners_of(const Outline<3>& outline) {
  if (outline.shape == OutlineForm::polygon) return outline.corners;
  const double a = outline.half_sizes[0], b = outline.half_sizes[1];
  return {{-a, -b}, {a, -b}, {a, b}, {-a, b}};
}

// the part of an outline that ends inside the solid, along the outline's axes from its centre; of an ellipse that of
// the rectangle around it
Polygon polygon_inside(const Outline<3>& outline, const Polytope<3>& solid) {
  Polygon polygon = corners_of(outline);
  for (const HalfSpace<3>& face : solid.faces) {
    const Vector<2> normal = outline.axes.transpose() * face.normal;
    polygon = clipped(polygon, normal, -signed_distance<3>(face, outline.centre));
    if (polygon.empty()) break;
  }
  return polygon;
}

// a corner that turns by less than this (rad) lies on an edge: far above the rounding of coordinates
constexpr double straight = 1e-9;

}  // namespace

std::vector<Vector<2>> counter_clockwise(std::vector<Vector<2>> corners) {
  const std::size_t n = corners.size();
  double twice_area = 0, turned = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Vector<2> a = corners[k] - corners[0], b = corners[(k + 1) % n] - corners[0];
    twice_area += a[0] * b[1] - a[1] * b[0];
  }
  if (n < 3 || twice_area == 0) return {};
  if (twice_area < 0) std::reverse(corners.begin(), corners.end());
  for (std::size_t k = 0; k < n; ++k) {
    const Vector<2> in = corners[(k + 1) % n] - corners[k], out = corners[(k + 2) % n] - corners[(k + 1) % n];
    const double turn = std::atan2(in[0] * out[1] - in[1] * out[0], in.dot(out));
    if (in.isZero(0) || turn < -straight || turn > std::numbers::pi - straight) return {};
    turned += turn;
  }
  const bool once = turned < 3 * std::numbers::pi;  // a star turns left at every corner too
  return once ? corners : std::vector<Vector<2>>{};
}

PlaneAxes<3> plane_axes(const Vector<3>& n) {
  const double across = std::sqrt(n[0] * n[0] + n[1] * n[1]);
  PlaneAxes<3> axes;
  axes.col(0) = across > least_dip ? Vector<3>(-n[1] / across, n[0] / across, 0) : Vector<3>(1, 0, 0);
  axes.col(1) = Vector<3>(axes.col(0)).cross(n);
  return axes;
}

PlaneAxes<2> plane_axes(const Vector<2>& n) {
  const Vector<2> along(n[1], -n[0]);
  return along[1] <= 0 ? along : Vector<2>(-along);
}

double measure_inside(const HalfSpace<3>& plane, const Outline<3>& stated, const Polytope<3>& solid) {
  const Outline<3> outline = bounded(plane, stated, solid);
  Polygon polygon = polygon_inside(outline, solid);
  if (outline.shape != OutlineForm::ellipse) return std::abs(polygon_area(polygon));
  const double a = outline.half_sizes[0], b = outline.half_sizes[1];
  for (Vector<2>& p : polygon)
    p = {p[0] / a, p[1] / b};
  return a * b * area_in_unit_disc(polygon);
}

double measure_inside(const HalfSpace<2>& plane, const Outline<2>& outline, const Polytope<2>& solid) {
  const bool persistent = outline.shape == OutlineForm::none;
  const Vector<2> start = persistent ? Vector<2>(plane.offset * plane.normal) : outline.centre;
  const Vector<2> along = persistent ? plane_axes(plane.normal) : outline.axes;
  const auto inside = stretch_inside<2>(start, along, solid.faces);
  if (!inside) return 0;
  if (persistent) return (*inside)[1] - (*inside)[0];
  const double half = outline.half_sizes[0];
  return std::max(0.0, std::min((*inside)[1], half) - std::max((*inside)[0], -half));
}

std::vector<Vector<3>> section_of(const HalfSpace<3>& plane, const Polytope<3>& solid) {
  const Outline<3> outline = bounded(plane, {}, solid);
  Polygon polygon = polygon_inside(outline, solid);
  std::reverse(polygon.begin(), polygon.end());  // the axes of a plane turn clockwise seen from its normal
  std::vector<Vector<3>> corners;
  for (const Vector<2>& p : polygon)
    corners.emplace_back(outline.centre + outline.axes * p);
  return corners;
}

template <int Dim>
bool contains(const Outline<Dim>& outline, const Vector<Dim>& point) {
  if (outline.shape == OutlineForm::none) return true;
  const FixedMatrix<Dim - 1, 1> x = outline.axes.transpose() * (point - outline.centre);
  if constexpr (Dim == 3) {
    if (outline.shape == OutlineForm::polygon) {
      const Vector<2> p(x[0], x[1]);
      for (std::size_t i = 0; i < outline.corners.size(); ++i) {
        const Vector<2>&a = outline.corners[i], &b = outline.corners[(i + 1) % outline.corners.size()];
        if (cross(Vector<2>(b - a), Vector<2>(p - a)) < 0) return false;
      }
      return true;
    }
    if (outline.shape == OutlineForm::ellipse) {
      const double u = x[0] / outline.half_sizes[0], v = x[1] / outline.half_sizes[1];
      return u * u + v * v <= 1;
    }
  }
  for (int k = 0; k < Dim - 1; ++k)
    if (std::abs(x[k]) > outline.half_sizes[k]) return false;
  return true;
}

template <int Dim>
std::optional<std::array<double, 2>> stretch_inside(const Vector<Dim>& start, const Vector<Dim>& direction,
                                                    const HalfSpaces<Dim>& solid) {
  double from = -std::numeric_limits<double>::max(), to = std::numeric_limits<double>::max();
  for (const HalfSpace<Dim>& face : solid) {
    const double distance = signed_distance<Dim>(face, start), speed = face.normal.dot(direction);
    // a face along the line, but for rounding, meets it farther away than any solid reaches
    if (std::abs(speed) < std::numeric_limits<double>::epsilon()) {
      if (distance > 0) return {};
      continue;
    }
    if (speed > 0)
      to = std::min(to, -distance / speed);
    else
      from = std::max(from, -distance / speed);
  }
  if (!(to > from)) return {};
  return std::array<double, 2>{from, to};
}

template bool contains<2>(const Outline<2>&, const Vector<2>&);
template bool contains<3>(const Outline<3>&, const Vector<3>&);
template std::optional<std::array<double, 2>> stretch_inside<2>(const Vector<2>&, const Vector<2>&,
                                                                const HalfSpaces<2>&);
template std::optional<std::array<double, 2>> stretch_inside<3>(const Vector<3>&, const Vector<3>&,
                                                                const HalfSpaces<3>&);

}  // namespace voussoir
