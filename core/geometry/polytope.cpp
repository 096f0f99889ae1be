#include "core/geometry/polytope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/half_space_inl.hpp"

namespace voussoir {
namespace {

// Axes fitted to the spread of the vertices: the first along the farthest, the second along the largest remainder. The
// determinant of a sliver's edges has no large terms that cancel, whatever the sliver's orientation.
Matrix<2> fitted_axes(const std::vector<Vector<2>>& vertices, const Vector<2>& middle) {
  Vector<2> first = Vector<2>::Zero();
  for (const Vector<2>& v : vertices)
    if ((v - middle).squaredNorm() > first.squaredNorm()) first = v - middle;
  if (first.isZero(0)) return Matrix<2>::Identity();
  first.normalize();
  Matrix<2> axes;
  axes << first.transpose(), perpendicular(first).transpose();
  return axes;
}

Matrix<3> fitted_axes(const std::vector<Vector<3>>& vertices, const Vector<3>& middle) {
  Vector<3> first = Vector<3>::Zero(), second = first;
  for (const Vector<3>& v : vertices)
    if ((v - middle).squaredNorm() > first.squaredNorm()) first = v - middle;
  if (first.isZero(0)) return Matrix<3>::Identity();
  first.normalize();
  for (const Vector<3>& v : vertices) {
    const Vector<3> remainder = v - middle - first.dot(v - middle) * first;
    if (remainder.squaredNorm() > second.squaredNorm()) second = remainder;
  }
  second -= first.dot(second) * first;
  second = second.isZero(0) ? perpendicular(first) : Vector<3>(second.normalized());
  Matrix<3> axes;
  axes << first.transpose(), second.transpose(), first.cross(second).transpose();
  return axes;
}

// signed volume and moments of the simplex (origin, corners…)
template <int Dim>
MassProperties<Dim> simplex(const Matrix<Dim>& axes, const std::array<Vector<Dim>, Dim>& corner) {
  Matrix<Dim> edges;
  for (int k = 0; k < Dim; ++k)
    edges.col(k) = axes * corner[k];
  MassProperties<Dim> m;
  m.volume = edges.determinant() / (Dim == 3 ? 6.0 : 2.0);
  Vector<Dim> sum = Vector<Dim>::Zero();
  for (const Vector<Dim>& c : corner)
    sum += c;
  m.centroid = sum / (Dim + 1);
  // ∫ x xᵀ over a simplex with one corner at the origin: V/((D+1)(D+2)) (Σ c cᵀ + (Σc)(Σc)ᵀ)
  m.second_moment = sum * sum.transpose();
  for (const Vector<Dim>& c : corner)
    m.second_moment += c * c.transpose();
  m.second_moment *= m.volume / ((Dim + 1) * (Dim + 2));
  return m;
}

template <int Dim>
void add(MassProperties<Dim>& total, const MassProperties<Dim>& m) {
  total.volume += m.volume;
  total.centroid += m.volume * m.centroid;
  total.second_moment += m.second_moment;
}

void add_face(MassProperties<2>& total, const Matrix<2>& axes, const std::vector<Vector<2>>& v,
              const std::vector<int>& loop, const Vector<2>& c) {
  add<2>(total, simplex<2>(axes, {v[loop[0]] - c, v[loop[1]] - c}));
}

void add_face(MassProperties<3>& total, const Matrix<3>& axes, const std::vector<Vector<3>>& v,
              const std::vector<int>& loop, const Vector<3>& c) {
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    add<3>(total, simplex<3>(axes, {v[loop[0]] - c, v[loop[k]] - c, v[loop[k + 1]] - c}));
}

}  // namespace

template <int Dim>
MassProperties<Dim> integrate(const std::vector<Vector<Dim>>& vertices, const std::vector<std::vector<int>>& loops) {
  Vector<Dim> middle = Vector<Dim>::Zero();
  for (const Vector<Dim>& v : vertices)
    middle += v;
  middle /= static_cast<double>(std::max<std::size_t>(vertices.size(), 1));
  const Matrix<Dim> axes = fitted_axes(vertices, middle);
  MassProperties<Dim> total;
  for (const std::vector<int>& loop : loops)
    if (!loop.empty()) add_face(total, axes, vertices, loop, middle);
  if (total.volume > 0) total.centroid /= total.volume;
  return moved_origin<Dim>(total, -middle);
}

template <int Dim>
MassProperties<Dim> moved_origin(const MassProperties<Dim>& mass, const Vector<Dim>& shift) {
  MassProperties<Dim> moved = mass;
  const Vector<Dim> c = mass.centroid;
  moved.centroid = c - shift;
  moved.second_moment += mass.volume * (shift * shift.transpose() - c * shift.transpose() - shift * c.transpose());
  return moved;
}

template <>
double face_area(const std::vector<Vector<2>>& vertices, const std::vector<int>& loop) {
  return loop.size() < 2 ? 0 : (vertices[loop[1]] - vertices[loop[0]]).norm();
}

template <>
double face_area(const std::vector<Vector<3>>& vertices, const std::vector<int>& loop) {
  Vector<3> twice = Vector<3>::Zero();
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    twice += (vertices[loop[k]] - vertices[loop[0]]).cross(vertices[loop[k + 1]] - vertices[loop[0]]);
  return 0.5 * twice.norm();
}

template <>
Vector<2> face_centroid(const std::vector<Vector<2>>& vertices, const std::vector<int>& loop, const Vector<2>&) {
  return 0.5 * (vertices[loop[0]] + vertices[loop[1]]);
}

// by triangles around the first corner
template <>
Vector<3> face_centroid(const std::vector<Vector<3>>& vertices, const std::vector<int>& loop, const Vector<3>& normal) {
  const Vector<3>& corner = vertices[loop[0]];
  Vector<3> moment = Vector<3>::Zero();
  double area = 0;
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    const Vector<3> u = vertices[loop[k]] - corner, v = vertices[loop[k + 1]] - corner;
    const double piece = u.cross(v).dot(normal);
    area += piece;
    moment += piece / 3 * (u + v);
  }
  return area > 0 ? Vector<3>(corner + moment / area) : corner;
}

template <int Dim>
double find_largest_face(const Polytope<Dim>& part) {
  double largest = 0;
  for (std::size_t f = 0; f < part.faces.size(); ++f)
    largest = std::max(largest, face_area<Dim>(part, static_cast<int>(f)));
  return largest;
}

template <int Dim>
Polytope<Dim> moved_origin(Polytope<Dim> part, const Vector<Dim>& shift) {
  for (HalfSpace<Dim>& f : part.faces)
    f = moved_origin(f, shift);
  part.radius = 0;
  for (Vector<Dim>& v : part.vertices) {
    v -= shift;
    part.radius = std::max(part.radius, v.norm());
  }
  part.mass = moved_origin<Dim>(part.mass, shift);
  part.centre -= shift;
  part.vertex_error = find_vertex_error(part);
  part.largest_face = find_largest_face(part);
  return part;
}

Matrix<3> inertia_tensor(const MassProperties<3>& mass) {
  // not trace - diagonal: a needle's smallest moment would drown in its largest
  const Matrix<3>& m = mass.second_moment;
  Matrix<3> tensor = -m;
  tensor.diagonal() << m(1, 1) + m(2, 2), m(0, 0) + m(2, 2), m(0, 0) + m(1, 1);
  return tensor;
}

double inertia_tensor(const MassProperties<2>& mass) {
  return mass.second_moment.trace();
}

template MassProperties<2> integrate<2>(const std::vector<Vector<2>>&, const std::vector<std::vector<int>>&);
template MassProperties<3> integrate<3>(const std::vector<Vector<3>>&, const std::vector<std::vector<int>>&);
// The distance of the hull of unit vectors from the origin, from below, by Gilbert's method: it approaches the point of
// the hull closest to the origin, and every iterate bounds the distance.
template <int Dim>
double distance_of_hull(const std::vector<Vector<Dim>>& vectors) {
  constexpr int most_iterations = 64;
  constexpr double good_enough = 0.5;
  Vector<Dim> x = Vector<Dim>::Zero();
  for (const Vector<Dim>& v : vectors)
    x += v / static_cast<double>(vectors.size());
  double bound = 0;
  for (int k = 0; k < most_iterations; ++k) {
    const double length = x.norm();
    if (!(length > 0)) return 0;
    const Vector<Dim>* least = &vectors.front();
    for (const Vector<Dim>& v : vectors)
      if (v.dot(x) < least->dot(x)) least = &v;
    bound = std::max(bound, least->dot(x) / length);
    if (bound >= good_enough * length) break;
    const Vector<Dim> towards = *least - x;
    x += std::clamp(-x.dot(towards) / towards.squaredNorm(), 0.0, 1.0) * towards;
  }
  return bound;
}

// At the corner where w·x is largest, w = Σ μ a over its faces, and w·x = Σ μ d exceeds w·v by at most Σ μ times the
// largest slack of the computed corner v; Σ μ is at most one over the distance of the normals' hull from the origin.
template <int Dim>
double find_vertex_error(const Polytope<Dim>& part) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  std::vector<std::vector<Vector<Dim>>> normals(part.vertices.size());
  std::vector<double> slack(part.vertices.size(), 0);
  for (std::size_t f = 0; f < part.faces.size(); ++f)
    for (const int v : part.loops[f]) {
      normals[v].push_back(part.faces[f].normal);
      slack[v] = std::max(slack[v], std::abs(signed_distance(part.faces[f], part.vertices[v])));
    }
  double worst = 0;
  for (std::size_t v = 0; v < part.vertices.size(); ++v) {
    const double distance = normals[v].empty() ? 0 : distance_of_hull<Dim>(normals[v]);
    if (!(distance > rounding)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, (slack[v] + rounding * part.vertices[v].norm()) / distance);
  }
  return worst;
}

std::vector<int> boundary_ring(const Polytope<2>& part) {
  std::vector<int> next(part.vertices.size(), -1);
  for (const std::vector<int>& edge : part.loops)
    if (edge.size() == 2) next[edge[0]] = edge[1];
  std::vector<int> outline;
  int vertex = 0;
  do {
    outline.push_back(vertex);
    vertex = next[vertex];
  } while (vertex > 0 && outline.size() < next.size());
  return outline;
}

template double find_largest_face<2>(const Polytope<2>&);
template double find_largest_face<3>(const Polytope<3>&);
template double find_vertex_error<2>(const Polytope<2>&);
template double find_vertex_error<3>(const Polytope<3>&);
template MassProperties<2> moved_origin<2>(const MassProperties<2>&, const Vector<2>&);
template MassProperties<3> moved_origin<3>(const MassProperties<3>&, const Vector<3>&);
template Polytope<2> moved_origin<2>(Polytope<2>, const Vector<2>&);
template Polytope<3> moved_origin<3>(Polytope<3>, const Vector<3>&);

}  // namespace voussoir
