#include "reference/arch/arch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reference/peak.hpp"

namespace voussoir::reference {
namespace {

using std::numbers::pi;

// load on a joint of the right half: weight from the crown to it, and its moment about the centre
struct Above {
  double angle = 0, weight = 0, moment = 0;
};

// from the crown down; an odd number of voussoirs has half the keystone above the first joint
std::vector<Above> joints_of_half(const Arch& arch, double thickness) {
  const double inside = arch.radius - 0.5 * thickness, outside = arch.radius + 0.5 * thickness;
  const double sector = pi / arch.voussoirs;
  const Voussoir voussoir = voussoir_of(arch, thickness);
  std::vector<Above> joints;
  Above above;
  if (arch.voussoirs % 2 == 0) {
    joints.push_back(above);
  } else {
    // half a trapezoid: its centroid is at half the mean of its widths, weighted with them
    above = {0.5 * sector, 0.5 * voussoir.weight, 0};
    const double half = 0.5 * sector, slope = std::tan(half), from = inside * std::cos(half),
                 to = outside * std::cos(half);
    above.moment = arch.weight * slope * slope * (std::pow(to, 3) - std::pow(from, 3)) / 6;
    joints.push_back(above);
  }
  while (static_cast<int>(joints.size()) < (arch.voussoirs + 2) / 2) {
    const double middle = above.angle + 0.5 * sector;
    above.weight += voussoir.weight;
    above.moment += voussoir.weight * voussoir.centroid * std::sin(middle);
    above.angle += sector;
    joints.push_back(above);
  }
  return joints;
}

// The bounds of H y0 at thrust H, joint by joint: highest of the lower and lowest of the upper ones.
struct Window {
  double low = -1e300, high = 1e300;
};

Window window(const std::vector<Above>& joints, double inside, double outside, double thrust) {
  Window w;
  for (const Above& j : joints) {
    const double lever = j.weight * std::sin(j.angle) + thrust * std::cos(j.angle);
    w.low = std::max(w.low, inside * lever - j.moment);
    w.high = std::min(w.high, outside * lever - j.moment);
  }
  return w;
}

}  // namespace

std::vector<Corner> voussoir_corners(const Arch& arch, double thickness, int k) {
  const double sector = pi / arch.voussoirs, left = k * sector - 0.5 * pi, right = left + sector;
  const double inside = arch.radius - 0.5 * thickness, outside = arch.radius + 0.5 * thickness;
  const auto at = [](double radius, double angle) {
    return Corner{radius * std::sin(angle), radius * std::cos(angle)};
  };
  return {at(inside, left), at(inside, right), at(outside, right), at(outside, left)};
}

Voussoir voussoir_of(const Arch& arch, double thickness) {
  const double inside = arch.radius - 0.5 * thickness, outside = arch.radius + 0.5 * thickness;
  const double across = outside * outside - inside * inside, sector = pi / arch.voussoirs;
  return {arch.weight * 0.5 * across * std::sin(sector),
          std::cos(0.5 * sector) * 2 / 3 * (std::pow(outside, 3) - std::pow(inside, 3)) / across};
}

ThrustLine best_thrust_line(const Arch& arch, double thickness) {
  const double inside = arch.radius - 0.5 * thickness, outside = arch.radius + 0.5 * thickness;
  const std::vector<Above> joints = joints_of_half(arch, thickness);

  // high - low is concave in H
  const auto width = [&](double thrust) {
    const Window w = window(joints, inside, outside, thrust);
    return w.high - w.low;
  };
  constexpr int sections = 90;
  ThrustLine line;
  line.thrust = peak(width, 0, 3 * joints.back().weight, sections).at;
  line.half_weight = joints.back().weight;
  const Window w = window(joints, inside, outside, line.thrust);
  const double moment = 0.5 * (w.low + w.high);
  line.margin = 1e300;
  for (const Above& j : joints) {
    const double lever = j.weight * std::sin(j.angle) + line.thrust * std::cos(j.angle);
    line.angle.push_back(j.angle);
    line.radius.push_back((moment + j.moment) / lever);
    line.margin = std::min({line.margin, line.radius.back() - inside, outside - line.radius.back()});
  }
  return line;
}

double minimum_thickness(const Arch& arch) {
  double low = 1e-3 * arch.radius, high = 0.5 * arch.radius;
  while (high - low > 1e-13 * arch.radius) {
    const double middle = 0.5 * (low + high);
    (best_thrust_line(arch, middle).margin < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace voussoir::reference
