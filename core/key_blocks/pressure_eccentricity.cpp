#include "core/key_blocks/pressure_eccentricity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/solvers/feasibility.hpp"

namespace voussoir {
namespace {

constexpr double beyond_all = std::numeric_limits<double>::infinity();
constexpr double no_moment = 1e-9;  // of force times size: a moment below it is rounding

// a loaded face and the moments that its pressure can give about its centroid, N m at its normal force
template <int Dim>
std::vector<Spin<Dim>> moments_of_face(const Assembly<Dim>& assembly, const Block<Dim>& block, int face,
                                       const Vector<Dim>& force) {
  std::vector<Spin<Dim>> moments;
  for (std::size_t c = 0; c < block.contacts.size(); ++c) {
    if (block.face_of_contact[c] != face) continue;
    for (const Vector<Dim>& corner : assembly.contacts.corners_of(assembly.contacts.list[block.contacts[c]]))
      moments.push_back(moment(Vector<Dim>(corner - block.faces[face].centroid), force));
  }
  return moments;
}

// the moment about the block's centroid in pure sliding with the pressures at the faces' centroids
template <int Dim>
Spin<Dim> moment_of_sliding(const Block<Dim>& block, const BoltedVerdict<Dim>& bolted,
                            const std::vector<Vector<Dim>>& forces) {
  const Verdict<Dim>& verdict = bolted.verdict;
  const Vector<Dim> along = verdict.direction();
  Spin<Dim> sum = block.stated.moment + block.water.moment;
  const auto add = [&](const Vector<Dim>& place, const Vector<Dim>& force) {
    sum += moment(Vector<Dim>(place - block.centroid), force);
  };
  for (int k = 0; k < verdict.loaded; ++k)
    add(block.faces[verdict.faces[k]].centroid, forces[k]);
  for (const RockFace<Dim>& face : block.faces)
    if (face.cohesion > 0 && slides_along(face, along))
      add(face.centroid, Vector<Dim>(-face.cohesion / *bolted.factor * along));
  for (const BlockBolt<Dim>& bolt : block.bolts)
    add(bolt.place, Vector<Dim>(bolt.capacity * bolt.direction));
  return sum;
}

double largest(const std::vector<Spin<2>>& moments, double sign) {
  double most = 0;
  for (const Spin<2>& m : moments)
    most = std::max(most, sign * m[0]);
  return most;
}

// the least κ for which `needed` is κ times a moment of the hull of `corners`, which contains zero
template <int Space>
double gauge(const std::vector<Vector<Space>>& corners, const Vector<Space>& needed, double scale) {
  // With planes z·w - 1 <= s and -m·w <= s the least s is -κ/(1 + κ)
  HalfSpaces<Space> planes;
  for (const Vector<Space>& z : corners)
    planes.push_back({z / scale, 1});
  planes.push_back({-needed / scale, 0});
  const FeasibilityResult<Space> result = solve_feasibility<Space>(planes, {});
  if (result.status == FeasibilityStatus::unbounded || 1 + result.value <= no_moment) return beyond_all;
  return -result.value / (1 + result.value);
}

double gauge_of_faces(const std::vector<std::vector<Spin<3>>>& faces, const std::vector<Vector<3>>& forces,
                      const Spin<3>& needed, double scale) {
  if (faces.size() == 1) {  // all its moments are perpendicular to its force
    const Vector<3> normal = forces[0].normalized(), first = perpendicular(normal), second = normal.cross(first);
    if (std::abs(needed.dot(normal)) > no_moment * scale) return beyond_all;
    std::vector<Vector<2>> corners;
    for (const Spin<3>& z : faces[0])
      corners.emplace_back(first.dot(z), second.dot(z));
    return gauge<2>(corners, {first.dot(needed), second.dot(needed)}, scale);
  }
  std::vector<Vector<3>> corners;
  for (const Spin<3>& a : faces[0])
    for (const Spin<3>& b : faces[1])
      corners.push_back(a + b);
  return gauge<3>(corners, needed, scale);
}

double gauge_of_faces(const std::vector<std::vector<Spin<2>>>& faces, const std::vector<Vector<2>>&,
                      const Spin<2>& needed, double) {
  const double sign = needed[0] < 0 ? -1 : 1, most = largest(faces[0], sign);
  return most > 0 ? sign * needed[0] / most : beyond_all;
}

}  // namespace

template <int Dim>
std::optional<double> pressure_eccentricity(const Assembly<Dim>& assembly, const Block<Dim>& block,
                                            const BoltedVerdict<Dim>& bolted) {
  const Verdict<Dim>& verdict = bolted.verdict;
  if (verdict.kind != BlockKind::slides || !bolted.factor || !(*bolted.factor > 0)) return std::nullopt;
  std::vector<Vector<Dim>> forces;
  std::vector<std::vector<Spin<Dim>>> faces;
  double size = 0;
  for (int k = 0; k < verdict.loaded; ++k) {
    const RockFace<Dim>& face = block.faces[verdict.faces[k]];
    forces.push_back(verdict.forces[k] * face.normal -
                     face.friction_force(verdict.forces[k]) / *bolted.factor * verdict.direction());
    faces.push_back(moments_of_face(assembly, block, verdict.faces[k], forces.back()));
    size = std::max(size, (face.centroid - block.centroid).norm());
  }
  const Spin<Dim> needed = -moment_of_sliding(block, bolted, forces);
  const double scale = size * bolted.load.norm();
  if (needed.norm() <= no_moment * scale) return 0.0;
  return gauge_of_faces(faces, forces, needed, scale);
}

template std::optional<double> pressure_eccentricity<2>(const Assembly<2>&, const Block<2>&, const BoltedVerdict<2>&);
template std::optional<double> pressure_eccentricity<3>(const Assembly<3>&, const Block<3>&, const BoltedVerdict<3>&);

}  // namespace voussoir
