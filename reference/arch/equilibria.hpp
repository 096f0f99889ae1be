#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "reference/arch/arch.hpp"
#include "reference/peak.hpp"

// How equilibria of an arch on elastic joints are found; for elastic_arch and loaded_arch only. From the right
// springing, where the force is guessed, statics in the deformed geometry gives the force of one joint after the other,
// and the joint's law the place of the next voussoir. Newton's method satisfies the conditions at the other end, and
// equilibria follow one another along a path on which some displacement grows.
namespace voussoir::reference {

using Plane = Eigen::Vector2d;

inline double cross(const Plane& a, const Plane& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// force of the right abutment (N/m) on the arch, m from the middle of the joint outwards
struct FootForce {
  Plane force;
  double crossing = 0;
};

// a vertical load (N/m, downwards) on a point of voussoir k from the left; none for k = -1
struct PointLoad {
  int voussoir = -1;
  Plane point{0, 0};  // m, before any motion
  double force = 0;
};

// the motion of a body: about the centre of the circle, and where it takes the centre
struct Moved {
  double turn = 0;
  Plane place{0, 0};

  Plane way_of(const Plane& point) const;  // m
};

struct March {
  std::vector<ElasticJoint> joints;  // from the right springing on
  Moved beyond;                      // the body beyond the last joint
  Moved loaded;                      // the voussoir with the load, when it was met
};

// over so many voussoirs, to the body beyond them; none if a joint would have to pull
std::optional<March> march(const Arch& arch, const ArchJoints& joints, double thickness, const FootForce& foot,
                           int voussoirs, const PointLoad& load = {});

// unknowns, as shares of weight and radius, and the result of shooting with them
struct Shot {
  Eigen::VectorXd from;
  March march;
};

// The unknowns at which `residual(shot)`, of as many entries, vanishes; `shoot(unknowns)` may have no result.
template <class Shoot, class Residual>
std::optional<Shot> solve(const Arch& arch, Eigen::VectorXd x, const Shoot& shoot, const Residual& residual) {
  constexpr double small = 1e-7;  // of the unknowns, for differences
  constexpr double tolerance = 1e-12;
  constexpr int limit = 200;
  std::optional<Shot> shot = shoot(x);
  for (int i = 0; shot && i < limit; ++i) {
    const Eigen::VectorXd now = residual(*shot);
    if (now.cwiseAbs().maxCoeff() < tolerance) return shot;
    double shortest = arch.radius;
    for (const ElasticJoint& joint : shot->march.joints)
      shortest = std::min(shortest, joint.bearing);
    Eigen::MatrixXd slope(x.size(), x.size());
    for (int k = 0; k < x.size(); ++k) {
      // a one-sided difference if the other side is outside
      Eigen::VectorXd step = Eigen::VectorXd::Zero(x.size());
      step[k] = small * shortest / arch.radius;
      std::optional<Shot> other = shoot(x + step);
      if (!other) other = shoot(x - step), step = -step;
      if (!other) return {};
      slope.col(k) = (residual(*other) - now) / step[k];
    }
    const Eigen::VectorXd change = slope.fullPivLu().solve(-now);
    double share = 1;
    std::optional<Shot> next;
    for (; share > 1e-6; share *= 0.5) {
      next = shoot(x + share * change);
      if (next && residual(*next).norm() < now.norm()) break;
      next.reset();
    }
    // rounding ends the descent
    if (!next) return now.cwiseAbs().maxCoeff() < 1e3 * tolerance ? shot : std::nullopt;
    x += share * change;
    shot = next;
  }
  return {};
}

// Equilibria from the first on, `way(shot)` growing by 5 % or less each time, until `ends(shot)`; `at(way, unknowns)`
// finds one from unknowns nearby, extrapolated from the last two. Other equilibria with the same displacement may
// exist: one far from that extrapolation is not on the path. Throws std::runtime_error if it finds none.
template <class Way, class At, class Ends>
std::vector<Shot> follow(const Shot& first, const Way& way, const At& at, const Ends& ends) {
  constexpr double growth = 1.05, beside = 0.5;  // of the line's step
  std::vector<Shot> path{first};
  while (!ends(path.back())) {
    const double last = way(path.back());
    std::optional<Shot> next;
    for (double factor = growth; !next; factor = std::sqrt(factor)) {
      if (factor < 1 + 1e-6) throw std::runtime_error("elastic arch: the path of equilibria is lost");
      Eigen::VectorXd step = Eigen::VectorXd::Zero(path.back().from.size());
      if (path.size() > 1) {
        const Shot& before = path[path.size() - 2];
        step = (factor - 1) * last / (last - way(before)) * (path.back().from - before.from);
      }
      const Eigen::VectorXd guess = path.back().from + step;
      next = at(factor * last, guess);
      if (next && !(way(*next) > last)) next.reset();
      if (next && path.size() > 1 && (next->from - guess).norm() > beside * step.norm()) next.reset();
    }
    path.push_back(*next);
  }
  return path;
}

// The equilibrium of a path, between its members too, whose value is greatest.
template <class Value, class Way, class At>
Shot greatest_along(const std::vector<Shot>& path, const Value& value, const Way& way, const At& at) {
  const auto most =
      std::max_element(path.begin(), path.end(), [&](const Shot& a, const Shot& b) { return value(a) < value(b); });
  if (most == path.begin() || most + 1 == path.end()) throw std::runtime_error("elastic arch: the path has no limit");
  const auto exactly = [&](double there) {
    const std::optional<Shot> found = at(there, most->from);
    if (!found) throw std::runtime_error("elastic arch: no equilibrium found beside the limit");
    return *found;
  };
  constexpr int sections = 30;
  return exactly(peak([&](double there) { return value(exactly(there)); }, way(most[-1]), way(most[1]), sections).at);
}

}  // namespace voussoir::reference
