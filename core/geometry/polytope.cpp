#include "core/geometry/polytope.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

// the point where Dim planes meet; false when they are parallel within rounding
bool intersect(const HalfSpaces<2>& f, std::array<int, 2> index, Vector<2>& point) {
  Matrix<2> a;
  a << f[index[0]].normal.transpose(), f[index[1]].normal.transpose();
  const double determinant = a.determinant();
  if (std::abs(determinant) < 1e-12) return false;  // unit normals: the sine of the angle between them
  point = a.inverse() * Vector<2>(f[index[0]].offset, f[index[1]].offset);
  return true;
}

bool intersect(const HalfSpaces<3>& f, std::array<int, 3> index, Vector<3>& point) {
  Matrix<3> a;
  a << f[index[0]].normal.transpose(), f[index[1]].normal.transpose(), f[index[2]].normal.transpose();
  const Vector<3> d(f[index[0]].offset, f[index[1]].offset, f[index[2]].offset);
  const double determinant = a.determinant();
  if (std::abs(determinant) < 1e-12) return false;
  point = a.inverse() * d;
  // one step of iterative refinement: thin wedges lose digits in the explicit inverse
  point += a.inverse() * (d - a * point);
  return true;
}

template <int Dim>
bool inside(const HalfSpaces<Dim>& faces, const Vector<Dim>& point, double tolerance) {
  return std::all_of(faces.begin(), faces.end(),
                     [&](const HalfSpace<Dim>& f) { return signed_distance(f, point) <= tolerance; });
}

template <int Dim>
void add_unless_known(std::vector<Vector<Dim>>& vertices, const Vector<Dim>& point, double tolerance) {
  for (const Vector<Dim>& v : vertices)
    if ((v - point).cwiseAbs().maxCoeff() <= tolerance) return;
  vertices.push_back(point);
}

// signed volume and moments of the simplex (origin, corners…)
template <int Dim>
MassProperties<Dim> simplex(const std::array<Vector<Dim>, Dim>& corner) {
  Matrix<Dim> edges;
  for (int k = 0; k < Dim; ++k)
    edges.col(k) = corner[k];
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

void add_face(MassProperties<2>& total, const std::vector<Vector<2>>& v, const std::vector<int>& loop,
              const Vector<2>& c) {
  const MassProperties<2> m = simplex<2>({v[loop[0]] - c, v[loop[1]] - c});
  total.volume += m.volume;
  total.centroid += m.volume * m.centroid;
  total.second_moment += m.second_moment;
}

void add_face(MassProperties<3>& total, const std::vector<Vector<3>>& v, const std::vector<int>& loop,
              const Vector<3>& c) {
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    const MassProperties<3> m = simplex<3>({v[loop[0]] - c, v[loop[k]] - c, v[loop[k + 1]] - c});
    total.volume += m.volume;
    total.centroid += m.volume * m.centroid;
    total.second_moment += m.second_moment;
  }
}

void sort_loop(std::vector<int>& loop, const std::vector<Vector<2>>& v, const Vector<2>& normal) {
  const Vector<2> along = perpendicular(normal);  // the solid lies to the left of this direction
  std::sort(loop.begin(), loop.end(), [&](int i, int j) { return along.dot(v[i]) < along.dot(v[j]); });
  if (loop.size() > 2) loop = {loop.front(), loop.back()};
}

void sort_loop(std::vector<int>& loop, const std::vector<Vector<3>>& v, const Vector<3>& normal) {
  Vector<3> middle = Vector<3>::Zero();
  for (int i : loop)
    middle += v[i];
  middle /= static_cast<double>(std::max<std::size_t>(loop.size(), 1));
  const Vector<3> e1 = perpendicular(normal), e2 = normal.cross(e1);
  auto angle = [&](int i) { return std::atan2(e2.dot(v[i] - middle), e1.dot(v[i] - middle)); };
  std::sort(loop.begin(), loop.end(), [&](int i, int j) { return angle(i) < angle(j); });
}

}  // namespace

template <>
std::vector<Vector<2>> find_vertices(const HalfSpaces<2>& faces, double tolerance) {
  std::vector<Vector<2>> vertices;
  const int n = static_cast<int>(faces.size());
  Vector<2> p;
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      if (intersect(faces, {i, j}, p) && inside(faces, p, tolerance)) add_unless_known(vertices, p, tolerance);
  return vertices;
}

template <>
std::vector<Vector<3>> find_vertices(const HalfSpaces<3>& faces, double tolerance) {
  std::vector<Vector<3>> vertices;
  const int n = static_cast<int>(faces.size());
  Vector<3> p;
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      for (int k = j + 1; k < n; ++k)
        if (intersect(faces, {i, j, k}, p) && inside(faces, p, tolerance)) add_unless_known(vertices, p, tolerance);
  return vertices;
}

template <int Dim>
std::vector<std::vector<int>> find_loops(const HalfSpaces<Dim>& faces, const std::vector<Vector<Dim>>& vertices,
                                         double tolerance) {
  std::vector<std::vector<int>> loops(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t v = 0; v < vertices.size(); ++v)
      if (std::abs(signed_distance(faces[f], vertices[v])) <= tolerance) loops[f].push_back(static_cast<int>(v));
    if (static_cast<int>(loops[f].size()) < Dim)
      loops[f].clear();  // a plane that only touches an edge or a corner bounds no face
    else
      sort_loop(loops[f], vertices, faces[f].normal);
  }
  return loops;
}

template <int Dim>
MassProperties<Dim> integrate(const std::vector<Vector<Dim>>& vertices, const std::vector<std::vector<int>>& loops) {
  Vector<Dim> middle = Vector<Dim>::Zero();
  for (const Vector<Dim>& v : vertices)
    middle += v;
  middle /= static_cast<double>(std::max<std::size_t>(vertices.size(), 1));
  MassProperties<Dim> total;
  for (const std::vector<int>& loop : loops)
    if (!loop.empty()) add_face(total, vertices, loop, middle);
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

template std::vector<std::vector<int>> find_loops<2>(const HalfSpaces<2>&, const std::vector<Vector<2>>&, double);
template std::vector<std::vector<int>> find_loops<3>(const HalfSpaces<3>&, const std::vector<Vector<3>>&, double);
template MassProperties<2> integrate<2>(const std::vector<Vector<2>>&, const std::vector<std::vector<int>>&);
template MassProperties<3> integrate<3>(const std::vector<Vector<3>>&, const std::vector<std::vector<int>>&);
template MassProperties<2> moved_origin<2>(const MassProperties<2>&, const Vector<2>&);
template MassProperties<3> moved_origin<3>(const MassProperties<3>&, const Vector<3>&);
template Polytope<2> moved_origin<2>(Polytope<2>, const Vector<2>&);
template Polytope<3> moved_origin<3>(Polytope<3>, const Vector<3>&);

}  // namespace voussoir
