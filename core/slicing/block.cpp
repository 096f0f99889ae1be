#include "core/slicing/block.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/optimise/feasibility.hpp"

namespace voussoir {
namespace {

// vertices closer than this times the block's extent are one; three decades above the rounding of the intersections
constexpr double merge_tolerance = 1e-10;

// a plane that would cut off less than this times the inscribed radius is redundant
constexpr double redundancy_tolerance = 1e-10;

// an inscribed ball smaller than this times the offsets it follows from is their rounding: planes that only touch
constexpr double ball_rounding = 64 * std::numeric_limits<double>::epsilon();

template <int Dim>
bool valid(const HalfSpace<Dim>& plane) {
  return plane.normal.allFinite() && std::isfinite(plane.offset) && plane.normal.norm() > 0;
}

// Unit to rounding stays as it is: a plane that was divided again at every later cut would come out in other bits when
// the cuts come in another order.
template <int Dim>
void normalise(HalfSpace<Dim>& plane) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  const double norm = plane.normal.norm();
  if (std::abs(norm - 1) <= rounding) return;
  plane.normal /= norm;
  plane.offset /= norm;
}

// the order of a part's faces, whatever the order in which its planes were given
template <int Dim>
bool before(const HalfSpace<Dim>& a, const HalfSpace<Dim>& b) {
  for (int k = 0; k < Dim; ++k)
    if (a.normal[k] != b.normal[k]) return a.normal[k] < b.normal[k];
  return a.offset < b.offset;
}

// corners by their coordinates: planes through them must not round differently when they are listed otherwise
template <int Dim>
std::vector<Vector<Dim>> sorted(std::vector<Vector<Dim>> points) {
  std::sort(points.begin(), points.end(), [](const Vector<Dim>& a, const Vector<Dim>& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  return points;
}

// Eq. 3.8 asked through the feasibility program: the plane is needed iff the others leave room beyond it
template <int Dim>
bool needed(const HalfSpaces<Dim>& planes, const std::vector<bool>& kept, std::size_t candidate, double tolerance) {
  HalfSpaces<Dim> others;
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (kept[i] && i != candidate) others.push_back(planes[i]);
  others.push_back({-planes[candidate].normal, -planes[candidate].offset});
  const FeasibilityResult<Dim> r = solve_feasibility<Dim>(others, {});
  return r.status == FeasibilityStatus::unbounded || r.value < -tolerance;
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

// s = -Σ λ d is negative by more than the rounding of its terms
template <int Dim>
bool holds_ball(const HalfSpaces<Dim>& planes, const FeasibilityResult<Dim>& ball) {
  double terms = 0;
  for (int k = 0; k <= Dim; ++k)
    if (ball.basis[k] >= 0) terms += std::abs(ball.multipliers[k] * planes[ball.basis[k]].offset);
  return ball.status == FeasibilityStatus::optimal && -ball.value > ball_rounding * terms;
}

// faces that bound nothing (a plane that touches an edge or a corner within rounding) go
template <int Dim>
void drop_empty_faces(Polytope<Dim>& part) {
  for (std::size_t f = part.faces.size(); f-- > 0;) {
    if (!part.loops[f].empty()) continue;
    part.faces.erase(part.faces.begin() + f);
    part.joints.erase(part.joints.begin() + f);
    part.loops.erase(part.loops.begin() + f);
  }
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
    normalise(planes[i]);
  }

  // the largest inscribed ball tells whether the planes enclose a solid at all
  FeasibilityResult<Dim> ball = solve_feasibility<Dim>(planes, {});
  if (static_cast<int>(planes.size()) <= Dim || !bounded(planes)) {
    result.status = BlockStatus::open;
    return result;
  }
  if (!holds_ball(planes, ball)) {
    result.status = BlockStatus::empty;
    return result;
  }

  // redundant planes go; of equal ones the last, and with it the newest joint, stays
  std::vector<bool> kept(planes.size(), true);
  for (std::size_t i = 0; i < planes.size(); ++i)
    kept[i] = needed(planes, kept, i, redundancy_tolerance * -ball.value);

  // from here on the faces stand in canonical order, and every bit of the part follows from them
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (kept[i]) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return before(planes[i], planes[j]); });
  for (const std::size_t i : order) {
    result.part.faces.push_back(planes[i]);
    result.part.joints.push_back(joints[i]);
  }
  ball = solve_feasibility<Dim>(result.part.faces, {});
  result.part.inscribed_radius = -ball.value;
  result.part.centre = ball.point;

  // seen from the ball's centre, the vertices depend on neither origin nor unit
  HalfSpaces<Dim> centred = result.part.faces;
  for (HalfSpace<Dim>& f : centred)
    f = moved_origin<Dim>(f, ball.point);
  double extent = 0;
  for (const Vector<Dim>& v : find_vertices(centred, redundancy_tolerance * result.part.inscribed_radius))
    extent = std::max(extent, v.norm());
  const double tolerance = merge_tolerance * extent;
  result.part.vertices = find_vertices(centred, tolerance);
  result.part.loops = find_loops(centred, result.part.vertices, 4 * tolerance);

  drop_empty_faces(result.part);
  result.part.mass = integrate(result.part.vertices, result.part.loops);
  const int fewest = static_cast<int>(std::min(result.part.faces.size(), result.part.vertices.size()));
  if (fewest <= Dim || !(result.part.mass.volume > 0)) {
    result.status = BlockStatus::flat;
    return result;
  }
  for (Vector<Dim>& v : result.part.vertices) {
    v += ball.point;
    result.part.radius = std::max(result.part.radius, v.norm());
  }
  result.part.mass = moved_origin<Dim>(result.part.mass, -ball.point);
  result.part.basis = solve_feasibility<Dim>(result.part.faces, {}).basis;
  return result;
}

template <>
HalfSpaces<2> hull_planes(const std::vector<Vector<2>>& stated, int* hidden) {
  const std::vector<Vector<2>> points = sorted<2>(stated);
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
HalfSpaces<3> hull_planes(const std::vector<Vector<3>>& stated, int* hidden) {
  const std::vector<Vector<3>> points = sorted<3>(stated);
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
