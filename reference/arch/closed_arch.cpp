#include "reference/arch/equilibria.hpp"

namespace voussoir::reference {
namespace {

// The whole arch. Unknowns: thrust and upward force at the right springing over the weight, crossing there over the
// radius.
struct OnClosedSupports {
  Arch arch;
  ArchJoints joints;
  double thickness = 0, weight = 0;

  std::optional<Shot> shoot(const Eigen::VectorXd& x) const {
    const FootForce foot{weight * Plane(-x[0], x[1]), x[2] * arch.radius};
    const std::optional<March> marched = march(arch, joints, thickness, foot, arch.voussoirs);
    return marched ? std::optional(Shot{x, *marched}) : std::nullopt;
  }

  // the left abutment has moved towards the right one by `closed`, without rotation
  std::optional<Shot> find(double closed, const Eigen::VectorXd& from) const {
    return solve(
        arch, from, [&](const Eigen::VectorXd& x) { return shoot(x); },
        [&](const Shot& s) -> Eigen::VectorXd {
          const Moved& abutment = s.march.beyond;
          return Eigen::Vector3d(abutment.turn, (abutment.place.x() - closed) / arch.radius,
                                 abutment.place.y() / arch.radius);
        });
  }
};

}  // namespace

ClosedArch closed_arch(const Arch& arch, const ArchJoints& joints, double thickness, double closed) {
  constexpr double first_step = 1e-6, growth = 1.3, least_step = 1e-12;  // over the radius
  const OnClosedSupports whole{arch, joints, thickness, arch.voussoirs * voussoir_of(arch, thickness).weight};
  const ThrustLine line = best_thrust_line(arch, thickness);
  const Eigen::Vector3d guess(0.5 * line.thrust / line.half_weight, 0.5, line.radius.back() / arch.radius - 1);
  std::optional<Shot> now = whole.find(0, guess);
  double at = 0, step = std::copysign(first_step * arch.radius, closed);
  while (now && at != closed) {
    const double next = std::abs(closed - at) > std::abs(step) ? at + step : closed;
    if (const std::optional<Shot> found = whole.find(next, now->from)) {
      now = found;
      at = next;
      step *= growth;
    } else if (std::abs(step *= 0.5) < least_step * arch.radius) {
      break;
    }
  }
  if (!now || at != closed) throw std::runtime_error("closed arch: the path of equilibria is lost");
  return {now->from[0] * whole.weight, whole.weight, now->march.joints};
}

}  // namespace voussoir::reference
