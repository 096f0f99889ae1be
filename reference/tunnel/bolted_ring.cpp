#include "reference/tunnel/bolted_ring.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_log.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "reference/ode.hpp"
#include "reference/require.hpp"

namespace voussoir::reference {
namespace {

constexpr Require require{"bolted ring: "};

void check(const BoltedRing& ring, double distance) {
  require(std::isfinite(ring.radius) && ring.radius > 0, "radius must be positive");
  require(std::isfinite(ring.shear_modulus) && ring.shear_modulus > 0, "shear modulus must be positive, in Pa");
  require(ring.poisson_ratio >= 0 && ring.poisson_ratio < 0.5, "Poisson's ratio must be in 0..0.5, 0.5 excluded");
  require(std::isfinite(ring.in_situ_pressure), "in-situ pressure must be finite, in Pa");
  require(ring.bolt_stiffness >= 0 && ring.mean_joint_spacing >= 0 && ring.bolt_length >= 0,
          "bolt stiffness, mean joint spacing and bolt length must not be negative; use 0 for no bolts");
  require(ring.tangential_spacing > 0 && ring.longitudinal_spacing > 0,
          "bolt spacings must be positive; in a plane model the longitudinal one is 1 m");
  require(ring.fixed_radius > ring.radius + ring.bolt_length, "the rock must be held beyond wall and bolts");
  require(std::isfinite(distance) && distance >= ring.radius && distance <= ring.fixed_radius,
          "distance must be between wall and held rock");
}

// Displacement over radius, and its slope by rho.
struct Displacement {
  double value = 0, slope = 0;
};

// Of (rho/b^2) ln(1+b/rho) - 1/b = h(b/rho)/rho with h(x) = (ln(1+x) - x)/x^2: no cancellation for weak bolts.
Displacement second_solution(double rho, double b) {
  const double x = b / rho;
  double h = -0.5;
  if (x > 0) {
    gsl_sf_result log_less;  // ln(1+x) - x
    gsl_set_error_handler_off();
    if (gsl_sf_log_1plusx_mx_e(x, &log_less) != GSL_SUCCESS)
      throw std::runtime_error("bolted ring: logarithm failed; check the bolt stiffness");
    // below 1e-100 the square would underflow, and h is its limit to the last digit
    if (x > 1e-100) h = log_less.val / (x * x);
  }
  return {h / rho, (h + 1 / (1 + x)) / (rho * rho)};
}

// Of 1/rho - rho a²/R², the solution in plain rock beyond the bolts.
Displacement beyond_bolts(const BoltedRing& ring, double rho) {
  const double held = ring.radius / ring.fixed_radius, pull = held * held;
  return {1 / rho - rho * pull, -1 / (rho * rho) - pull};
}

// Radial and hoop stress increments of the rock over 2G, tension positive: Eqs 5.10 and 5.11 with λ = 2Gν/(1 - 2ν).
double radial_increment(Displacement u, double rho, double nu) {
  return ((1 - nu) * u.slope + nu * u.value / rho) / (1 - 2 * nu);
}
double hoop_increment(Displacement u, double rho, double nu) {
  return ((1 - nu) * u.value / rho + nu * u.slope) / (1 - 2 * nu);
}

BoltedRingState state_of(const BoltedRing& ring, Displacement u, double rho, bool bolted) {
  const double beta = bolted ? bolt_relative_stiffness(ring) : 0, nu = ring.poisson_ratio;
  const double two_g = 2 * ring.shear_modulus;
  BoltedRingState state;
  state.convergence = -u.value * ring.radius;
  state.bolt_force = bolted ? ring.bolt_stiffness * ring.mean_joint_spacing * u.slope : 0;
  state.radial_stress = ring.in_situ_pressure - two_g * (radial_increment(u, rho, nu) + beta * u.slope / rho);
  state.hoop_stress = ring.in_situ_pressure - two_g * hoop_increment(u, rho, nu);
  return state;
}

}  // namespace

double modulus_of_held_rock(double shear_modulus, double poisson_ratio, double radius, double fixed_radius) {
  require(std::isfinite(shear_modulus) && shear_modulus > 0, "shear modulus must be positive, in Pa");
  require(poisson_ratio >= 0 && poisson_ratio < 0.5, "Poisson's ratio must be in 0..0.5, 0.5 excluded");
  require(radius > 0 && fixed_radius > radius, "the rock must be held beyond a positive radius");
  const double ratio = radius / fixed_radius, square = ratio * ratio;
  return shear_modulus * (1 + square / (1 - 2 * poisson_ratio)) / (1 - square);
}

double bolt_relative_stiffness(const BoltedRing& ring) {
  return ring.bolt_stiffness * ring.mean_joint_spacing /
         (ring.tangential_spacing * ring.longitudinal_spacing * 2 * ring.shear_modulus);
}

BoltedRingState bolted_ring_at(const BoltedRing& ring, double distance) {
  check(ring, distance);
  const double nu = ring.poisson_ratio, beta = bolt_relative_stiffness(ring), b = beta * (1 - 2 * nu) / (1 - nu);
  const double end = 1 + ring.bolt_length / ring.radius;
  const Displacement first_wall{1, 1}, first_end{end, 1}, outer_end = beyond_bolts(ring, end);
  const Displacement second_wall = second_solution(1, b), second_end = second_solution(end, b);

  // rows: stress at the wall, displacement and stress at the end; columns: C1, C2, C3
  auto total = [&](Displacement u, double rho) { return radial_increment(u, rho, nu) + beta * u.slope / rho; };
  Eigen::Matrix3d rows;
  rows << total(first_wall, 1), total(second_wall, 1), 0,   //
      first_end.value, second_end.value, -outer_end.value,  //
      total(first_end, end), total(second_end, end), -radial_increment(outer_end, end, nu);
  const Eigen::Vector3d right(ring.in_situ_pressure / (2 * ring.shear_modulus), 0, 0);
  const Eigen::Vector3d c = rows.fullPivLu().solve(right);

  const double rho = distance / ring.radius;
  if (rho > end) {
    const Displacement outer = beyond_bolts(ring, rho);
    return state_of(ring, {c(2) * outer.value, c(2) * outer.slope}, rho, false);
  }
  const Displacement second = second_solution(rho, b);
  return state_of(ring, {c(0) * rho + c(1) * second.value, c(0) + c(1) * second.slope}, rho, true);
}

BoltedRingState bolted_ring_at_by_ode(const BoltedRing& ring, double distance) {
  check(ring, distance);
  const double nu = ring.poisson_ratio, beta = bolt_relative_stiffness(ring), b = beta * (1 - 2 * nu) / (1 - nu);
  const double end = 1 + ring.bolt_length / ring.radius, rho = distance / ring.radius;

  const auto equation = [](double stiff) -> OdeRight {
    return [stiff](double x, const double* y, double* dy) {
      dy[0] = y[1];
      dy[1] = (y[0] - x * y[1]) / (x * (x + stiff));
    };
  };
  // beyond the bolts, up to a factor: inwards from the radius at which the rock is held, or the decaying solution
  const auto beyond = [&](double x) {
    if (std::isinf(ring.fixed_radius)) return Displacement{-1 / x, 1 / (x * x)};
    const auto y = integrate_ode(equation(0), {0, 1}, ring.fixed_radius / ring.radius, x);
    return Displacement{y[0], y[1]};
  };
  // continuity of displacement and of total radial stress gives the slope just inside the end
  const Displacement outer = beyond(end);
  const double slope = (radial_increment(outer, end, nu) - nu * outer.value / (end * (1 - 2 * nu))) /
                       ((1 - nu) / (1 - 2 * nu) + beta / end);
  auto inside = [&](double x) {
    const auto y = integrate_ode(equation(b), {outer.value, slope}, end, x);
    return Displacement{y[0], y[1]};
  };

  // The problem is linear: scaled so that the wall is free.
  const Displacement wall = inside(1);
  const double scale =
      ring.in_situ_pressure / (2 * ring.shear_modulus) / (radial_increment(wall, 1, nu) + beta * wall.slope);
  const Displacement u = rho > end ? beyond(rho) : inside(rho);
  return state_of(ring, {scale * u.value, scale * u.slope}, rho, rho <= end);
}

double mean_bolt_force(const BoltedRing& ring) {
  const double end = ring.radius + ring.bolt_length;
  require(ring.bolt_length > 0, "bolts without length have no mean force");
  // K_a s_mean u' along the bolt
  return ring.bolt_stiffness * ring.mean_joint_spacing / ring.bolt_length *
         (bolted_ring_at(ring, ring.radius).convergence - bolted_ring_at(ring, end).convergence);
}

}  // namespace voussoir::reference
