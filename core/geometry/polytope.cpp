#include "core/geometry/polytope.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

// Axes fitted to the spread of the vertices: the first along the farthest, the second along the largest remainder. The
// determinant of a sliver's edges has no large terms in them that cancel, whatever the sliver's orientation.
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
double face_area(const Polytope<2>& part, int face) {
  const std::vector<int>& loop = part.loops[face];
  return loop.size() < 2 ? 0 : (part.vertices[loop[1]] - part.vertices[loop[0]]).norm();
}

template <>
double face_area(const Polytope<3>& part, int face) {
  const std::vector<int>& loop = part.loops[face];
  Vector<3> twice = Vector<3>::Zero();
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    twice +=
        (part.vertices[loop[k]] - part.vertices[loop[0]]).cross(part.vertices[loop[k + 1]] - part.vertices[loop[0]]);
  return 0.5 * twice.norm();
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
template MassProperties<2> moved_origin<2>(const MassProperties<2>&, const Vector<2>&);
template MassProperties<3> moved_origin<3>(const MassProperties<3>&, const Vector<3>&);
template Polytope<2> moved_origin<2>(Polytope<2>, const Vector<2>&);
template Polytope<3> moved_origin<3>(Polytope<3>, const Vector<3>&);

}  // namespace voussoir
