#include "reference/limit_space/limit_space.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace voussoir::reference {
namespace {

double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector3 combine(double s, const Vector3& a, double t, const Vector3& b) {
  return {s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]};
}

// the first number in [low, high] from which `holds` is false; `holds` is true below it
double last_that_holds(double low, double high, const std::function<bool(double)>& holds) {
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

constexpr double least_push = -1, most_push = 10;

std::optional<double> push(const std::function<double(double)>& friction_needed, double friction) {
  const auto holds = [&](double factor) { return friction_needed(factor) <= friction; };
  if (holds(most_push)) return {};
  return last_that_holds(least_push, most_push, holds);
}

Vector3 resultant(double factor, const Vector3& direction) {
  return combine(factor, direction, 1, {0, 0, -1});
}

}  // namespace

double dilating_friction(const Vector3& normal_a, const Vector3& normal_b, const Vector3& force) {
  const Vector3 away = combine(1, normal_a, 1, normal_b);
  if (dot(away, force) >= 0) return std::asin(std::min(1.0, 0.5 * std::sqrt(dot(away, away))));
  const double size = std::sqrt(dot(force, force));
  const Vector3 along = combine(1 / size, force, 0, force);
  const auto across = [&](const Vector3& normal) { return combine(1, normal, -dot(normal, along), along); };
  const Vector3 a = across(normal_a), edge = combine(1, across(normal_b), -1, a);
  const double length = dot(edge, edge), place = length > 0 ? std::clamp(-dot(a, edge) / length, 0.0, 1.0) : 0;
  const Vector3 nearest = combine(1, a, place, edge);
  return std::asin(std::min(1.0, std::sqrt(dot(nearest, nearest))));
}

std::optional<double> dilating_push(const Wedge& wedge, const Vector3& direction, double friction) {
  const Vector3 a = upward_normal(wedge.a.dip, wedge.a.dip_direction),
                b = upward_normal(wedge.b.dip, wedge.b.dip_direction);
  if (2 * friction >= std::acos(std::clamp(-dot(a, b), -1.0, 1.0))) return {};  // their cones face each other
  return push([&](double factor) { return dilating_friction(a, b, resultant(factor, direction)); }, friction);
}

std::optional<double> plain_push(const Wedge& wedge, const Vector3& direction, double friction) {
  const auto needed = [&](double factor) {
    Wedge pushed = wedge;
    pushed.extra_force = combine(factor * wedge.weight, direction, 0, direction);
    return critical_friction(pushed).value_or(std::numbers::pi / 2);
  };
  return push(needed, friction);
}

double push_on_incline(const BlockPushedOnIncline& block, double azimuth) {
  const double s = std::sin(block.dip), c = std::cos(block.dip);
  const auto fails = [&](double factor) {
    const double down = s + factor * c * std::cos(azimuth), aside = factor * std::sin(azimuth),
                 normal = c - factor * s * std::cos(azimuth);
    return std::hypot(down, aside) > std::tan(block.friction) * normal ||
           std::abs(down) * block.height > normal * block.along ||
           std::abs(aside) * block.height > normal * block.across;
  };
  return last_that_holds(0, most_push, [&](double factor) { return !fails(factor); });
}

double push_on_wall(const RunningBond& wall, double friction) {
  struct Brick {
    double begin, end;
  };
  std::vector<std::vector<Brick>> courses;
  for (int k = 0; k < wall.courses; ++k) {
    std::vector<Brick> course;
    double begin = 0;
    const double whole = wall.bricks * wall.length;
    while (begin < whole - 1e-12 * whole) {
      const bool half = k % 2 == 1 && begin == 0;
      const double end = std::min(whole, begin + (half ? 0.5 : 1) * wall.length);
      course.push_back({begin, end});
      begin = end;
    }
    courses.push_back(course);
  }
  double least = std::tan(friction);
  for (int k = 0; k < wall.courses; ++k)
    for (std::size_t first = 0; first < courses[k].size(); ++first) {
      // all bricks from `first` on, and those above that rest on them: from the brick over its left end on
      double from = courses[k][first].begin, driving = 0, resisting = 0;
      const double toe = wall.bricks * wall.length;
      for (int above = k; above < wall.courses; ++above) {
        double next = from;
        for (const Brick& brick : courses[above]) {
          if (brick.end <= from + 1e-12 * toe) continue;
          if (above == k && brick.begin < from) continue;
          next = std::min(next, brick.begin);
          const double weight = brick.end - brick.begin;
          resisting += weight * (toe - 0.5 * (brick.begin + brick.end));
          driving += weight * (above - k + 0.5) * wall.height;
        }
        from = next;
      }
      least = std::min(least, resisting / driving);
    }
  return least;
}

double TopplingSlope::height(int column) const {
  return column <= crest ? column * (below - step) : crest * (below - step) - (column - crest) * (above + step);
}

double toppling_friction(const TopplingSlope& slope) {
  const double s = std::sin(slope.dip), c = std::cos(slope.dip), t = slope.thickness;
  // at the foot of the lowest column; zero where friction is enough
  const auto toe_force = [&](double friction) {
    const double mu = std::tan(friction);
    double push = 0;
    for (int n = slope.columns; n >= 1; --n) {
      const double height = slope.height(n), weight = height * t;
      const double from_above = n < slope.crest ? height : height - slope.above,
                   to_below = n <= slope.crest ? height - slope.below : height;
      double topples = push;
      if (n > 1) topples = (push * (from_above - t * mu) + weight / 2 * (height * s - t * c)) / to_below;
      push = std::max({0.0, n > 1 ? topples : 0.0, push - weight * (c * mu - s) / (1 - mu * mu)});
    }
    return push;
  };
  return last_that_holds(slope.dip, 0.78, [&](double friction) { return toe_force(friction) > 0; });
}

}  // namespace voussoir::reference
