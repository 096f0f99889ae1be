#include "core/load/boundary_stress.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace voussoir {
namespace {

// a point of a face, and the part of the area that it represents
template <int Dim>
struct FacePoint {
  Vector<Dim> place;  // m
  double area;        // m² (2-D: m)
};

template <int Dim>
using Corners = std::vector<Vector<Dim>>;  // of a face, in order around it

// The pieces of a face below and above an elevation, over each of which the stress is linear: the face itself if it is
// entirely on one side.
template <int Dim>
std::vector<Corners<Dim>> split_at(Corners<Dim> face, double elevation) {
  const auto height = [&](const Vector<Dim>& corner) { return corner[Dim - 1] - elevation; };
  const auto is_below = [&](const Vector<Dim>& corner) { return height(corner) < 0; };
  const auto is_above = [&](const Vector<Dim>& corner) { return height(corner) > 0; };
  if (std::ranges::none_of(face, is_below) || std::ranges::none_of(face, is_above)) return {std::move(face)};
  Corners<Dim> below, above;
  const std::size_t edges = Dim == 2 ? 1 : face.size();  // a face in the plane is one edge, not a ring
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Vector<Dim>&a = face[k], &b = face[(k + 1) % face.size()];
    if (!is_above(a)) below.push_back(a);
    if (!is_below(a)) above.push_back(a);
    if (k >= edges || !((is_below(a) && is_above(b)) || (is_above(a) && is_below(b)))) continue;
    const Vector<Dim> crossing = a + height(a) / (height(a) - height(b)) * (b - a);
    below.push_back(crossing);
    above.push_back(crossing);
  }
  return {std::move(below), std::move(above)};
}

// Gauss's two points: exact to the third order
std::vector<FacePoint<2>> face_points(const Corners<2>& edge, const Vector<2>&) {
  const Vector<2>&a = edge[0], &b = edge[1];
  const Vector<2> middle = 0.5 * (a + b), arm = (b - a) / std::sqrt(12.0);
  const double half = 0.5 * (b - a).norm();
  return {{middle - arm, half}, {middle + arm, half}};
}

// the middles of the sides of triangles around the first corner: exact to the second order
std::vector<FacePoint<3>> face_points(const Corners<3>& ring, const Vector<3>& normal) {
  const Vector<3>& corner = ring[0];
  std::vector<FacePoint<3>> points;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    const Vector<3>&u = ring[k], &v = ring[k + 1];
    const double third = (u - corner).cross(v - corner).dot(normal) / 6;
    for (const Vector<3>& middle :
         {Vector<3>(0.5 * (corner + u)), Vector<3>(0.5 * (u + v)), Vector<3>(0.5 * (v + corner))})
      points.push_back({middle, third});
  }
  return points;
}

}  // namespace

template <int Dim>
Matrix<Dim> DepthStress<Dim>::at(const Vector<Dim>& point) const {
  return above + std::max(0.0, surface - point[Dim - 1]) * per_depth;
}

template <int Dim>
std::vector<DeadLoad<Dim>> boundary_loads(const Polytope<Dim>& part, const DepthStress<Dim>& stress) {
  if (stress.per_depth.isZero(0)) return boundary_loads<Dim>(part, stress.above);
  std::vector<DeadLoad<Dim>> loads;
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    if (part.joints[f] != no_joint || static_cast<int>(part.loops[f].size()) < Dim) continue;
    Corners<Dim> corners;
    for (const int v : part.loops[f])
      corners.push_back(part.vertices[v]);
    const Vector<Dim>& normal = part.faces[f].normal;
    for (const Corners<Dim>& piece : split_at<Dim>(std::move(corners), stress.surface))
      for (const FacePoint<Dim>& at : face_points(piece, normal)) {
        const Vector<Dim> force = -at.area * (stress.at(at.place) * normal);
        if (!force.isZero(0)) loads.push_back({at.place, force});
      }
  }
  return loads;
}

template <int Dim>
std::vector<DeadLoad<Dim>> boundary_loads(const Polytope<Dim>& part, const Matrix<Dim>& stress) {
  std::vector<DeadLoad<Dim>> loads;
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    if (part.joints[f] != no_joint || static_cast<int>(part.loops[f].size()) < Dim) continue;
    const Vector<Dim> force = -face_area<Dim>(part, static_cast<int>(f)) * (stress * part.faces[f].normal);
    if (!force.isZero(0))
      loads.push_back({face_centroid<Dim>(part.vertices, part.loops[f], part.faces[f].normal), force});
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

template struct DepthStress<2>;
template struct DepthStress<3>;
template std::vector<DeadLoad<2>> boundary_loads(const Polytope<2>&, const Matrix<2>&);
template std::vector<DeadLoad<3>> boundary_loads(const Polytope<3>&, const Matrix<3>&);
template std::vector<DeadLoad<2>> boundary_loads(const Polytope<2>&, const DepthStress<2>&);
template std::vector<DeadLoad<3>> boundary_loads(const Polytope<3>&, const DepthStress<3>&);

}  // namespace voussoir
