#include "core/implicit/face_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/contact/pair_geometry.hpp"

namespace voussoir {
namespace {

// cosine of 25 degrees: faces farther from parallel meet in an edge or a corner (contact/integrated_contact)
constexpr double nearly_parallel = 0.90630778703664996;

// of the larger face over the smaller one: equal faces do not change their parts by rounding
constexpr double surely_larger = 1 + 1e-9;

// Simpson's rule on so many pieces of a length
constexpr int pieces = 2;

// of n·(turn × y) by y
Vector<2> gradient_along(const Vector<2>& normal, const Spin<2>& turn) {
  return turn[0] * Vector<2>(normal[1], -normal[0]);
}
Vector<3> gradient_along(const Vector<3>& normal, const Spin<3>& turn) {
  return normal.cross(turn);
}

// An overlap over the plane of the smaller face: value at its origin and gradient along its axes, at the begin and at
// the end of a step.
template <int Dim>
struct PlaneOverlap {
  double value = 0;
  FixedMatrix<Dim - 1, 1> gradient;

  double at(const FixedMatrix<Dim - 1, 1>& y) const { return value + gradient.dot(y); }
};
template <int Dim>
using BothOverlaps = std::array<PlaneOverlap<Dim>, 2>;

// the plane of the smaller face
template <int Dim>
struct FacePlane {
  Vector<Dim> origin;
  FixedMatrix<Dim, Dim - 1> axes;

  Vector<Dim> place(const FixedMatrix<Dim - 1, 1>& y) const { return origin + axes * y; }
};
FixedMatrix<2, 1> axes_across(const Vector<2>& normal) {
  return perpendicular(normal);
}
FixedMatrix<3, 2> axes_across(const Vector<3>& normal) {
  FixedMatrix<3, 2> axes;
  axes.col(0) = perpendicular(normal);
  axes.col(1) = normal.cross(Vector<3>(axes.col(0)));
  return axes;
}

// of the length that presses at either end of the step
void add_points(const HalfSpaces<2>& planes, const FacePlane<2>& plane, const Vector<2>& normal, double reach,
                const BothOverlaps<2>& overlaps, FacePoints<2>& found) {
  const Segment common = section_segment(planes, plane.origin, normal, reach);
  if (!(common.high > common.low)) return;
  const auto place = [&](double y) { return plane.place(FixedMatrix<1, 1>(y)); };
  const auto area_of_segment = [&](const Segment& s) {
    return PressedArea<2>{s.high - s.low, 0, place(0.5 * (s.low + s.high))};
  };
  Segment all{common.high, common.low};
  for (int k = 0; k < 2; ++k) {
    const double slope = overlaps[k].gradient[0], value = overlaps[k].value;
    Segment pressed = common;
    if (slope > 0) pressed.low = std::max(pressed.low, -value / slope);
    if (slope < 0) pressed.high = std::min(pressed.high, -value / slope);
    if (!(pressed.high > pressed.low) || !(slope != 0 || value > 0)) continue;
    (k == 0 ? found.begin : found.end) = area_of_segment(pressed);
    all = {std::min(all.low, pressed.low), std::max(all.high, pressed.high)};
  }
  const double length = all.high - all.low;
  if (!(length > 0)) return;
  found.all = area_of_segment(all);
  constexpr int last = 2 * pieces;
  for (int k = 0; k <= last; ++k) {
    const double weight = k == 0 || k == last ? 1 : k % 2 == 1 ? 4 : 2;
    found.points.push_back({place(all.low + length * k / last), 0, weight * length / (6 * pieces)});
  }
}

double twice_area(const Vector<2>& u, const Vector<2>& v) {
  return u[0] * v[1] - u[1] * v[0];
}

// of a polygon in the plane; the centre is in its axes
struct PolygonArea {
  double area = 0, polar = 0;
  Vector<2> centre = Vector<2>::Zero();
};
PolygonArea area_of_polygon(const std::vector<Vector<2>>& polygon) {
  PolygonArea sum;
  if (polygon.size() < 3) return sum;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vector<2> u = polygon[k] - polygon[0], v = polygon[k + 1] - polygon[0];
    const double area = 0.5 * twice_area(u, v);
    sum.area += area;
    sum.centre += area / 3 * (u + v);
    sum.polar += area / 6 * (u.squaredNorm() + u.dot(v) + v.squaredNorm());
  }
  if (!(sum.area > 0)) return {};
  sum.centre /= sum.area;
  sum.polar = std::max(sum.polar - sum.area * sum.centre.squaredNorm(), 0.0);
  sum.centre += polygon[0];
  return sum;
}

PressedArea<3> in_space(const FacePlane<3>& plane, const PolygonArea& flat) {
  return {flat.area, flat.polar, plane.place(flat.centre)};
}

// Keeps the part of a polygon that presses at either end of the step; if neither part contains the other, all of it.
void keep_pressed(const FacePlane<3>& plane, const BothOverlaps<3>& overlaps, std::vector<Vector<2>>& polygon,
                  FacePoints<3>& found) {
  std::array<std::vector<Vector<2>>, 2> parts;
  for (int k = 0; k < 2; ++k)
    clip_polygon(polygon, Vector<2>(-overlaps[k].gradient), overlaps[k].value, parts[k]);
  found.begin = in_space(plane, area_of_polygon(parts[0]));
  found.end = in_space(plane, area_of_polygon(parts[1]));
  const auto contains = [&](int outer) {
    return std::ranges::all_of(parts[1 - outer], [&](const Vector<2>& y) { return overlaps[outer].at(y) >= 0; });
  };
  if (contains(1))
    polygon.swap(parts[1]);
  else if (contains(0))
    polygon.swap(parts[0]);
}

// of the polygon that presses at either end of the step
void add_points(const HalfSpaces<3>& planes, const FacePlane<3>& plane, const Vector<3>& normal, double reach,
                const BothOverlaps<3>& overlaps, FacePoints<3>& found) {
  static thread_local std::vector<Vector<2>> polygon;
  section_polygon(planes, plane.origin, normal, reach, polygon);
  keep_pressed(plane, overlaps, polygon, found);
  const PolygonArea all = area_of_polygon(polygon);
  if (!(all.area > 0)) return;
  const std::size_t count = polygon.size();
  const Vector<2>& centre = all.centre;
  const auto add = [&](const Vector<2>& at, double weight) {
    if (weight > 0) found.points.push_back({plane.place(at), 0, weight});
  };
  constexpr double of_vertex = 1.0 / 20, of_side = 2.0 / 15, of_centre = 9.0 / 20;
  std::vector<double> areas(count);
  for (std::size_t k = 0; k < count; ++k)
    areas[k] = 0.5 * std::max(twice_area(polygon[k] - centre, polygon[(k + 1) % count] - centre), 0.0);
  for (std::size_t k = 0; k < count; ++k) {
    const Vector<2>&here = polygon[k], &next = polygon[(k + 1) % count];
    const double both = areas[k] + areas[(k + count - 1) % count];
    add(here, of_vertex * both);
    add(0.5 * (here + centre), of_side * both);
    add(0.5 * (here + next), of_side * areas[k]);
    add((here + next + centre) / 3, of_centre * areas[k]);
  }
  add(centre, of_vertex * all.area);
  found.all = in_space(plane, all);
}

}  // namespace

template <int Dim>
bool find_face_points(const Pair<Dim>& pair, const Vector<Dim>& inside, int face_a, int face_b,
                      const RelativeMotion<Dim>& motion, FacePoints<Dim>& found) {
  found.points.clear();
  found.normal.setZero();
  found.all = found.begin = found.end = {};
  static thread_local HalfSpaces<Dim> planes;
  assemble<Dim>(pair, inside, planes);
  const int of_b = static_cast<int>(pair.a->faces.size()) + face_b;
  const HalfSpace<Dim> a = planes[face_a], b = planes[of_b];
  if (!(-a.normal.dot(b.normal) > nearly_parallel)) return false;
  const bool first_is_larger = face_area(*pair.a, face_a) > surely_larger * face_area(*pair.b, face_b);
  const HalfSpace<Dim>&small = first_is_larger ? b : a, &large = first_is_larger ? a : b;
  planes.erase(planes.begin() + of_b);
  planes.erase(planes.begin() + face_a);
  found.normal = first_is_larger ? large.normal : Vector<Dim>(-large.normal);

  const Vector<Dim> origin = -signed_distance<Dim>(small, Vector<Dim>(Vector<Dim>::Zero())) * small.normal;
  const FacePlane<Dim> plane{origin, axes_across(small.normal)};
  // what has closed since the begin of the step is taken off the overlap, what will close is added: value and gradient
  const Vector<Dim> gradient = gradient_along(found.normal, motion.turn);
  const double parting = found.normal.dot(motion.shift + cross(motion.turn, Vector<Dim>(inside + origin)));
  BothOverlaps<Dim> overlaps;
  for (int k = 0; k < 2; ++k) {
    const double apart = k == 0 ? motion.passed : motion.passed - 1;
    overlaps[k].value = -signed_distance<Dim>(large, origin) + apart * parting - found.normal.dot(motion.drawn);
    overlaps[k].gradient = plane.axes.transpose() * Vector<Dim>(-large.normal + apart * gradient);
  }
  add_points(planes, plane, small.normal, 4 * std::min(pair.a->radius, pair.b->radius), overlaps, found);
  for (PressedArea<Dim>* area : {&found.all, &found.begin, &found.end})
    area->centre += inside;
  for (FacePoint<Dim>& p : found.points) {
    p.overlap = -signed_distance<Dim>(large, p.place) - found.normal.dot(motion.drawn);
    p.place += inside;
  }
  return true;
}

template bool find_face_points<2>(const Pair<2>&, const Vector<2>&, int, int, const RelativeMotion<2>&, FacePoints<2>&);
template bool find_face_points<3>(const Pair<3>&, const Vector<3>&, int, int, const RelativeMotion<3>&, FacePoints<3>&);

}  // namespace voussoir
