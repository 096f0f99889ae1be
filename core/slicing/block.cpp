#include "core/slicing/block.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/surface.hpp"
#include "core/optimise/feasibility.hpp"

namespace voussoir {
namespace {

// points closer than this times the extent of a hull are one
constexpr double merge_tolerance = 1e-10;

// a plane that would cut off less than this times the inscribed radius is redundant
constexpr double redundancy_tolerance = 1e-10;

// Coordinates carry 2e-16 of the extent and of the distance from the origin. Where that comes near the inscribed radius
// few digits of volume and overlap are left: such a block is refused.
constexpr double thinnest = 1e-8;                                           // inscribed radius / extent
constexpr double farthest = 1e-6 / std::numeric_limits<double>::epsilon();  // distance / inscribed radius

template <int Dim>
bool valid(const HalfSpace<Dim>& plane) {
  return plane.normal.allFinite() && std::isfinite(plane.offset) && plane.normal.norm() > 0;
}

// Bounded iff the recession cone {a_i·x <= 0} holds no direction: along no axis, either way, can a point go on for
// ever.
template <int Dim>
bool bounded(const HalfSpaces<Dim>& planes) {
  constexpr double rounding = 1e-12;  // of unit normals; a needle of aspect 1e6 still answers 1e-6
  HalfSpaces<Dim> cone = planes;
  for (HalfSpace<Dim>& p : cone)
    p.offset = 0;
  cone.emplace_back();
  for (int axis = 0; axis < Dim; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      cone.back() = {-sign * Vector<Dim>::Unit(axis), -1};
      if (!(solve_feasibility<Dim>(cone, {}).value > rounding)) return false;
    }
  return true;
}

}  // namespace

template <int Dim>
BlockResult<Dim> make_block(const HalfSpaces<Dim>& input, const std::vector<int>& joints) {
  BlockResult<Dim> result;
  HalfSpaces<Dim> planes = input;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (!valid(planes[i])) {
      result.status = BlockStatus::bad_plane;
      result.plane = static_cast<int>(i);
      return result;
    }
    const double norm = planes[i].normal.norm();
    planes[i].normal /= norm;
    planes[i].offset /= norm;
  }

  // the largest inscribed ball tells whether the planes enclose a solid at all
  const FeasibilityResult<Dim> ball = solve_feasibility<Dim>(planes, {});
  if (static_cast<int>(planes.size()) <= Dim || !bounded(planes)) {
    result.status = BlockStatus::open;
    return result;
  }
  if (ball.status != FeasibilityStatus::optimal || !(ball.value < 0)) {
    result.status = BlockStatus::empty;
    return result;
  }
  if (ball.point.norm() > farthest * std::abs(ball.value)) {
    result.status = BlockStatus::far;
    return result;
  }
  result.part.inscribed_radius = -ball.value;
  result.part.centre = ball.point;

  // seen from the ball's centre, the surface depends on neither origin nor unit
  HalfSpaces<Dim> centred = planes;
  for (HalfSpace<Dim>& f : centred)
    f = moved_origin<Dim>(f, ball.point);
  Surface<Dim> surface = find_surface<Dim>(centred, redundancy_tolerance * result.part.inscribed_radius);
  double extent = 0;
  for (const Vector<Dim>& v : surface.vertices)
    extent = std::max(extent, v.norm());
  if (surface.status != SurfaceStatus::ok || result.part.inscribed_radius < thinnest * extent) {
    result.status = surface.status == SurfaceStatus::open ? BlockStatus::open : BlockStatus::flat;
    return result;
  }

  // redundant planes have no loop and go
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (surface.loops[i].empty()) continue;
    result.part.faces.push_back(planes[i]);
    result.part.joints.push_back(joints[i]);
    result.part.loops.push_back(std::move(surface.loops[i]));
  }
  result.part.vertices = std::move(surface.vertices);
  result.part.mass = integrate(result.part.vertices, result.part.loops);
  for (Vector<Dim>& v : result.part.vertices) {
    v += ball.point;
    result.part.radius = std::max(result.part.radius, v.norm());
  }
  result.part.mass = moved_origin<Dim>(result.part.mass, -ball.point);
  result.part.basis = solve_feasibility<Dim>(result.part.faces, {}).basis;
  return result;
}

template <>
HalfSpaces<2> hull_planes(const std::vector<Vector<2>>& points, int* hidden) {
  HalfSpaces<2> planes;
  std::vector<bool> used(points.size(), false);
  double extent = 0;
  for (const Vector<2>& p : points)
    extent = std::max(extent, (p - points.front()).norm());
  const double tolerance = merge_tolerance * extent;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < points.size(); ++j) {
      const Vector<2> edge = points[j] - points[i];
      if (edge.norm() <= tolerance) continue;
      const Vector<2> normal = Vector<2>(edge[1], -edge[0]).normalized();
      bool extreme = true, inner = false;
      for (const Vector<2>& p : points) {
        const double distance = normal.dot(p - points[i]), along = edge.dot(p - points[i]) / edge.squaredNorm();
        extreme = extreme && distance <= tolerance;
        inner = inner || (std::abs(distance) <= tolerance && (along < -1e-9 || along > 1 + 1e-9));
      }
      if (!extreme || inner) continue;  // only the whole edge counts, from corner to corner
      planes.push_back({normal, normal.dot(points[i])});
      used[i] = used[j] = true;
    }
  if (hidden) *hidden = static_cast<int>(std::count(used.begin(), used.end(), false));
  return planes;
}

template <>
HalfSpaces<3> hull_planes(const std::vector<Vector<3>>& points, int* hidden) {
  HalfSpaces<3> planes;
  double extent = 0;
  for (const Vector<3>& p : points)
    extent = std::max(extent, (p - points.front()).norm());
  const double tolerance = merge_tolerance * extent;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k) {
        Vector<3> normal = (points[j] - points[i]).cross(points[k] - points[i]);
        if (normal.norm() <= tolerance * extent) continue;
        normal.normalize();
        double highest = 0, lowest = 0;
        for (const Vector<3>& p : points) {
          highest = std::max(highest, normal.dot(p - points[i]));
          lowest = std::min(lowest, normal.dot(p - points[i]));
        }
        if (highest > tolerance && lowest < -tolerance) continue;
        if (highest > tolerance) normal = -normal;
        const HalfSpace<3> plane{normal, normal.dot(points[i])};
        const bool known = std::any_of(planes.begin(), planes.end(), [&](const HalfSpace<3>& other) {
          return (other.normal - normal).norm() < 1e-7 &&
                 std::abs(signed_distance<3>(other, points[i])) <= 2 * tolerance &&
                 std::abs(signed_distance<3>(other, points[j])) <= 2 * tolerance &&
                 std::abs(signed_distance<3>(other, points[k])) <= 2 * tolerance;
        });
        if (!known) planes.push_back(plane);
      }
  if (hidden) {
    *hidden = 0;
    for (const Vector<3>& p : points) {
      Matrix<3> spread = Matrix<3>::Zero();  // a corner lies on planes whose normals span space
      for (const HalfSpace<3>& f : planes)
        if (std::abs(signed_distance(f, p)) <= 2 * tolerance) spread += f.normal * f.normal.transpose();
      if (!(spread.determinant() > 1e-14)) ++*hidden;
    }
  }
  return planes;
}

template BlockResult<2> make_block<2>(const HalfSpaces<2>&, const std::vector<int>&);
template BlockResult<3> make_block<3>(const HalfSpaces<3>&, const std::vector<int>&);

}  // namespace voussoir
