#include "core/slicing/block.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/geometry/facet_weights.hpp"
#include "core/geometry/half_space_inl.hpp"
#include "core/geometry/surface.hpp"
#include "core/solvers/feasibility.hpp"

namespace voussoir {
namespace {

// points closer than this times the extent of a hull are one
constexpr double merge_tolerance = 1e-10;

// a plane that would cut off less than this times the inscribed radius is redundant
constexpr double redundancy_tolerance = 1e-10;

// an inscribed ball smaller than this times the offsets it follows from is their rounding: planes that only touch
constexpr double ball_rounding = 64 * std::numeric_limits<double>::epsilon();

// Coordinates have an error of 2e-16 of the extent and of the distance from the origin. If that is close to the
// inscribed radius few digits of volume and overlap remain: such a block is refused.
constexpr double thinnest = 1e-8;                                                // inscribed radius / extent
constexpr double farthest_ball = 1e-6 / std::numeric_limits<double>::epsilon();  // distance / inscribed radius

template <int Dim>
bool valid(const HalfSpace<Dim>& plane) {
  return plane.normal.allFinite() && std::isfinite(plane.offset) && plane.normal.norm() > 0;
}

// A normal that is unit to rounding is kept: a plane normalised again at every later cut would have other bits if the
// cuts were made in another order.
template <int Dim>
void normalise(HalfSpace<Dim>& plane) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  const double norm = plane.normal.norm();
  if (std::abs(norm - 1) <= rounding) return;
  plane.normal /= norm;
  plane.offset /= norm;
}

// the order of a part's faces, for any order of its planes in the input
template <int Dim>
bool before(const HalfSpace<Dim>& a, const HalfSpace<Dim>& b) {
  for (int k = 0; k < Dim; ++k)
    if (a.normal[k] != b.normal[k]) return a.normal[k] < b.normal[k];
  return a.offset < b.offset;
}

// corners by their coordinates: planes through them must not round differently when they are listed in another order
template <int Dim>
std::vector<Vector<Dim>> sorted(std::vector<Vector<Dim>> points) {
  std::sort(points.begin(), points.end(), [](const Vector<Dim>& a, const Vector<Dim>& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  return points;
}

// Bounded iff the recession cone {a_i·x <= 0} has no direction: along no axis, in either sense, can a point continue
// endlessly.
template <int Dim>
bool bounded(const HalfSpaces<Dim>& planes) {
  constexpr double rounding = 1e-12;  // of unit normals; a needle of aspect 1e6 still gives 1e-6
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

// seen from the ball's centre, the surface depends on neither origin nor unit
template <int Dim>
Surface<Dim> surface_around(HalfSpaces<Dim> planes, const FeasibilityResult<Dim>& ball) {
  for (HalfSpace<Dim>& p : planes)
    p = moved_origin<Dim>(p, ball.point);
  return find_surface<Dim>(planes, redundancy_tolerance * -ball.value);
}

template <int Dim>
double extent_of(const Surface<Dim>& surface) {
  double extent = 0;
  for (const Vector<Dim>& v : surface.vertices)
    extent = std::max(extent, v.norm());
  return extent;
}

template <int Dim>
BlockStatus judge(const Surface<Dim>& surface, double inscribed_radius) {
  if (surface.status == SurfaceStatus::open) return BlockStatus::open;
  const bool solid = surface.status == SurfaceStatus::ok && inscribed_radius >= thinnest * extent_of(surface);
  return solid ? BlockStatus::ok : BlockStatus::flat;
}

// whether the largest inscribed ball, of bounded planes, is that of a solid near enough to the origin
template <int Dim>
BlockStatus judge(const HalfSpaces<Dim>& planes, const FeasibilityResult<Dim>& ball) {
  // faces may be too nearly parallel for the program
  if (ball.status == FeasibilityStatus::iteration_limit) return BlockStatus::flat;
  if (!holds_ball(planes, ball)) return BlockStatus::empty;
  return ball.point.norm() > farthest_ball * std::abs(ball.value) ? BlockStatus::far : BlockStatus::ok;
}

// If fewer faces touch the inscribed ball than the LP has tight planes, as two opposite ones do, the rest of the basis
// is free: the faces most independent of the others take those places.
template <int Dim>
void complete_basis(Polytope<Dim>& part) {
  using Column = FixedMatrix<Dim + 1, 1>;
  const auto column = [&](std::size_t f) {
    Column c;
    c << part.faces[f].normal, 1;
    return c;
  };
  std::vector<Column> directions;  // orthonormal
  const auto remainder = [&](Column c) {
    for (int sweep = 0; sweep < 2; ++sweep)
      for (const Column& d : directions)
        c -= d.dot(c) * d;
    return c;
  };
  for (const int f : part.basis)
    if (f >= 0) directions.push_back(remainder(column(f)).normalized());
  for (int& place : part.basis) {
    if (place >= 0) continue;
    double largest = 0;
    for (std::size_t f = 0; f < part.faces.size(); ++f)
      if (const double left = remainder(column(f)).norm(); left > largest) {
        largest = left;
        place = static_cast<int>(f);
      }
    directions.push_back(remainder(column(place)).normalized());
  }
  FixedMatrix<Dim + 1, Dim + 1> columns;
  for (int k = 0; k <= Dim; ++k)
    columns.col(k) = column(part.basis[k]);
  part.basis_inverse = columns.inverse();
}

// the data that follow from a part's faces
template <int Dim>
BlockStatus describe(Polytope<Dim>& part) {
  const FeasibilityResult<Dim> ball = solve_feasibility<Dim>(part.faces, {});
  if (ball.status == FeasibilityStatus::iteration_limit) return BlockStatus::flat;
  part.inscribed_radius = -ball.value;
  part.centre = ball.point;
  part.basis = ball.basis;
  complete_basis(part);
  Surface<Dim> surface = surface_around(part.faces, ball);
  if (const BlockStatus status = judge(surface, part.inscribed_radius); status != BlockStatus::ok) return status;

  // a face that only just bounded the part may bound it no longer: all is recomputed without it
  for (std::size_t f = part.faces.size(); f-- > 0;) {
    if (!surface.loops[f].empty()) continue;
    part.faces.erase(part.faces.begin() + f);
    part.joints.erase(part.joints.begin() + f);
  }
  if (part.faces.size() < surface.loops.size()) return describe(part);

  part.vertices = std::move(surface.vertices);
  part.loops = std::move(surface.loops);
  part.mass = integrate(part.vertices, part.loops);
  const int fewest = static_cast<int>(std::min(part.faces.size(), part.vertices.size()));
  if (fewest <= Dim || !(part.mass.volume > 0)) return BlockStatus::flat;
  for (Vector<Dim>& v : part.vertices) {
    v += ball.point;
    part.radius = std::max(part.radius, v.norm());
  }
  part.mass = moved_origin<Dim>(part.mass, -ball.point);
  part.vertex_error = find_vertex_error(part);
  part.largest_face = find_largest_face(part);
  part.face_weights = facet_weights<Dim>(part.faces);
  return BlockStatus::ok;
}

// Faces in canonical order: every bit of the part follows from them.
template <int Dim>
void fill(BlockResult<Dim>& result, const HalfSpaces<Dim>& planes, const std::vector<int>& joints,
          std::vector<std::size_t> kept) {
  std::sort(kept.begin(), kept.end(), [&](std::size_t i, std::size_t j) { return before(planes[i], planes[j]); });
  for (const std::size_t i : kept) {
    result.part.faces.push_back(planes[i]);
    result.part.joints.push_back(joints[i]);
  }
  result.status = describe(result.part);
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

  // the largest inscribed ball shows whether the planes enclose a solid at all
  const FeasibilityResult<Dim> ball = solve_feasibility<Dim>(planes, {});
  if (static_cast<int>(planes.size()) <= Dim || !bounded(planes)) {
    result.status = BlockStatus::open;
    return result;
  }
  result.status = judge(planes, ball);
  if (result.status != BlockStatus::ok) return result;

  // redundant planes (Eq. 3.8) have no loop and are dropped; of equal ones the last is kept, and with it the newest
  // joint
  const Surface<Dim> all = surface_around(planes, ball);
  result.status = judge(all, -ball.value);
  if (result.status != BlockStatus::ok) return result;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (!all.loops[i].empty()) kept.push_back(i);
  fill(result, planes, joints, std::move(kept));
  return result;
}

template <int Dim>
Draft<Dim> make_draft(const Polytope<Dim>& part) {
  Draft<Dim> draft{part.faces, part.joints, part.vertices, solve_feasibility<Dim>(part.faces, {}), 0};
  for (const Vector<Dim>& v : part.vertices)
    draft.extent = std::max(draft.extent, (v - draft.ball.point).norm());
  return draft;
}

template <int Dim>
BlockStatus cut_draft(const Draft<Dim>& whole, const HalfSpace<Dim>& plane, int joint, Draft<Dim>& below) {
  HalfSpaces<Dim> planes = whole.faces;
  planes.push_back(plane);
  const bool warm = *std::min_element(whole.ball.basis.begin(), whole.ball.basis.end()) >= 0;
  FeasibilityRequest<Dim> request;
  if (warm) request.start = &whole.ball.basis;
  below.ball = solve_feasibility<Dim>(planes, request);
  if (const BlockStatus status = judge(planes, below.ball); status != BlockStatus::ok) return status;

  Surface<Dim> surface = surface_around(planes, below.ball);
  if (const BlockStatus status = judge(surface, below.inscribed_radius() / 2); status != BlockStatus::ok) return status;
  below.extent = extent_of(surface);
  below.vertices = std::move(surface.vertices);
  for (Vector<Dim>& v : below.vertices)
    v += below.ball.point;

  // faces that the cut removed are dropped, and with them their numbers in the ball's basis
  std::vector<int> number(planes.size(), -1);
  below.faces.clear();
  below.joints.clear();
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (surface.loops[i].empty()) continue;
    number[i] = static_cast<int>(below.faces.size());
    below.faces.push_back(planes[i]);
    below.joints.push_back(i < whole.joints.size() ? whole.joints[i] : joint);
  }
  for (int& face : below.ball.basis)
    if (face >= 0) face = number[face];
  return BlockStatus::ok;
}

template <int Dim>
BlockResult<Dim> finish(Draft<Dim> draft) {
  std::vector<std::size_t> all(draft.faces.size());
  std::iota(all.begin(), all.end(), 0);
  BlockResult<Dim> result;
  fill(result, draft.faces, draft.joints, std::move(all));
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
      if (!extreme || inner) continue;  // only the full edge counts, from corner to corner
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
template Draft<2> make_draft<2>(const Polytope<2>&);
template Draft<3> make_draft<3>(const Polytope<3>&);
template BlockStatus cut_draft<2>(const Draft<2>&, const HalfSpace<2>&, int, Draft<2>&);
template BlockStatus cut_draft<3>(const Draft<3>&, const HalfSpace<3>&, int, Draft<3>&);
template BlockResult<2> finish<2>(Draft<2>);
template BlockResult<3> finish<3>(Draft<3>);

}  // namespace voussoir
