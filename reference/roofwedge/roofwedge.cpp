#include "reference/roofwedge/roofwedge.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "reference/jointed_block.hpp"
#include "reference/require.hpp"
#include "reference/wedge/wedge.hpp"

namespace voussoir::reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr Require require{"roof wedge: "};

Vector3d to_eigen(const Vector3& v) {
  return {v[0], v[1], v[2]};
}

Matrix3d stress_of(const RoofWedge& wedge) {
  const auto& [xx, yy, zz, yz, zx, xy] = wedge.stress;
  Matrix3d stress;
  stress << xx, xy, zx, xy, yy, yz, zx, yz, zz;
  return stress;
}

// the unbalanced force of rock and weight when the roof is cut
Vector3d load_of(const RoofWedge& wedge, const RoofWedgeFaces& faces) {
  const double weight = wedge.density * wedge.gravity * faces.volume;
  return -weight * Vector3d::UnitZ() - faces.base_area * (stress_of(wedge) * Vector3d::UnitZ());
}

RoofWedgeState follow(const RoofWedge& wedge, const RoofWedgeSettings& settings) {
  const RoofWedgeFaces faces = roof_wedge_faces(wedge);
  const Matrix3d stress = stress_of(wedge);
  // the in-situ tractions act on the joints before the roof is cut; with the base's they balance
  std::vector<BlockJoint> joints;
  BlockState state;
  Vector3d in_situ = Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vector3d n = to_eigen(faces.normal[i]), traction = faces.area[i] * (stress * n);
    const double normal = n.dot(traction);
    const Vector3d shear = traction - normal * n;
    joints.push_back(
        {faces.normal[i], wedge.normal_stiffness * faces.area[i], wedge.shear_stiffness * faces.area[i], normal});
    state.normal[i] = normal;
    state.shear[i] = {shear[0], shear[1], shear[2]};
    in_situ += traction;
  }
  const double weight = wedge.density * wedge.gravity * faces.volume;
  const Vector3 load{0, 0, -weight};
  const double size = in_situ.norm() + weight + joints[0].initial_normal;
  const double softest = std::min(joints[0].normal_stiffness, joints[0].shear_stiffness);

  const auto tangents = [&](double friction) {
    std::array<double, most_block_joints> all{};
    for (int i = 0; i < 3; ++i)
      all[i] = wedge.planes[i].strength * std::tan(friction);
    return all;
  };
  if (!equilibrate(joints, tangents(settings.friction_start), load, size, size / softest, state))
    throw std::domain_error("roof wedge: the wedge is not stable at friction_start");

  // the step is halved, and stays so, if equilibrium is lost
  double friction = settings.friction_start, step = settings.friction_step;
  while (step > settings.smallest_step && friction > 0) {
    const double next = std::max(0.0, friction - step);
    if (equilibrate(joints, tangents(next), load, size, size / softest, state))
      friction = next;
    else
      step /= 2;
  }
  RoofWedgeState result;
  result.friction = friction;
  result.displacement = state.displacement;
  for (int i = 0; i < 3; ++i) {
    result.normal_force[i] = state.normal[i];
    result.shear_force[i] = to_eigen(state.shear[i]).norm();
  }
  return result;
}

}  // namespace

RoofWedgeFaces roof_wedge_faces(const RoofWedge& wedge) {
  require(std::isfinite(wedge.height) && wedge.height > 0, "height must be positive and finite");
  RoofWedgeFaces faces;
  std::array<Vector3d, 3> up;
  for (int i = 0; i < 3; ++i) {
    const RoofPlane& plane = wedge.planes[i];
    require(plane.dip > 0 && plane.dip < 0.5 * std::numbers::pi, "a dip must be between 0 and pi/2 radians");
    require(plane.strength > 0, "strengths must be positive");
    up[i] = to_eigen(upward_normal(plane.dip, plane.dip_direction));
    faces.normal[i] = {-up[i][0], -up[i][1], -up[i][2]};
  }
  // corners in the roof: two planes through the apex, and z = 0
  const Vector3d apex(0, 0, wedge.height);
  std::array<Vector3d, 3> corner;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    Vector3d line = up[j].cross(up[k]);
    require(std::abs(line[2]) > 1e-9, "two planes intersect in a horizontal line");
    line *= -wedge.height / line[2];
    corner[i] = apex + line;
    require(up[i].dot(line) < 0, "the planes do not enclose a wedge below their apex");
  }
  for (int i = 0; i < 3; ++i)
    faces.area[i] = 0.5 * (corner[(i + 1) % 3] - apex).cross(corner[(i + 2) % 3] - apex).norm();
  faces.base_area = 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
  faces.volume = faces.base_area * wedge.height / 3;
  return faces;
}

RoofWedgeState first_slip(const RoofWedge& wedge) {
  const RoofWedgeFaces faces = roof_wedge_faces(wedge);
  const Matrix3d stress = stress_of(wedge);
  Matrix3d stiffness = Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Matrix3d nn = to_eigen(faces.normal[i]) * to_eigen(faces.normal[i]).transpose();
    stiffness += faces.area[i] * (wedge.normal_stiffness * nn + wedge.shear_stiffness * (Matrix3d::Identity() - nn));
  }
  const Vector3d d = stiffness.ldlt().solve(load_of(wedge, faces));
  RoofWedgeState state;
  state.displacement = {d[0], d[1], d[2]};
  double steepest = -1;
  for (int i = 0; i < 3; ++i) {
    const Vector3d n = to_eigen(faces.normal[i]);
    const Matrix3d along = Matrix3d::Identity() - n * n.transpose();
    const double normal = faces.area[i] * (n.dot(stress * n) - wedge.normal_stiffness * n.dot(d));
    const double shear = (faces.area[i] * (along * (stress * n - wedge.shear_stiffness * d))).norm();
    if (!(normal > 0)) throw std::domain_error("roof wedge: a plane opens");
    state.normal_force[i] = normal;
    state.shear_force[i] = shear;
    const double tangent = shear / (normal * wedge.planes[i].strength);
    if (tangent <= steepest) continue;
    steepest = tangent;
    state.first_plane = i;
  }
  state.friction = std::atan(steepest);
  return state;
}

RoofWedgeState collapse(const RoofWedge& wedge, const RoofWedgeSettings& settings) {
  require(settings.friction_start > 0 && settings.friction_start < 0.5 * std::numbers::pi,
          "friction_start must be between 0 and pi/2 radians");
  require(settings.friction_step > settings.smallest_step && settings.smallest_step > 0,
          "friction_step must exceed smallest_step, and both must be positive");
  RoofWedgeSettings finer = settings;
  finer.friction_step /= 2;
  RoofWedgeState result = follow(wedge, finer);
  result.step_error = std::abs(result.friction - follow(wedge, settings).friction);
  result.first_plane = first_slip(wedge).first_plane;
  return result;
}

}  // namespace voussoir::reference
