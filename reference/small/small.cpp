#include "reference/small/small.hpp"

#include <cmath>
#include <numbers>

#include "reference/require.hpp"

namespace voussoir::reference {
namespace {

using std::numbers::pi;

constexpr Require block_requires{""};

void check(const Incline& incline, double time) {
  block_requires(incline.angle >= 0 && incline.angle <= pi / 2, "incline: angle must be in 0..pi/2 radians");
  block_requires(incline.friction_angle >= 0 && incline.friction_angle < pi / 2,
                 "incline: friction angle must be in 0..pi/2 radians, pi/2 excluded");
  block_requires(std::isfinite(incline.gravity) && incline.gravity > 0, "incline: gravity must be positive");
  block_requires(std::isfinite(incline.initial_velocity) && incline.initial_velocity >= 0,
                 "incline: initial velocity must be finite and down the plane");
  block_requires(std::isfinite(time) && time >= 0, "incline: time must be finite and not negative");
}

struct Slide {
  double acceleration = 0, moving_time = 0;
};

Slide slide_of(const Incline& incline, double time) {
  check(incline, time);
  const double acceleration =
      incline.gravity * (std::sin(incline.angle) - std::cos(incline.angle) * std::tan(incline.friction_angle));
  if (acceleration >= 0) return {incline.initial_velocity > 0 || acceleration > 0 ? acceleration : 0, time};
  return {acceleration, std::min(time, -incline.initial_velocity / acceleration)};
}

void check(const Column& column) {
  block_requires(column.blocks >= 1, "column: at least one block");
  block_requires(std::isfinite(column.mass) && column.mass > 0, "column: mass must be positive");
  block_requires(std::isfinite(column.stiffness) && column.stiffness > 0, "column: stiffness must be positive");
  block_requires(std::isfinite(column.gravity), "column: gravity must be finite");
}

}  // namespace

double incline_critical_friction(const Incline& incline) {
  check(incline, 0);
  return incline.angle;
}

double incline_distance(const Incline& incline, double time) {
  const auto [acceleration, moving] = slide_of(incline, time);
  return incline.initial_velocity * moving + acceleration * moving * moving / 2;
}

double incline_velocity(const Incline& incline, double time) {
  const auto [acceleration, moving] = slide_of(incline, time);
  return moving < time ? 0 : incline.initial_velocity + acceleration * moving;
}

double incline_rate_bias(const Incline& incline, double distance, double rate, double damping) {
  check(incline, 0);
  block_requires(std::isfinite(distance) && distance > 0, "incline: distance must be positive");
  block_requires(std::isfinite(rate) && rate > 0, "incline: rate must be positive");
  block_requires(damping >= 0 && damping < 1, "incline: damping must be in 0..1, 1 excluded");
  return std::cbrt(6 * distance * std::cos(incline.angle) * rate * rate / ((1 - damping) * incline.gravity));
}

std::vector<double> column_overlaps(const Column& column) {
  check(column);
  std::vector<double> overlaps;
  for (int joint = 0; joint < column.blocks; ++joint)
    overlaps.push_back((column.blocks - joint) * column.mass * column.gravity / column.stiffness);
  return overlaps;
}

double column_frequency(const Column& column, int mode) {
  check(column);
  block_requires(mode >= 1 && mode <= column.blocks, "column: mode must be in 1..blocks");
  return 2 * std::sqrt(column.stiffness / column.mass) * std::sin((2 * mode - 1) * pi / (2 * (2 * column.blocks + 1)));
}

std::array<double, 3> box_inertia(double mass, const std::array<double, 3>& edges) {
  block_requires(mass > 0 && edges[0] > 0 && edges[1] > 0 && edges[2] > 0, "box: mass and edges must be positive");
  const double x = edges[0] * edges[0], y = edges[1] * edges[1], z = edges[2] * edges[2];
  return {mass * (y + z) / 12, mass * (z + x) / 12, mass * (x + y) / 12};
}

}  // namespace voussoir::reference
