#include "reference/water/ringing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace voussoir::reference {
namespace {

// A phase is sampled this often in a period of the faster vibration: one that ends sooner is not counted. The slips are
// some tenth of a period long.
constexpr int looks_in_a_period = 2000;
// Rounding of the strength, over the incline's force: a block that stays on the limit does not slip.
constexpr double rounding = 1e-12;

struct Ringing {
  double normal_rate = 0, shear_rate = 0;  // rad/s
  double drive = 0;                        // m/s^2, g sin
  double strength = 0;                     // m/s^2, g cos tan phi

  // strength of the slider by the mass, its slope and the integrals of it from time zero
  double limit(double t) const { return strength * (1 - 0.5 * std::cos(normal_rate * t)); }
  double limit_slope(double t) const { return 0.5 * strength * normal_rate * std::sin(normal_rate * t); }
  double limit_sum(double t) const { return strength * (t - 0.5 * std::sin(normal_rate * t) / normal_rate); }
  double limit_sum_sum(double t) const {
    return strength * (0.5 * t * t + 0.5 * (std::cos(normal_rate * t) - 1) / (normal_rate * normal_rate));
  }
};

struct Motion {
  double place = 0, speed = 0;
};

// from `start` at t0 with the plastic slip `slip`: m x'' = m g sin - ks (x - slip)
Motion sticking(const Ringing& r, const Motion& start, double slip, double t0, double t) {
  const double middle = slip + r.drive / (r.shear_rate * r.shear_rate);
  const double c = std::cos(r.shear_rate * (t - t0)), s = std::sin(r.shear_rate * (t - t0));
  return {middle + (start.place - middle) * c + start.speed * s / r.shear_rate,
          -(start.place - middle) * r.shear_rate * s + start.speed * c};
}

// x'' = g sin - sense limit(t): integrated twice
Motion slipping(const Ringing& r, const Motion& start, double sense, double t0, double t) {
  const double dt = t - t0;
  return {start.place + start.speed * dt + 0.5 * r.drive * dt * dt -
              sense * (r.limit_sum_sum(t) - r.limit_sum_sum(t0) - r.limit_sum(t0) * dt),
          start.speed + r.drive * dt - sense * (r.limit_sum(t) - r.limit_sum(t0))};
}

}  // namespace

double ringing_slip(const RingingBlock& block, double time) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  if (!positive(block.mass) || !positive(block.normal_stiffness) || !positive(block.shear_stiffness) ||
      !positive(block.gravity))
    throw std::invalid_argument("ringing block: mass, stiffnesses and gravity must be positive");
  if (!(block.incline > 0 && block.incline < block.friction_angle && block.friction_angle < std::numbers::pi / 2))
    throw std::invalid_argument("ringing block: the incline must be between 0 and the friction angle");
  if (!(std::isfinite(time) && time >= 0)) throw std::invalid_argument("ringing block: time must not be negative");
  const Ringing r{std::sqrt(block.normal_stiffness / block.mass), std::sqrt(block.shear_stiffness / block.mass),
                  block.gravity * std::sin(block.incline),
                  block.gravity * std::cos(block.incline) * std::tan(block.friction_angle)};
  const double spring = r.shear_rate * r.shear_rate;  // by the mass
  const double look = 2 * std::numbers::pi / std::max(r.normal_rate, r.shear_rate) / looks_in_a_period;

  Motion start{0.5 * r.drive / spring, 0};
  double t0 = 0, slip = 0, travelled = 0, sense = 0;  // 0: it sticks; else the direction in which it slips
  while (t0 < time) {
    const auto at = [&](double t) {
      return sense == 0 ? sticking(r, start, slip, t0, t) : slipping(r, start, sense, t0, t);
    };
    const auto slip_at = [&](double t) { return sense == 0 ? slip : at(t).place - sense * r.limit(t) / spring; };
    // positive when the phase has ended: over the strength, or slipping back
    const auto over = [&](double t) {
      const Motion now = at(t);
      if (sense == 0) return std::abs(spring * (now.place - slip)) - r.limit(t) - rounding * r.strength;
      return -(sense * now.speed - r.limit_slope(t) / spring);
    };
    double low = t0, high = std::min(time, t0 + look);
    while (over(high) <= 0 && high < time) {
      low = high;
      high = std::min(time, high + look);
    }
    if (over(high) > 0)
      for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
        (over(middle) <= 0 ? low : high) = middle;
    const Motion end = at(high);
    const double ended_slip = slip_at(high);
    travelled += std::abs(ended_slip - slip);
    sense = sense != 0 ? 0 : (spring * (end.place - slip) > 0 ? 1 : -1);
    slip = ended_slip;
    start = end;
    t0 = high;
  }
  return travelled;
}

}  // namespace voussoir::reference
