#include "core/implicit/face_points.hpp"

#include <algorithm>
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

double area_of(const Polytope<2>& part, int face) {
  const std::vector<int>& loop = part.loops[face];
  return (part.vertices[loop[1]] - part.vertices[loop[0]]).norm();
}
double area_of(const Polytope<3>& part, int face) {
  const std::vector<int>& loop = part.loops[face];
  Vector<3> twice = Vector<3>::Zero();
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    twice += (part.vertices[loop[k]] - part.vertices[loop[0]])
                 .cross(Vector<3>(part.vertices[loop[k + 1]] - part.vertices[loop[0]]));
  return 0.5 * twice.norm();
}

// of the common length through a point
void add_points(const HalfSpaces<2>& planes, const Vector<2>& through, const Vector<2>& normal, double reach,
                FacePoints<2>& found) {
  const Segment common = section_segment(planes, through, normal, reach);
  const double length = common.high - common.low;
  if (!(length > 0)) return;
  const Vector<2> along = perpendicular(normal);
  found.area = length;
  found.centre = through + 0.5 * (common.low + common.high) * along;
  constexpr int last = 2 * pieces;
  for (int k = 0; k <= last; ++k) {
    const double weight = k == 0 || k == last ? 1 : k % 2 == 1 ? 4 : 2;
    found.points.push_back({through + (common.low + length * k / last) * along, 0, weight * length / (6 * pieces)});
  }
}

// of the common polygon
void add_points(const HalfSpaces<3>& planes, const Vector<3>& through, const Vector<3>& normal, double reach,
                FacePoints<3>& found) {
  static thread_local std::vector<Vector<2>> polygon;
  section_polygon(planes, through, normal, reach, polygon);
  const std::size_t count = polygon.size();
  if (count < 3) return;
  const auto twice_area = [](const Vector<2>& u, const Vector<2>& v) { return u[0] * v[1] - u[1] * v[0]; };
  double area = 0;
  Vector<2> centre = Vector<2>::Zero();
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const Vector<2> u = polygon[k] - polygon[0], v = polygon[k + 1] - polygon[0];
    area += 0.5 * twice_area(u, v);
    centre += 0.5 * twice_area(u, v) * (u + v) / 3;
  }
  if (!(area > 0)) return;
  centre = polygon[0] + centre / area;
  const Vector<3> first = perpendicular(normal), second = normal.cross(first);
  const auto add = [&](const Vector<2>& at, double weight) {
    if (weight > 0) found.points.push_back({through + at[0] * first + at[1] * second, 0, weight});
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
  add(centre, of_vertex * area);
  found.area = area;
  found.centre = through + centre[0] * first + centre[1] * second;
  for (const FacePoint<3>& p : found.points)
    found.polar += p.area * (p.place - found.centre).squaredNorm();
}

}  // namespace

template <int Dim>
bool find_face_points(const Pair<Dim>& pair, const Vector<Dim>& inside, int face_a, int face_b,
                      FacePoints<Dim>& found) {
  found = {};
  static thread_local HalfSpaces<Dim> planes;
  assemble<Dim>(pair, inside, planes);
  const int of_b = static_cast<int>(pair.a->faces.size()) + face_b;
  const HalfSpace<Dim> a = planes[face_a], b = planes[of_b];
  if (!(-a.normal.dot(b.normal) > nearly_parallel)) return false;
  const bool first_is_larger = area_of(*pair.a, face_a) > surely_larger * area_of(*pair.b, face_b);
  const HalfSpace<Dim>&small = first_is_larger ? b : a, &large = first_is_larger ? a : b;
  planes.erase(planes.begin() + of_b);
  planes.erase(planes.begin() + face_a);
  const Vector<Dim> through = -signed_distance<Dim>(small, Vector<Dim>(Vector<Dim>::Zero())) * small.normal;
  add_points(planes, through, small.normal, 4 * std::min(pair.a->radius, pair.b->radius), found);
  found.normal = first_is_larger ? large.normal : Vector<Dim>(-large.normal);
  found.centre += inside;
  for (FacePoint<Dim>& p : found.points) {
    p.overlap = -signed_distance<Dim>(large, p.place);
    p.place += inside;
  }
  return !found.points.empty();
}

template bool find_face_points<2>(const Pair<2>&, const Vector<2>&, int, int, FacePoints<2>&);
template bool find_face_points<3>(const Pair<3>&, const Vector<3>&, int, int, FacePoints<3>&);

}  // namespace voussoir
