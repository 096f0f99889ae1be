#include "core/limit/mechanism.hpp"

#include <cmath>

namespace voussoir {
namespace {

// far above the multipliers' rounding, far below the resolution of a figure or a table
constexpr double at_rest = 1e-6;

}  // namespace

Mechanism describe_mechanism(const Model<2>& model, const std::vector<BodyVelocity>& velocities) {
  Mechanism mechanism;
  double all = 0, of_rotation = 0;
  for (std::size_t b = 0; b < velocities.size(); ++b) {
    const Body<2>& body = model.bodies[b];
    const auto& [velocity, spin] = velocities[b];
    BlockMotion motion{static_cast<int>(b), velocity.norm(), std::abs(spin) * body.radius, 0, {}};
    if (motion.speed + motion.turning <= at_rest) continue;
    const double rotating = body.inertia[0] * spin * spin;
    const double energy = rotating + body.mass * velocity.squaredNorm();
    motion.rotation_fraction = rotating / energy;
    if (motion.turning > at_rest * (motion.speed + motion.turning)) {
      ++mechanism.turning;
      motion.centre = model.origin + body.reference + Vector<2>(-velocity[1], velocity[0]) / spin;
    }
    all += energy;
    of_rotation += rotating;
    mechanism.moving.push_back(motion);
  }
  if (all > 0) mechanism.rotation_fraction = of_rotation / all;
  return mechanism;
}

}  // namespace voussoir
