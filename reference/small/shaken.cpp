#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reference/small/small.hpp"

namespace voussoir::reference {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

// of the plane, up the slope
struct Plane {
  double speed, angular;  // m/s, rad/s
  double velocity(double t) const { return speed * std::sin(angular * t); }
  double displacement(double t) const { return speed / angular * (1 - std::cos(angular * t)); }
};

// the block's displacement against the plane since it began to slip at `begin`
struct Slip {
  const Plane& plane;
  double begin, limit;  // s, m/s²
  double velocity(double t) const { return plane.velocity(t) - plane.velocity(begin) - limit * (t - begin); }
  double distance(double t) const {
    const double passed = t - begin;
    return plane.displacement(t) - plane.displacement(begin) - plane.velocity(begin) * passed -
           0.5 * limit * passed * passed;
  }
};

// the first time at which slip ends; the relative velocity rises until the plane's acceleration has fallen to the
// limit, then falls
double end_of(const Slip& slip, double fastest) {
  double step = 0.5 * std::numbers::pi / slip.plane.angular, low = fastest, high = low + step;
  while (slip.velocity(high) > 0)
    high += step;
  constexpr int halvings = 100;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (slip.velocity(middle) > 0 ? low : high) = middle;
  }
  return high;
}

}  // namespace

ShakenPosition shaken_block(const ShakenIncline& shaken, double time) {
  const Incline& i = shaken.incline;
  const Plane plane{shaken.speed, two_pi * shaken.frequency};
  const double down = i.gravity * std::sin(i.angle);
  const double friction = i.gravity * std::cos(i.angle) * std::tan(i.friction_angle);
  const double limit = friction - down, greatest = plane.speed * plane.angular;
  if (!(limit > 0)) throw std::invalid_argument("shaken block: it slides without shaking");
  if (greatest >= friction + down) throw std::invalid_argument("shaken block: it would slip upwards as well");
  if (greatest <= limit) return {};

  // the plane's acceleration is above the limit while |angular t - 2 pi k| < reach
  const double reach = std::acos(limit / greatest);
  double gone = 0, begin = 0;
  while (begin <= time) {
    const double cycle = std::round(plane.angular * begin / two_pi);
    const Slip slip{plane, begin, limit};
    const double end = end_of(slip, (two_pi * cycle + reach) / plane.angular);
    if (end >= time) return {gone + slip.distance(time), slip.velocity(time)};
    gone += slip.distance(end);
    // the next time the limit is exceeded, or now if it is exceeded already
    const double phase = plane.angular * end, next = std::ceil((phase - reach) / two_pi);
    begin = std::max(end, (two_pi * next - reach) / plane.angular);
  }
  return {gone, 0};
}

double slip_of_pulse(double speed, double acceleration, double held) {
  if (!(speed > 0 && held > 0)) throw std::invalid_argument("pulse: speed and friction must be positive");
  return acceleration > held ? 0.5 * speed * speed * (1 / held - 1 / acceleration) : 0;
}

}  // namespace voussoir::reference
