#include "reference/key_blocks/shared_cohesion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "reference/key_blocks/eigen_vectors.hpp"
#include "reference/require.hpp"

namespace voussoir::reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr Require cohesion_requires{"shared cohesion: "};

struct ElasticJoint {
  Vector3d normal;
  double area, cohesion, tan_friction;  // m^2, N, 1
};

std::array<ElasticJoint, 2> joints_of(const ElasticWedge& block) {
  cohesion_requires(positive(block.area_a) && positive(block.area_b), "areas must be positive");
  const auto joint = [](const WedgePlane& plane, double area) {
    return ElasticJoint{to_eigen(upward_normal(plane.dip, plane.dip_direction)), area, plane.cohesion_force,
                        std::tan(plane.friction_angle)};
  };
  return {joint(block.wedge.a, block.area_a), joint(block.wedge.b, block.area_b)};
}

WedgeSolution on_both(const Wedge& wedge) {
  const WedgeSolution solution = solve_wedge(wedge);
  cohesion_requires(solution.mode == WedgeMode::both_planes, "the wedge must slide on both planes");
  return solution;
}

double factor_with(Wedge wedge, double cohesion_a, double cohesion_b) {
  wedge.a.cohesion_force = cohesion_a;
  wedge.b.cohesion_force = cohesion_b;
  return on_both(wedge).factor_of_safety;
}

// N, along the line at the displacement u
double shear_force(const ElasticJoint& joint, double normal, double residual, double slip, double stiffness,
                   double factor, double u) {
  const double friction = normal * joint.tan_friction;
  const auto strength = [&](double beta) {
    return (joint.cohesion * (residual + (1 - residual) * std::exp(-beta / slip)) + friction) / factor;
  };
  const double spring = stiffness * joint.area;
  if (spring * u <= strength(0)) return spring * u;
  double low = 0, high = u;  // of the plastic slip
  for (int k = 0; k < 60; ++k) {
    const double beta = 0.5 * (low + high);
    (spring * (u - beta) > strength(beta) ? low : high) = beta;
  }
  return strength(low);
}

}  // namespace

double first_slip_factor(const ElasticWedge& block, double ratio) {
  cohesion_requires(ratio >= 0 && std::isfinite(ratio), "ks/kn must not be negative");
  const std::array<ElasticJoint, 2> joints = joints_of(block);
  const WedgeSolution solution = on_both(block.wedge);
  std::array<double, 2> factors{};
  if (ratio == 0) {
    const double share = solution.driving_force / (block.area_a + block.area_b);
    const std::array<double, 2> normal{solution.normal_force_a, solution.normal_force_b};
    for (int k = 0; k < 2; ++k)
      factors[k] = (joints[k].cohesion + normal[k] * joints[k].tan_friction) / (share * joints[k].area);
  } else {
    const Wedge& w = block.wedge;
    const Vector3d load = Vector3d(0, 0, -w.weight) + to_eigen(w.extra_force) + w.a.uplift_force * joints[0].normal +
                          w.b.uplift_force * joints[1].normal;
    Matrix3d stiffness = Matrix3d::Zero();
    for (const ElasticJoint& joint : joints) {
      const Matrix3d across = joint.normal * joint.normal.transpose();
      stiffness += joint.area * (across + ratio * (Matrix3d::Identity() - across));
    }
    const Vector3d displacement = stiffness.fullPivLu().solve(load);
    for (int k = 0; k < 2; ++k) {
      const ElasticJoint& joint = joints[k];
      const double closing = -joint.normal.dot(displacement);
      const double shear = ratio * joint.area * (displacement + closing * joint.normal).norm();
      factors[k] = (joint.cohesion + std::max(0.0, joint.area * closing) * joint.tan_friction) / shear;
    }
  }
  return std::min(factors[0], factors[1]);
}

double brittle_factor(const ElasticWedge& block, double ratio) {
  return std::max(first_slip_factor(block, ratio), factor_with(block.wedge, 0, 0));
}

double softening_factor(const ElasticWedge& block, double residual, double slip, double shear_stiffness) {
  cohesion_requires(residual >= 0 && residual <= 1 && positive(slip) && positive(shear_stiffness),
                    "the residual part must be in 0..1, slip and stiffness positive");
  const std::array<ElasticJoint, 2> joints = joints_of(block);
  const WedgeSolution solution = on_both(block.wedge);
  const std::array<double, 2> normal{solution.normal_force_a, solution.normal_force_b};
  const double friction = factor_with(block.wedge, 0, 0), plastic = solution.factor_of_safety;
  const auto total = [&](double u, double factor) {
    return shear_force(joints[0], normal[0], residual, slip, shear_stiffness, factor, u) +
           shear_force(joints[1], normal[1], residual, slip, shear_stiffness, factor, u);
  };
  // the greatest sum is reached between the first slip and the loss of all cohesion
  const auto peak = [&](double factor) {
    std::array<double, 2> yields{};
    for (int k = 0; k < 2; ++k)
      yields[k] =
          (joints[k].cohesion + normal[k] * joints[k].tan_friction) / (factor * shear_stiffness * joints[k].area);
    const double first = std::min(yields[0], yields[1]), last = std::max(yields[0], yields[1]) + 40 * slip;
    constexpr int parts = 400;
    const double part = (last - first) / parts;
    int best = 0;
    double greatest = 0;
    for (int k = 0; k <= parts; ++k)
      if (const double sum = total(first + k * part, factor); sum > greatest) {
        greatest = sum;
        best = k;
      }
    double from = first + (best - 1) * part, to = first + (best + 1) * part;
    for (int k = 0; k < 60; ++k) {
      const double left = from + (to - from) / 3, right = to - (to - from) / 3;
      const bool rises = total(left, factor) < total(right, factor);
      (rises ? from : to) = rises ? left : right;
    }
    return std::max(greatest, total(0.5 * (from + to), factor));
  };
  double low = 0.9 * friction, high = 1.001 * plastic;
  for (int k = 0; k < 45; ++k) {
    const double factor = 0.5 * (low + high);
    (peak(factor) > solution.driving_force ? low : high) = factor;
  }
  for (const ElasticJoint& joint : joints)
    cohesion_requires(shear_stiffness * joint.area * slip * low > (1 - residual) * joint.cohesion,
                      "cohesion falls faster than the spring unloads");
  return 0.5 * (low + high);
}

}  // namespace voussoir::reference
