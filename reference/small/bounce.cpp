#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "reference/require.hpp"
#include "reference/small/small.hpp"

namespace voussoir::reference {
namespace {

using std::numbers::pi;
// Brent's method gains a digit or more a round; 200 leaves room for the worst bisection.
constexpr int most_rounds = 200;

constexpr Require require{""};

// acos(z)/sqrt(1-z^2), continued through z = 1 by its series and above by acosh(z)/sqrt(z^2-1).
double angle_over_sine(double z) {
  const double d = 1 - z;
  if (std::abs(d) < 1e-4) return 1 + d / 3 + 2 * d * d / 15;  // next term 2 d^3/35: below 1e-13
  return z < 1 ? std::acos(z) / std::sqrt(1 - z * z) : std::acosh(z) / std::sqrt(z * z - 1);
}

// Free motion y'' + 2 z w y' + w^2 y = 0 in time units of 1/w: value and its slope at t.
struct Free {
  double value = 0, slope = 0;
};

Free free_motion(Free start, double z, double t) {
  // y = e^{-zt} (y0 C + (y0' + z y0) S), C = cos(st) or cosh, S = sin(st)/s or sinh
  const double square = 1 - z * z;
  double c, s;
  if (std::abs(square) < 1e-10) {
    c = 1 - square * t * t / 2, s = t * (1 - square * t * t / 6);
  } else if (square > 0) {
    const double root = std::sqrt(square);
    c = std::cos(root * t), s = std::sin(root * t) / root;
  } else {
    const double root = std::sqrt(-square);
    c = std::cosh(root * t), s = std::sinh(root * t) / root;
  }
  const double decay = std::exp(-z * t), rate = start.slope + z * start.value;
  return {decay * (start.value * c + rate * s), decay * (start.slope * c - (start.value + z * start.slope) * s)};
}

// First time above `after` at which the motion is zero; infinity if there is none.
double first_zero(Free start, double z, double after) {
  const double none = std::numeric_limits<double>::infinity();
  const double square = 1 - z * z, rate = start.slope + z * start.value;
  if (square > 1e-10) {
    // a sine wave of angular speed `root` from the phase at time zero
    const double root = std::sqrt(square), period = pi / root;
    double t = -std::atan2(start.value, rate / root) / root;
    while (t <= after)
      t += period;
    return t;
  }
  // at most one zero: S/C = -value/rate
  if (rate == 0) return none;
  const double ratio = -start.value / rate;
  const double root = std::sqrt(std::max(0.0, -square));
  double t = ratio;
  if (root > 1e-5) t = std::abs(ratio * root) < 1 ? std::atanh(ratio * root) / root : none;
  return t > after && std::isfinite(t) ? t : none;
}

Free derivative(Free y, double z) {
  return {y.slope, -2 * z * y.slope - y.value};
}

struct Force {
  Free acceleration;  // y'' and y''' at time zero
  double z, gravity;
};

double force_over_mass(double t, void* parameters) {
  const Force& f = *static_cast<const Force*>(parameters);
  return f.gravity - free_motion(f.acceleration, f.z, t).value;
}

double root_between(Force force, double low, double high) {
  gsl_set_error_handler_off();
  gsl_function function{force_over_mass, &force};
  const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), gsl_root_fsolver_free);
  if (!solver || gsl_root_fsolver_set(solver.get(), &function, low, high) != GSL_SUCCESS)
    throw std::runtime_error("bounce: the end of contact is not bracketed");
  for (int round = 0; round < most_rounds; ++round) {
    if (gsl_root_fsolver_iterate(solver.get()) != GSL_SUCCESS) throw std::runtime_error("bounce: root search failed");
    if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver.get()), gsl_root_fsolver_x_upper(solver.get()), 0,
                               1e-15) == GSL_SUCCESS)
      break;
  }
  return gsl_root_fsolver_root(solver.get());
}

// Gravity: about the overlap g/w^2, in units of time 1/w and of length v/w; gravity is then g/(v w).
BounceResult with_gravity(double z, double gravity) {
  const Free start{-gravity, 1};
  BounceResult result;
  const double turn = first_zero(derivative(start, z), z, 0);
  // over-damped and slow: the overlap creeps up to its static value
  result.maximum_overlap = gravity + (std::isfinite(turn) ? free_motion(start, z, turn).value : 0);

  // The force is zero when the acceleration equals gravity: as it rises to its first maximum after the start.
  const Free acceleration = derivative(derivative(start, z), z), jerk = derivative(acceleration, z);
  double low = 0, high = first_zero(jerk, z, 0);
  if (jerk.value < 0 || (jerk.value == 0 && jerk.slope < 0)) {
    low = high;
    high = std::isfinite(low) ? first_zero(jerk, z, low * (1 + 1e-12)) : low;
  }
  // The over-damped acceleration may rise without end: it tends to zero, below gravity.
  const Force force{acceleration, z, gravity};
  Force probe = force;
  if (!std::isfinite(high) || force_over_mass(high, &probe) > 0) {
    result.rebounds = false;
    return result;
  }
  result.duration = root_between(force, low, high);
  const Free end = free_motion(start, z, result.duration);
  result.end_overlap = gravity + end.value;
  result.restitution = -end.slope;
  return result;
}

}  // namespace

BounceResult bounce(const Bounce& bounce) {
  require(bounce.mass > 0 && bounce.stiffness > 0 && bounce.impact_speed > 0,
          "bounce: mass, stiffness and impact speed must be positive");
  require(std::isfinite(bounce.damping_ratio) && bounce.damping_ratio >= 0,
          "bounce: damping ratio must not be negative");
  require(std::isfinite(bounce.gravity) && bounce.gravity >= 0, "bounce: gravity acts into the contact, 0 or more");
  const double w = std::sqrt(bounce.stiffness / bounce.mass), z = bounce.damping_ratio, v = bounce.impact_speed;

  BounceResult result;
  if (bounce.gravity > 0) {
    result = with_gravity(z, bounce.gravity / (v * w));
  } else {
    const double phase = angle_over_sine(z);
    result.duration = 2 * phase;
    result.restitution = std::exp(-2 * z * phase);
    result.maximum_overlap = std::exp(-z * phase);
    result.end_overlap = 2 * z * result.restitution;  // k x = c times the speed away
  }
  result.duration /= w;
  result.maximum_overlap *= v / w;
  result.end_overlap *= v / w;
  return result;
}

}  // namespace voussoir::reference
