#include "reference/pushed_column/pushed_column.hpp"

#include <cmath>
#include <stdexcept>

#include "reference/peak.hpp"

namespace voussoir::reference {
namespace {

// about the centre of pressure, m
struct Levers {
  double weight = 0, push = 0;
};

// x along the ground, y up, from the end of the base that has lifted
Levers levers_of(const PushedColumn& c, const Push& push, double tilt, double pressed) {
  const double cosine = std::cos(tilt), sine = std::sin(tilt), half = 0.5 * tilt;
  const double corner = pressed * std::cos(half);  // along the base
  const auto x = [&](double along, double up) { return (corner - 0.5 * c.breadth + along) * cosine + up * sine; };
  const auto y = [&](double along, double up) { return -(corner - 0.5 * c.breadth + along) * sine + up * cosine; };
  const double centre_x = 2.0 / 3 * pressed * std::cos(half), centre_y = -2.0 / 3 * pressed * std::sin(half);
  const double point_x = x(push.x, push.y) - centre_x, point_y = y(push.x, push.y) - centre_y;
  return {centre_x - x(0, 0.5 * c.height), push.turns ? point_y * cosine + point_x * sine : point_y};
}

}  // namespace

double rigid_push(const PushedColumn& column, const Push& push) {
  return 0.5 * column.weight * column.breadth / push.y;
}

double push_at(const PushedColumn& c, const Push& push, double tilt) {
  if (!(tilt > 0)) throw std::invalid_argument("pushed column: it must lean");
  constexpr int rounds = 30;  // the length depends on the force only by a fraction of the tilt
  const double half = 0.5 * tilt, along_normal = push.turns ? -std::sin(half) : std::sin(half);
  double force = 0, pressed = 0;
  for (int i = 0; i < rounds; ++i) {
    const double normal = c.weight * std::cos(half) - force * along_normal;
    pressed = std::sqrt(normal / (c.stiffness * std::tan(half)));
    const Levers levers = levers_of(c, push, tilt, pressed);
    force = c.weight * levers.weight / levers.push;
  }
  if (pressed * std::cos(half) > c.breadth) throw std::invalid_argument("pushed column: its whole base is pressed");
  return force;
}

Tipping tipping(const PushedColumn& c, const Push& push) {
  // about the tilt of the first order
  constexpr int sections = 80;
  const double about = std::cbrt(2 * c.weight / (9 * c.stiffness * c.height * c.height));
  const Peak most = peak([&](double tilt) { return push_at(c, push, tilt); }, 0.5 * about, 2 * about, sections);
  return {most.value, most.at};
}

double tilt_under(const PushedColumn& c, const Push& push, double force) {
  const Tipping limit = tipping(c, push);
  // at which the whole base is pressed but for its end
  double low = 1.001 * 2 * c.weight / (c.stiffness * c.breadth * c.breadth), high = limit.tilt;
  if (!(force < limit.force) || !(force > push_at(c, push, low)))
    throw std::invalid_argument("pushed column: under this force it has no equilibrium on a part of its base");
  while (high - low > 1e-14 * high) {
    const double middle = 0.5 * (low + high);
    (push_at(c, push, middle) < force ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Ride shaken_ride(double force_over_mass, double angular_frequency, double phase, double time) {
  const double w = angular_frequency, end = w * time + phase;
  return {force_over_mass / (w * w) * (w * time * std::cos(phase) + std::sin(phase) - std::sin(end)),
          force_over_mass / w * (std::cos(phase) - std::cos(end))};
}

Spiral spun_up(double force_over_mass, double moment_over_inertia, double time) {
  constexpr int strips = 20'000;  // midpoint rule: to 1e-8 over some turns
  const double width = time / strips;
  Spiral s;
  for (int i = 0; i < strips; ++i) {
    const double then = (i + 0.5) * width, turn = 0.5 * moment_over_inertia * then * then;
    s.along += force_over_mass * std::cos(turn) * (time - then) * width;
    s.aside += force_over_mass * std::sin(turn) * (time - then) * width;
  }
  s.turn = 0.5 * moment_over_inertia * time * time;
  return s;
}

}  // namespace voussoir::reference
