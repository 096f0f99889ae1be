#include "reference/wedge/wedge_path.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace voussoir::reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Out-of-balance force over weight at which a step has converged: the angle's error is of the same order, far below the
// step error, and rounding leaves 1e-15.
constexpr double balance_tolerance = 1e-12;
// Newton needs 2-6 rounds where an equilibrium exists; the rest is room for kinks between stick and slip.
constexpr int most_rounds = 60;
constexpr int most_halvings = 20;
// A step may not move the block further than this many times its settlement: such a solution is sliding, not
// equilibrium.
constexpr double largest_move = 1e3;

// Radians (0.25 degrees) from the closed form over which the friction step doubles: of 40 000 equal steps from 70
// degrees about 1500 are left, at the same error.
constexpr double widening_distance = 0.0044;

void require(bool holds, const std::string& message) {
  if (!holds) throw std::invalid_argument("wedge path: " + message);
}

Vector3d to_eigen(const Vector3& v) {
  return {v[0], v[1], v[2]};
}

// Plain arrays rather than Eigen: 3 x 3 work in a loop of a million, which must also run unoptimised with sanitizers.
double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const Vector3& a) {
  return std::sqrt(dot(a, a));
}

struct Joint {
  Vector3 normal{};                                  // into the block
  double normal_stiffness = 0, shear_stiffness = 0;  // N/m, areas included
};

struct State {
  Vector3 displacement{};
  Vector3 shear[2] = {};  // on the block
  double normal[2] = {};
};

struct Balance {
  State state;
  Vector3 residual{};
  double tangent[3][3] = {};  // of the residual by the displacement
};

// Return mapping on both joints from the last equilibrium `old` to a trial displacement.
Balance evaluate(const Joint (&joints)[2], const State& old, const Vector3& displacement, const Vector3& load,
                 double tan_friction) {
  Balance balance;
  balance.residual = load;
  balance.state.displacement = displacement;
  for (int i = 0; i < 2; ++i) {
    const auto& [n, kn, ks] = joints[i];
    const double overlap = -dot(n, displacement), normal = kn * std::max(0.0, overlap);
    const double kn_now = overlap > 0 ? kn : 0;

    // trial shear: the old one and the elastic slip, both in the plane
    Vector3 move{}, shear{};
    for (int k = 0; k < 3; ++k)
      move[k] = old.shear[i][k] - ks * (displacement[k] - old.displacement[k]);
    const double across = dot(move, n);
    for (int k = 0; k < 3; ++k)
      shear[k] = move[k] - across * n[k];
    const double size = length(shear), limit = normal * tan_friction;
    const bool slips = size > limit;
    const double part = slips ? limit / size : 1;
    Vector3 t{};
    if (slips)
      for (int k = 0; k < 3; ++k)
        t[k] = shear[k] / size;

    // Tangent: -kn n n, then -ks times the part of the plane that still sticks, then the limit's change with N.
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l)
        balance.tangent[k][l] += -kn_now * n[k] * n[l] - ks * part * ((k == l) - n[k] * n[l] - t[k] * t[l]) -
                                 tan_friction * kn_now * t[k] * n[l];
      balance.state.shear[i][k] = part * shear[k];
      balance.residual[k] += normal * n[k] + part * shear[k];
    }
    balance.state.normal[i] = normal;
  }
  return balance;
}

// -tangent^-1 residual by Cramer's rule; not finite at a limit point, which the caller takes as no equilibrium.
Vector3 newton_step(const Balance& balance) {
  const auto& m = balance.tangent;
  Vector3 step{}, cofactor[3] = {};
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      const int k1 = (k + 1) % 3, k2 = (k + 2) % 3, l1 = (l + 1) % 3, l2 = (l + 2) % 3;
      cofactor[k][l] = m[k1][l1] * m[k2][l2] - m[k1][l2] * m[k2][l1];
    }
  const double determinant = m[0][0] * cofactor[0][0] + m[0][1] * cofactor[0][1] + m[0][2] * cofactor[0][2];
  for (int l = 0; l < 3; ++l) {
    double sum = 0;
    for (int k = 0; k < 3; ++k)
      sum += cofactor[k][l] * balance.residual[k];
    step[l] = determinant != 0 ? -sum / determinant : std::numeric_limits<double>::infinity();
  }
  return step;
}

// The equilibrium next to `old`, or false.
bool equilibrate(const Joint (&joints)[2], State& old, const Vector3& load, double tan_friction, double weight,
                 double settlement) {
  Balance now = evaluate(joints, old, old.displacement, load, tan_friction);
  for (int round = 0; round < most_rounds; ++round) {
    if (length(now.residual) <= balance_tolerance * weight) {
      old = now.state;
      return true;
    }
    const Vector3 step = newton_step(now);
    if (!(length(step) <= largest_move * settlement)) return false;
    // Halve the step until the out-of-balance force falls.
    double part = 1;
    bool better = false;
    for (int halving = 0; halving < most_halvings && !better; ++halving, part /= 2) {
      Vector3 trial = now.state.displacement;
      for (int k = 0; k < 3; ++k)
        trial[k] += part * step[k];
      const Balance next = evaluate(joints, old, trial, load, tan_friction);
      better = length(next.residual) < length(now.residual);
      if (better) now = next;
    }
    if (!better) return false;
  }
  return false;
}

WedgePathResult follow(const ElasticPlasticWedge& block, const WedgePathSettings& settings) {
  const Wedge& wedge = block.wedge;
  const Joint joints[2] = {{upward_normal(wedge.a.dip, wedge.a.dip_direction), block.normal_stiffness * block.area_a,
                            block.shear_stiffness * block.area_a},
                           {upward_normal(wedge.b.dip, wedge.b.dip_direction), block.normal_stiffness * block.area_b,
                            block.shear_stiffness * block.area_b}};
  const Vector3 weight{wedge.extra_force[0], wedge.extra_force[1], wedge.extra_force[2] - wedge.weight};
  const double size = length(weight);
  const double softest = std::min(
      {joints[0].normal_stiffness, joints[0].shear_stiffness, joints[1].normal_stiffness, joints[1].shear_stiffness});
  const double settlement = size / softest;

  // gravity
  State state;
  const double tan_start = std::tan(settings.friction_start);
  for (int step = 1; step <= settings.gravity_steps; ++step) {
    const double part = static_cast<double>(step) / settings.gravity_steps;
    const Vector3 load{part * weight[0], part * weight[1], part * weight[2]};
    require(equilibrate(joints, state, load, tan_start, size, settlement),
            "the block does not hold while gravity is put on; raise friction_start or gravity_steps");
  }
  WedgePathResult result;
  result.start_shear_ratio_a = state.normal[0] > 0 ? length(state.shear[0]) / state.normal[0] : 0;
  result.start_shear_ratio_b = state.normal[1] > 0 ? length(state.shear[1]) / state.normal[1] : 0;

  // Friction falls, in steps that widen with the distance from the closed form's angle: what slips early slips little.
  // The step is halved for good where equilibrium is lost.
  const double target = critical_friction(wedge).value_or(0);
  double friction = settings.friction_start, step = settings.friction_step;
  while (step > settings.smallest_step && friction > 0) {
    const double widening = 1 + std::max(0.0, friction - target) / widening_distance;
    const double next = std::max(0.0, friction - step * widening);
    if (equilibrate(joints, state, weight, std::tan(next), size, settlement))
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
    require(plane->cohesion_force == 0 && plane->uplift_force == 0,
            "cohesion and uplift are not modelled along the path; set them to zero");
  for (const double value : {block.area_a, block.area_b, block.normal_stiffness, block.shear_stiffness})
    require(std::isfinite(value) && value > 0, "areas and stiffnesses must be positive and finite");
  require(settings.friction_start > 0 && settings.friction_start < 1.5707963,
          "friction_start must lie between 0 and pi/2 radians");
  require(settings.gravity_steps >= 1, "gravity_steps must be at least 1");
  require(settings.friction_step > settings.smallest_step && settings.smallest_step > 0,
          "friction_step must exceed smallest_step, and both must be positive");

  WedgePathSettings finer = settings;
  finer.gravity_steps *= 2;
  finer.friction_step /= 2;
  WedgePathResult result = follow(block, finer);
  result.step_error = std::abs(result.critical_friction - follow(block, settings).critical_friction);
  return result;
}

WedgeFaces wedge_faces(const Wedge& wedge, double face_dip, double face_dip_direction, double height) {
  require(std::isfinite(height) && height > 0, "height must be positive and finite");
  const WedgeSolution solution = solve_wedge(wedge);
  const Vector3d n_a = to_eigen(upward_normal(wedge.a.dip, wedge.a.dip_direction));
  const Vector3d n_b = to_eigen(upward_normal(wedge.b.dip, wedge.b.dip_direction));
  const Vector3d face = to_eigen(upward_normal(face_dip, face_dip_direction));
  const Vector3d up(0, 0, 1);

  // Corners: the line daylights at the origin; the others lie on the top plane z = height.
  auto corner = [&](const Vector3d& first, const Vector3d& second) -> Vector3d {
    Matrix3d rows;
    rows << first.transpose(), second.transpose(), up.transpose();
    const Eigen::FullPivLU<Matrix3d> factors(rows);
    require(factors.isInvertible(),
            "two of the planes meet in a horizontal line; the wedge has no corner at the crest");
    return factors.solve(Vector3d(0, 0, height));
  };
  const Vector3d back = corner(n_a, n_b), on_a = corner(n_a, face), on_b = corner(n_b, face);
  require(
      solution.line_plunge > 0 && face.dot(back) < 0 && n_b.dot(on_a) > 0 && n_a.dot(on_b) > 0,
      "the slope face does not cut a finite wedge above both planes; make it steeper or turn it to the line's trend");
  return {0.5 * back.cross(on_a).norm(), 0.5 * back.cross(on_b).norm(), std::abs(back.dot(on_a.cross(on_b))) / 6};
}

}  // namespace voussoir::reference
