#include "reference/wedge/wedge.hpp"
#include "reference/require.hpp"
#include "text/angle.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace voussoir::reference {
namespace {

using Eigen::Vector3d;

constexpr double half_turn = std::numbers::pi;

// Below this sine of the angle between them the planes have no usable line of intersection: the normal forces have
// an error of about one rounding unit divided by it.
constexpr double smallest_sine = 1e-9;

// A limit of a class is itself inside the class: 15 degrees given in degrees must pass, whatever the last bit.
constexpr double rounding = 1e-12;

constexpr double least_plunge_deg = 15;
constexpr double least_normal_fraction = 0.05;
constexpr double least_clearance = 0.3;

Vector3d to_eigen(const Vector3& v) {
  return {v[0], v[1], v[2]};
}
Vector3 to_array(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

constexpr Require require{"wedge: "};

void check_plane(const WedgePlane& plane, const std::string& name) {
  const std::string of = " of plane " + name;
  require(plane.dip >= 0 && plane.dip <= half_turn / 2 + rounding,
          "dip" + of + " must be in 0..pi/2 radians; give degrees times pi/180, and turn the dip direction round");
  require(std::isfinite(plane.dip_direction), "dip direction" + of + " must be finite, in radians");
  require(plane.friction_angle >= 0 && plane.friction_angle < half_turn / 2,
          "friction angle" + of + " must be in 0..pi/2 radians, pi/2 excluded");
  require(std::isfinite(plane.cohesion_force) && plane.cohesion_force >= 0,
          "cohesion force" + of + " must be finite and not negative (cohesion times area)");
  require(std::isfinite(plane.uplift_force) && plane.uplift_force >= 0,
          "uplift force" + of + " must be finite and not negative; state suction as an extra force");
}

void check(const Wedge& wedge) {
  check_plane(wedge.a, "A");
  check_plane(wedge.b, "B");
  require(std::isfinite(wedge.weight) && wedge.weight > 0, "weight must be positive and finite");
  require(to_eigen(wedge.extra_force).allFinite(), "extra force must be finite");
}

struct Frame {
  Vector3d n_a, n_b, line;  // line: unit, downward
  double cosine = 0;        // n_a . n_b
};

Frame frame_of(const Wedge& wedge) {
  Frame frame;
  frame.n_a = to_eigen(upward_normal(wedge.a.dip, wedge.a.dip_direction));
  frame.n_b = to_eigen(upward_normal(wedge.b.dip, wedge.b.dip_direction));
  frame.cosine = frame.n_a.dot(frame.n_b);
  const Vector3d cross = frame.n_a.cross(frame.n_b);
  require(cross.norm() > smallest_sine, "planes A and B are parallel; a single plane has no wedge, tilt one of them");
  frame.line = (cross.z() > 0 ? Vector3d(-cross) : cross).normalized();
  return frame;
}

double strength(const WedgePlane& plane, double normal_force) {
  return plane.cohesion_force + normal_force * std::tan(plane.friction_angle);
}

double safety(double resisting, double driving) {
  return driving > 0 ? resisting / driving : std::numeric_limits<double>::infinity();
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

}  // namespace

std::string describe(WedgeMode mode) {
  switch (mode) {
    case WedgeMode::both_planes:
      return "both planes";
    case WedgeMode::plane_a:
      return "plane A only";
    case WedgeMode::plane_b:
      return "plane B only";
    case WedgeMode::lifts_off:
      return "lifts off both";
  }
  throw std::invalid_argument("wedge: unknown mode; use one of WedgeMode");
}

Vector3 upward_normal(double dip, double dip_direction) {
  return {std::sin(dip) * std::sin(dip_direction), std::sin(dip) * std::cos(dip_direction), std::cos(dip)};
}

Vector3 down_dip(double dip, double dip_direction) {
  return {std::cos(dip) * std::sin(dip_direction), std::cos(dip) * std::cos(dip_direction), -std::sin(dip)};
}

WedgeSolution solve_wedge(const Wedge& wedge) {
  check(wedge);
  const auto [n_a, n_b, line, cosine] = frame_of(wedge);
  const Vector3d resultant = Vector3d(0, 0, -wedge.weight) + to_eigen(wedge.extra_force) + wedge.a.uplift_force * n_a +
                             wedge.b.uplift_force * n_b;

  WedgeSolution solution;
  solution.line_plunge = std::asin(std::min(1.0, -line.z()));
  const double trend = std::atan2(line.x(), line.y());
  solution.line_trend = trend < 0 ? trend + 2 * half_turn : trend;

  // driving forces into the planes, and the normal forces if both are in contact
  const double push_a = -resultant.dot(n_a), push_b = -resultant.dot(n_b);
  const double sine_squared = n_a.cross(n_b).squaredNorm();
  const double both_a = (push_a - cosine * push_b) / sine_squared;
  const double both_b = (push_b - cosine * push_a) / sine_squared;

  // contact on both
  if (both_a >= 0 && both_b >= 0) {
    const double along = resultant.dot(line);
    solution.mode = WedgeMode::both_planes;
    solution.normal_force_a = both_a;
    solution.normal_force_b = both_b;
    solution.driving_force = std::abs(along);
    solution.sliding_direction = to_array(along < 0 ? Vector3d(-line) : line);
    solution.factor_of_safety = safety(strength(wedge.a, both_a) + strength(wedge.b, both_b), solution.driving_force);
    return solution;
  }

  // Contact on one. At most one of the two can be in contact: with both normal forces negative, both driving forces
  // positive would need |N_A| < |cos| |N_B| < cos^2 |N_A|.
  const bool on_a = both_b < 0 && push_a > 0, on_b = both_a < 0 && push_b > 0;
  if (on_a || on_b) {
    const Vector3d& normal = on_a ? n_a : n_b;
    const double push = on_a ? push_a : push_b;
    const Vector3d along = resultant + push * normal;
    solution.mode = on_a ? WedgeMode::plane_a : WedgeMode::plane_b;
    (on_a ? solution.normal_force_a : solution.normal_force_b) = push;
    solution.driving_force = along.norm();
    if (solution.driving_force > 0) solution.sliding_direction = to_array(along.normalized());
    solution.factor_of_safety = safety(strength(on_a ? wedge.a : wedge.b, push), solution.driving_force);
    return solution;
  }

  // no contact: no strength
  solution.mode = WedgeMode::lifts_off;
  solution.driving_force = resultant.norm();
  if (solution.driving_force > 0) solution.sliding_direction = to_array(resultant.normalized());
  solution.factor_of_safety = safety(0, solution.driving_force);
  return solution;
}

std::optional<double> critical_friction(const Wedge& wedge) {
  const WedgeSolution solution = solve_wedge(wedge);
  const bool on_a = solution.mode == WedgeMode::both_planes || solution.mode == WedgeMode::plane_a;
  const bool on_b = solution.mode == WedgeMode::both_planes || solution.mode == WedgeMode::plane_b;
  const double cohesion = (on_a ? wedge.a.cohesion_force : 0) + (on_b ? wedge.b.cohesion_force : 0);
  const double needed = solution.driving_force - cohesion;
  if (needed <= 0) return 0.0;
  const double normal = solution.normal_force_a + solution.normal_force_b;
  if (normal <= 0) return std::nullopt;
  return std::atan2(needed, normal);
}

WedgeClass classify_wedge(const Wedge& wedge) {
  Wedge dry{wedge.a, wedge.b, wedge.weight, {}};
  dry.a.uplift_force = dry.b.uplift_force = 0;
  const WedgeSolution solution = solve_wedge(dry);
  const Frame frame = frame_of(dry);
  const double clearance_a = to_eigen(down_dip(dry.a.dip, dry.a.dip_direction)).dot(frame.n_b);
  const double clearance_b = to_eigen(down_dip(dry.b.dip, dry.b.dip_direction)).dot(frame.n_a);

  const double plunge_deg = to_degrees(solution.line_plunge);
  if (plunge_deg < least_plunge_deg - rounding * 180)
    return {false, "the line of intersection plunges " + number(plunge_deg) + " degrees, below 15"};

  const bool both = solution.mode == WedgeMode::both_planes;
  const double share_a = solution.normal_force_a / dry.weight, share_b = solution.normal_force_b / dry.weight;
  if ((both || solution.mode == WedgeMode::plane_a) && share_a < least_normal_fraction)
    return {false, "plane A supports " + number(share_a) + " of the weight, below 0.05"};
  if ((both || solution.mode == WedgeMode::plane_b) && share_b < least_normal_fraction)
    return {false, "plane B supports " + number(share_b) + " of the weight, below 0.05"};

  if (both && clearance_a > -least_clearance)
    return {false, "sliding on both planes, but t_A.n_B = " + number(clearance_a) + " is above -0.3"};
  if (both && clearance_b > -least_clearance)
    return {false, "sliding on both planes, but t_B.n_A = " + number(clearance_b) + " is above -0.3"};
  if (solution.mode == WedgeMode::plane_a && clearance_a < least_clearance)
    return {false, "sliding on plane A, but t_A.n_B = " + number(clearance_a) + " is below 0.3"};
  if (solution.mode == WedgeMode::plane_b && clearance_b < least_clearance)
    return {false, "sliding on plane B, but t_B.n_A = " + number(clearance_b) + " is below 0.3"};
  if (solution.mode == WedgeMode::lifts_off) return {false, "the block is in contact with neither plane"};
  return {true, ""};
}

}  // namespace voussoir::reference
