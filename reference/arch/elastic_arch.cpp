#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "reference/arch/arch.hpp"

namespace voussoir::reference {
namespace {

using Plane = Eigen::Vector2d;
using Unknowns = Eigen::Vector3d;  // thrust over half the weight, crossing at the springing and thickness over R

double cross(const Plane& a, const Plane& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Plane turned(const Plane& v, double angle) {
  return Eigen::Rotation2Dd(angle) * v;
}

// A face pressed by `force` (N/m) at `crossing` from its middle: overlap `closing + slope s` where positive.
struct Bearing {
  double closing, slope, length;
};

std::optional<Bearing> press(double force, double crossing, double thickness, double stiffness) {
  if (!(force > 0) || !(std::abs(crossing) < 0.5 * thickness)) return {};
  if (std::abs(crossing) <= thickness / 6)
    return Bearing{force / (stiffness * thickness), 12 * force * crossing / (stiffness * std::pow(thickness, 3)),
                   thickness};
  // a triangle from the near end
  const double length = 3 * (0.5 * thickness - std::abs(crossing)), deepest = 2 * force / (stiffness * length);
  return Bearing{deepest - deepest / length * 0.5 * thickness, std::copysign(deepest / length, crossing), length};
}

struct Shot {
  Unknowns from;
  ElasticArch arch;
  double turn = 0;  // of the keystone
  Plane move;       // of its crown, m
};

// From the springing, where thrust and crossing are given, joint by joint to the keystone: forces follow from statics
// in the deformed geometry, the next voussoir's place from what the joint gives.
std::optional<Shot> shoot(const Arch& arch, const ArchJoints& joints, const Unknowns& x) {
  const int full = arch.voussoirs / 2;
  const double sector = std::numbers::pi / arch.voussoirs, thickness = x[2] * arch.radius;
  const double inside = arch.radius - 0.5 * thickness, outside = arch.radius + 0.5 * thickness;
  const double across = outside * outside - inside * inside;
  const double weight = arch.weight * 0.5 * across * std::sin(sector);
  const double centroid = std::cos(0.5 * sector) * 2 / 3 * (std::pow(outside, 3) - std::pow(inside, 3)) / across;

  const double half_weight = (full + 0.5) * weight;
  Plane force(-x[0] * half_weight, half_weight);
  double moment = cross(Plane(arch.radius * (1 + x[1]), 0), force);  // about the centre of the circle
  Shot shot;
  shot.from = x;
  shot.arch.thickness = thickness;
  shot.arch.thrust = -force.x();
  double turn = 0;  // of the body below the joint, and where it takes the centre
  Plane place(0, 0);
  for (int k = 0; k <= full; ++k) {
    const double angle = 0.5 * std::numbers::pi - k * sector;
    const Plane out(std::sin(angle), std::cos(angle)), middle = arch.radius * out;
    const Plane at = place + turned(middle, turn);

    // the joint's plane stands half way between its two faces
    double slope = 0, crossing = 0, slip = 0;
    std::optional<Bearing> bearing;
    Plane along, normal;
    for (int i = 0; i < 4; ++i) {
      along = turned(out, turn - 0.5 * slope);
      normal = Plane(-along.y(), along.x());
      const double pressure = force.dot(normal);
      crossing = (moment - cross(at, force)) / pressure;
      bearing = press(pressure, crossing, thickness, joints.normal_stiffness);
      if (!bearing) return {};
      slope = bearing->slope;
      slip = -force.dot(along) / (joints.shear_stiffness * bearing->length);
    }
    turn -= slope;
    place = at - bearing->closing * normal + slip * along - turned(middle, turn);
    shot.arch.angle.push_back(angle);
    shot.arch.crossing.push_back(crossing);
    shot.arch.turn.push_back(slope);
    shot.arch.bearing.push_back(bearing->length);

    if (k == full) break;
    const double between = angle - 0.5 * sector;
    const Plane heavy = place + turned(centroid * Plane(std::sin(between), std::cos(between)), turn);
    force.y() -= weight;
    moment -= weight * heavy.x();
  }
  shot.turn = turn;
  const Plane crown(0, arch.radius);
  shot.move = place + turned(crown, turn) - crown;
  shot.arch.drop = -shot.move.y();
  return shot;
}

// what must vanish: keystone's turn, its way sideways, and the third condition
template <class Condition>
std::optional<Shot> solve(const Arch& arch, const ArchJoints& joints, Unknowns x, const Condition& condition) {
  constexpr double small = 1e-7;  // of the unknowns, for differences
  constexpr double tolerance = 1e-12;
  constexpr int limit = 200;
  const auto residual = [&](const Shot& s) { return Eigen::Vector3d(s.turn, s.move.x() / arch.radius, condition(s)); };
  std::optional<Shot> shot = shoot(arch, joints, x);
  for (int i = 0; shot && i < limit; ++i) {
    const Eigen::Vector3d now = residual(*shot);
    if (now.cwiseAbs().maxCoeff() < tolerance) return shot;
    Eigen::Matrix3d slope;
    for (int k = 0; k < 3; ++k) {
      // a difference to the one side where the other is outside
      double step = small * std::min(1.0, shot->arch.bearing[0] / arch.radius);
      std::optional<Shot> other = shoot(arch, joints, x + step * Unknowns::Unit(k));
      if (!other) other = shoot(arch, joints, x + (step = -step) * Unknowns::Unit(k));
      if (!other) return {};
      slope.col(k) = (residual(*other) - now) / step;
    }
    const Unknowns change = slope.fullPivLu().solve(-now);
    double share = 1;
    std::optional<Shot> next;
    for (; share > 1e-6; share *= 0.5) {
      next = shoot(arch, joints, x + share * change);
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

// the equilibrium whose keystone has dropped so far, from one nearby
std::optional<Shot> dropped(const Arch& arch, const ArchJoints& joints, double drop, const Shot& near) {
  return solve(arch, joints, near.from, [&](const Shot& s) { return (s.arch.drop - drop) / arch.radius; });
}

// until `ends` says so of the last and of the least thickness so far
template <class End>
std::vector<Shot> path_of(const Arch& arch, const ArchJoints& joints, const End& ends) {
  if (arch.voussoirs % 2 == 0) throw std::invalid_argument("elastic arch: an even number of voussoirs has no keystone");
  if (joints.normal_stiffness > 1e10 * arch.weight) throw std::invalid_argument("elastic arch: joints too hard");
  // a thick arch, from the thrust line of rigid voussoirs
  constexpr double thick = 0.25, growth = 1.05;
  const ThrustLine line = best_thrust_line(arch, thick * arch.radius);
  const double springing = line.radius.back() / arch.radius - 1;
  const std::optional<Shot> first = solve(arch, joints, {line.thrust / line.half_weight, springing, thick},
                                          [&](const Shot& s) { return s.arch.thickness / arch.radius - thick; });
  if (!first) throw std::runtime_error("elastic arch: the thick arch has no equilibrium");
  std::vector<Shot> path{*first};
  double least = first->arch.thickness;
  while (!ends(path.back().arch.thickness, least)) {
    std::optional<Shot> next;
    for (double factor = growth; !next; factor = std::sqrt(factor)) {
      if (factor < 1 + 1e-6) throw std::runtime_error("elastic arch: the path of equilibria is lost");
      next = dropped(arch, joints, factor * path.back().arch.drop, path.back());
    }
    path.push_back(*next);
    least = std::min(least, next->arch.thickness);
  }
  return path;
}

}  // namespace

std::vector<ElasticArch> elastic_arch_path(const Arch& arch, const ArchJoints& joints, double beyond) {
  const auto ends = [&](double thickness, double least) { return thickness > (1 + beyond) * least; };
  std::vector<ElasticArch> path;
  for (const Shot& shot : path_of(arch, joints, ends))
    path.push_back(shot.arch);
  return path;
}

ElasticArch elastic_arch(const Arch& arch, const ArchJoints& joints, double thickness) {
  const std::vector<Shot> path =
      path_of(arch, joints, [&](double last, double least) { return last <= thickness || last > least; });
  const std::optional<Shot> found = solve(arch, joints, path[path.size() - 2].from,
                                          [&](const Shot& s) { return (s.arch.thickness - thickness) / arch.radius; });
  if (path.back().arch.thickness > thickness || !found)
    throw std::runtime_error("elastic_arch: an arch so thin does not stand");
  return found->arch;
}

ElasticArch thinnest_elastic_arch(const Arch& arch, const ArchJoints& joints) {
  // a little beyond the least, so that it is bracketed
  const std::vector<Shot> path = path_of(arch, joints, [](double last, double least) { return last > 1.001 * least; });
  const auto thinner = [](const Shot& a, const Shot& b) { return a.arch.thickness < b.arch.thickness; };
  const auto least = std::min_element(path.begin(), path.end(), thinner);
  if (least == path.begin()) throw std::runtime_error("thinnest_elastic_arch: the path has no minimum");

  // golden section between the neighbours: a flat minimum is found to the root of rounding, its thickness to rounding
  constexpr double golden = 0.6180339887498949;
  constexpr int steps = 30;
  double low = least[-1].arch.drop, high = least[1].arch.drop;
  const auto at = [&](double drop) {
    const std::optional<Shot> found = dropped(arch, joints, drop, *least);
    if (!found) throw std::runtime_error("thinnest_elastic_arch: no equilibrium found");
    return *found;
  };
  Shot a = at(high - golden * (high - low)), b = at(low + golden * (high - low));
  for (int i = 0; i < steps; ++i) {
    if (thinner(a, b)) {
      high = b.arch.drop, b = a;
      a = at(high - golden * (high - low));
    } else {
      low = a.arch.drop, a = b;
      b = at(low + golden * (high - low));
    }
  }
  return thinner(a, b) ? a.arch : b.arch;
}

}  // namespace voussoir::reference
