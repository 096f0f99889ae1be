#include "reference/wedge/wedge_path.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "reference/jointed_block.hpp"
#include "reference/require.hpp"

namespace voussoir::reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Radians (0.25 degrees) from the closed form over which the friction step doubles: of 40 000 equal steps from 70
// degrees about 1500 remain, at the same error.
constexpr double widening_distance = 0.0044;

constexpr Require path_requires{"wedge path: "};

Vector3d eigen_of(const Vector3& v) {
  return {v[0], v[1], v[2]};
}

WedgePathResult follow(const ElasticPlasticWedge& block, const WedgePathSettings& settings) {
  const Wedge& wedge = block.wedge;
  const std::vector<BlockJoint> joints = {
      {upward_normal(wedge.a.dip, wedge.a.dip_direction), block.normal_stiffness * block.area_a,
       block.shear_stiffness * block.area_a, 0},
      {upward_normal(wedge.b.dip, wedge.b.dip_direction), block.normal_stiffness * block.area_b,
       block.shear_stiffness * block.area_b, 0}};
  const Vector3 weight{wedge.extra_force[0], wedge.extra_force[1], wedge.extra_force[2] - wedge.weight};
  const auto load = [&](double gravity, double uplift) {
    Vector3 sum;
    for (int k = 0; k < 3; ++k)
      sum[k] = gravity * weight[k] +
               uplift * (wedge.a.uplift_force * joints[0].normal[k] + wedge.b.uplift_force * joints[1].normal[k]);
    return sum;
  };
  const double size = std::hypot(weight[0], weight[1], weight[2]);
  const double softest = std::min(
      {joints[0].normal_stiffness, joints[0].shear_stiffness, joints[1].normal_stiffness, joints[1].shear_stiffness});
  const double settlement = size / softest;

  // gravity and water
  BlockState state;
  const auto equal = [](double friction) {
    std::array<double, most_block_joints> all;
    all.fill(std::tan(friction));
    return all;
  };
  const auto put_on = [&](const Vector3& now) {
    path_requires(equilibrate(joints, equal(settings.friction_start), now, size, settlement, state),
                  "the block does not hold while its loads are applied; raise friction_start or gravity_steps");
  };
  const auto part = [&](int step) { return static_cast<double>(step) / settings.gravity_steps; };
  for (int step = 1; step <= settings.gravity_steps; ++step)
    put_on(load(part(step), settings.uplift_with_gravity ? part(step) : 0));
  if (!settings.uplift_with_gravity)
    for (int step = 1; step <= settings.gravity_steps; ++step)
      put_on(load(1, part(step)));
  WedgePathResult result;
  const auto length = [](const Vector3& a) { return std::hypot(a[0], a[1], a[2]); };
  result.start_shear_ratio_a = state.normal[0] > 0 ? length(state.shear[0]) / state.normal[0] : 0;
  result.start_shear_ratio_b = state.normal[1] > 0 ? length(state.shear[1]) / state.normal[1] : 0;

  // Friction falls, in steps that widen with the distance from the closed form's angle: early slips are small. The step
  // is halved, and stays so, if equilibrium is lost.
  const double target = critical_friction(wedge).value_or(0);
  double friction = settings.friction_start, step = settings.friction_step;
  while (step > settings.smallest_step && friction > 0) {
    const double widening = 1 + std::max(0.0, friction - target) / widening_distance;
    const double next = std::max(0.0, friction - step * widening);
    if (equilibrate(joints, equal(next), load(1, 1), size, settlement, state))
      friction = next;
    else
      step /= 2;
  }
  result.critical_friction = friction;
  result.normal_force_a = state.normal[0];
  result.normal_force_b = state.normal[1];
  return result;
}

}  // namespace

WedgePathResult elastic_plastic_path(const ElasticPlasticWedge& block, const WedgePathSettings& settings) {
  solve_wedge(block.wedge);  // checks the orientation and the weight
  for (const WedgePlane* plane : {&block.wedge.a, &block.wedge.b})
    path_requires(plane->cohesion_force == 0, "cohesion is not modelled along the path; set it to zero");
  for (const double value : {block.area_a, block.area_b, block.normal_stiffness, block.shear_stiffness})
    path_requires(std::isfinite(value) && value > 0, "areas and stiffnesses must be positive and finite");
  path_requires(settings.friction_start > 0 && settings.friction_start < 1.5707963,
                "friction_start must be between 0 and pi/2 radians");
  path_requires(settings.gravity_steps >= 1, "gravity_steps must be at least 1");
  path_requires(settings.friction_step > settings.smallest_step && settings.smallest_step > 0,
                "friction_step must exceed smallest_step, and both must be positive");

  WedgePathSettings finer = settings;
  finer.gravity_steps *= 2;
  finer.friction_step /= 2;
  WedgePathResult result = follow(block, finer);
  result.step_error = std::abs(result.critical_friction - follow(block, settings).critical_friction);
  return result;
}

WedgeFaces wedge_faces(const Wedge& wedge, double face_dip, double face_dip_direction, double height) {
  path_requires(std::isfinite(height) && height > 0, "height must be positive and finite");
  const WedgeSolution solution = solve_wedge(wedge);
  const Vector3d n_a = eigen_of(upward_normal(wedge.a.dip, wedge.a.dip_direction));
  const Vector3d n_b = eigen_of(upward_normal(wedge.b.dip, wedge.b.dip_direction));
  const Vector3d face = eigen_of(upward_normal(face_dip, face_dip_direction));
  const Vector3d up(0, 0, 1);

  // Corners: the line daylights at the origin; the others are on the top plane z = height.
  auto corner = [&](const Vector3d& first, const Vector3d& second) -> Vector3d {
    Matrix3d rows;
    rows << first.transpose(), second.transpose(), up.transpose();
    const Eigen::FullPivLU<Matrix3d> factors(rows);
    path_requires(factors.isInvertible(),
                  "two of the planes meet in a horizontal line; the wedge has no corner at the crest");
    return factors.solve(Vector3d(0, 0, height));
  };
  const Vector3d back = corner(n_a, n_b), on_a = corner(n_a, face), on_b = corner(n_b, face);
  path_requires(
      solution.line_plunge > 0 && face.dot(back) < 0 && n_b.dot(on_a) > 0 && n_a.dot(on_b) > 0,
      "the slope face does not cut a finite wedge above both planes; make it steeper or turn it towards the line's "
      "trend");
  return {0.5 * back.cross(on_a).norm(), 0.5 * back.cross(on_b).norm(), std::abs(back.dot(on_a.cross(on_b))) / 6};
}

WedgeUplift wedge_uplift(const WedgeFaces& faces, double height, double level, double unit_weight) {
  path_requires(level >= 0 && level <= height, "the water level must be between the wedge's lowest corner and its top");
  path_requires(std::isfinite(unit_weight) && unit_weight >= 0, "the unit weight of water must not be negative");
  const double wet = level / height, mean_pressure = unit_weight * level / 3;
  return {faces.area_a * wet * wet * mean_pressure, faces.area_b * wet * wet * mean_pressure};
}

}  // namespace voussoir::reference
