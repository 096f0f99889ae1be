#include "reference/arch/equilibria.hpp"

namespace voussoir::reference {
namespace {

// One half with the keystone, which symmetry keeps upright in its place. Unknowns: thrust over half the weight,
// crossing at the springing and thickness over the radius.
struct Half {
  Arch arch;
  ArchJoints joints;

  double thickness(const Shot& shot) const { return shot.from[2] * arch.radius; }

  Plane way_of_crown(const Shot& shot) const { return shot.march.beyond.way_of(Plane(0, arch.radius)); }

  double drop(const Shot& shot) const { return -way_of_crown(shot).y(); }

  double half_weight(double thickness) const { return 0.5 * arch.voussoirs * voussoir_of(arch, thickness).weight; }

  std::optional<Shot> shoot(const Eigen::VectorXd& x) const {
    const double thickness = x[2] * arch.radius, half = half_weight(thickness);
    const FootForce foot{{-x[0] * half, half}, x[1] * arch.radius};
    const std::optional<March> marched = march(arch, joints, thickness, foot, arch.voussoirs / 2);
    return marched ? std::optional(Shot{x, *marched}) : std::nullopt;
  }

  // keystone's rotation, its sideways displacement, and the third condition must vanish
  template <class Condition>
  std::optional<Shot> find(const Eigen::VectorXd& from, const Condition& condition) const {
    return solve(
        arch, from, [&](const Eigen::VectorXd& x) { return shoot(x); },
        [&](const Shot& s) -> Eigen::VectorXd {
          return Eigen::Vector3d(s.march.beyond.turn, way_of_crown(s).x() / arch.radius, condition(s));
        });
  }

  std::optional<Shot> with_thickness(double wanted, const Eigen::VectorXd& from) const {
    return find(from, [&](const Shot& s) { return (thickness(s) - wanted) / arch.radius; });
  }

  std::optional<Shot> with_drop(double wanted, const Eigen::VectorXd& from) const {
    return find(from, [&](const Shot& s) { return (drop(s) - wanted) / arch.radius; });
  }

  ElasticArch described(const Shot& s) const {
    return {thickness(s), drop(s), s.from[0] * half_weight(thickness(s)), s.march.joints};
  }
};

Half half_of(const Arch& arch, const ArchJoints& joints) {
  if (arch.voussoirs % 2 == 0) throw std::invalid_argument("elastic arch: an even number of voussoirs has no keystone");
  if (joints.normal_stiffness > 1e10 * arch.weight) throw std::invalid_argument("elastic arch: joints too hard");
  return {arch, joints};
}

// until `ends` is true of the last and of the least thickness so far
template <class End>
std::vector<Shot> path_of(const Half& half, const End& ends) {
  // a thick arch, from the thrust line of rigid voussoirs
  constexpr double thick = 0.25;
  const double radius = half.arch.radius;
  const ThrustLine line = best_thrust_line(half.arch, thick * radius);
  const std::optional<Shot> first = half.with_thickness(
      thick * radius, Eigen::Vector3d(line.thrust / line.half_weight, line.radius.back() / radius - 1, thick));
  if (!first) throw std::runtime_error("elastic arch: the thick arch has no equilibrium");
  double least = half.thickness(*first);
  return follow(
      *first, [&](const Shot& s) { return half.drop(s); },
      [&](double drop, const Eigen::VectorXd& near) { return half.with_drop(drop, near); },
      [&](const Shot& last) {
        least = std::min(least, half.thickness(last));
        return ends(half.thickness(last), least);
      });
}

}  // namespace

std::vector<ElasticArch> elastic_arch_path(const Arch& arch, const ArchJoints& joints, double beyond) {
  const Half half = half_of(arch, joints);
  const auto ends = [&](double thickness, double least) { return thickness > (1 + beyond) * least; };
  std::vector<ElasticArch> path;
  for (const Shot& shot : path_of(half, ends))
    path.push_back(half.described(shot));
  return path;
}

ElasticArch elastic_arch(const Arch& arch, const ArchJoints& joints, double thickness) {
  const Half half = half_of(arch, joints);
  const std::vector<Shot> path =
      path_of(half, [&](double last, double least) { return last <= thickness || last > least; });
  const std::optional<Shot> found = half.with_thickness(thickness, path[path.size() - 2].from);
  if (half.thickness(path.back()) > thickness || !found)
    throw std::runtime_error("elastic_arch: so thin an arch has no equilibrium");
  return half.described(*found);
}

ElasticArch thinnest_elastic_arch(const Arch& arch, const ArchJoints& joints) {
  const Half half = half_of(arch, joints);
  // a little beyond the least, so that it is bracketed
  const std::vector<Shot> path = path_of(half, [](double last, double least) { return last > 1.001 * least; });
  return half.described(greatest_along(
      path, [&](const Shot& s) { return -half.thickness(s); }, [&](const Shot& s) { return half.drop(s); },
      [&](double drop, const Eigen::VectorXd& near) { return half.with_drop(drop, near); }));
}

}  // namespace voussoir::reference
