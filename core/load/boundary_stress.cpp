#include "core/load/boundary_stress.hpp"

namespace voussoir {
namespace {

Vector<2> face_centroid(const Polytope<2>& part, std::size_t face) {
  const std::vector<int>& loop = part.loops[face];
  return 0.5 * (part.vertices[loop[0]] + part.vertices[loop[1]]);
}

// by triangles around the first corner
Vector<3> face_centroid(const Polytope<3>& part, std::size_t face) {
  const std::vector<int>& loop = part.loops[face];
  const Vector<3>& corner = part.vertices[loop[0]];
  Vector<3> moment = Vector<3>::Zero();
  double area = 0;
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    const Vector<3> u = part.vertices[loop[k]] - corner, v = part.vertices[loop[k + 1]] - corner;
    const double piece = u.cross(v).dot(part.faces[face].normal);
    area += piece;
    moment += piece / 3 * (u + v);
  }
  return area > 0 ? Vector<3>(corner + moment / area) : corner;
}

}  // namespace

template <int Dim>
std::vector<DeadLoad<Dim>> boundary_loads(const Polytope<Dim>& part, const Matrix<Dim>& stress) {
  std::vector<DeadLoad<Dim>> loads;
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    if (part.joints[f] != no_joint || static_cast<int>(part.loops[f].size()) < Dim) continue;
    const Vector<Dim> force = -face_area<Dim>(part, static_cast<int>(f)) * (stress * part.faces[f].normal);
    if (!force.isZero(0)) loads.push_back({face_centroid(part, f), force});
  }
  return loads;
}

Matrix<2> stress_tensor_2d(const std::vector<double>& c) {
  Matrix<2> stress;
  stress << c[0], c[2], c[2], c[1];
  return stress;
}

Matrix<3> stress_tensor_3d(const std::vector<double>& c) {
  Matrix<3> stress;
  stress << c[0], c[5], c[4], c[5], c[1], c[3], c[4], c[3], c[2];
  return stress;
}

template std::vector<DeadLoad<2>> boundary_loads(const Polytope<2>&, const Matrix<2>&);
template std::vector<DeadLoad<3>> boundary_loads(const Polytope<3>&, const Matrix<3>&);

}  // namespace voussoir
