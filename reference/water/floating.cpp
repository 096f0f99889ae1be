#include "reference/water/floating.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "reference/require.hpp"

namespace voussoir::reference {
namespace {

constexpr double pi = std::numbers::pi;

constexpr Require require{"floating block: "};

void check(const FloatingBlock& block) {
  require(std::isfinite(block.width) && block.width > 0, "width must be positive");
  require(std::isfinite(block.height) && block.height > 0, "height must be positive");
  require(block.relative_density > 0 && block.relative_density < 1, "relative density must be between 0 and 1");
  require(std::isfinite(block.gravity) && block.gravity > 0, "gravity must be positive");
}

// BM = I/V: from the centre of buoyancy to the metacentre
double metacentric_radius(const FloatingBlock& block) {
  return block.width * block.width / (12 * draught(block));
}

// the tangent of the heel at which the deck's edge, or the keel's, meets the water
double largest_tangent(const FloatingBlock& block) {
  const double depth = draught(block);
  return 2 * std::min(depth, block.height - depth) / block.width;
}

}  // namespace

double draught(const FloatingBlock& block) {
  check(block);
  return block.relative_density * block.height;
}

double metacentric_height(const FloatingBlock& block) {
  return metacentric_radius(block) + 0.5 * draught(block) - 0.5 * block.height;
}

double heave_period(const FloatingBlock& block) {
  return 2 * pi * std::sqrt(draught(block) / block.gravity);
}

double roll_period(const FloatingBlock& block) {
  const double arm = metacentric_height(block);
  require(arm > 0, "it does not float upright, and so does not roll about that position");
  return 2 * pi * std::hypot(block.width, block.height) / std::sqrt(12 * block.gravity * arm);
}

double least_stable_ratio(double relative_density) {
  check({1, 1, relative_density, 1});
  return std::sqrt(6 * relative_density * (1 - relative_density));
}

double righting_arm(const FloatingBlock& block, double heel) {
  check(block);
  const double tangent = std::tan(heel);
  require(std::abs(heel) < 0.5 * pi && std::abs(tangent) <= largest_tangent(block),
          "at this heel its deck or its keel cuts the water");
  return std::sin(heel) * (metacentric_height(block) + 0.5 * metacentric_radius(block) * tangent * tangent);
}

double angle_of_loll(const FloatingBlock& block) {
  const double arm = metacentric_height(block);
  if (arm >= 0) return 0;
  const double tangent = std::sqrt(-2 * arm / metacentric_radius(block));
  require(tangent <= largest_tangent(block), "it heels until its deck or its keel cuts the water");
  return std::atan(tangent);
}

Submerged submerged_rectangle(double width, double height, double turn, double above) {
  check({width, height, 0.5, 1});
  const double c = std::cos(turn), s = std::sin(turn), x = 0.5 * width, y = 0.5 * height;
  std::array<std::array<double, 2>, 4> corners{{{-x, -y}, {x, -y}, {x, y}, {-x, y}}};
  for (auto& [u, v] : corners) {
    const double turned = c * u - s * v;
    v = s * u + c * v + above;
    u = turned;
  }
  std::vector<std::array<double, 2>> wet;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto &p = corners[i], &q = corners[(i + 1) % corners.size()];
    if (p[1] <= 0) wet.push_back(p);
    if ((p[1] < 0 && q[1] > 0) || (p[1] > 0 && q[1] < 0))
      wet.push_back({p[0] - p[1] * (q[0] - p[0]) / (q[1] - p[1]), 0});
  }
  Submerged found;
  for (std::size_t i = 0; i < wet.size(); ++i) {
    const auto &p = wet[i], &q = wet[(i + 1) % wet.size()];
    const double twice = p[0] * q[1] - q[0] * p[1];
    found.volume += 0.5 * twice;
    found.x += (p[0] + q[0]) * twice / 6;
    found.y += (p[1] + q[1]) * twice / 6;
  }
  if (!(found.volume > 0)) return {};
  found.x /= found.volume;
  found.y /= found.volume;
  return found;
}

Submerged submerged_cube_on_corner(double level) {
  const double diagonal = std::numbers::sqrt3;
  require(level >= 0 && level <= diagonal, "the level must be between the cube's lowest and highest corner");
  Submerged found;
  // of edge, sign times number, from a corner at this height
  const auto add = [&](double edge, double times, double from) {
    if (edge <= 0) return;
    const double volume = times * edge * edge * edge / 6;
    found.volume += volume;
    found.y += volume * (from + 0.75 * (level - from));
  };
  add(diagonal * level, 1, 0);
  add(diagonal * level - 1, -3, 1 / diagonal);
  add(diagonal * level - 2, 3, 2 / diagonal);
  if (found.volume > 0) found.y /= found.volume;
  return found;
}

}  // namespace voussoir::reference
