#include "core/limit/mechanism.hpp"

#include "core/model/bodies_state.hpp"

namespace voussoir {
namespace {

// far above the multipliers' rounding, far below the resolution of a figure or a table
constexpr double at_rest = 1e-6;

std::optional<Vector<2>> centre_of(const Vector<2>& centroid, const BodyVelocity<2>& v) {
  return centroid + Vector<2>(-v.velocity[1], v.velocity[0]) / v.spin[0];
}

std::optional<Vector<3>> centre_of(const Vector<3>&, const BodyVelocity<3>&) {
  return {};
}

}  // namespace

template <int Dim>
Mechanism<Dim> describe_mechanism(const Model<Dim>& model, const std::vector<BodyVelocity<Dim>>& velocities) {
  Mechanism<Dim> mechanism;
  double all = 0, of_rotation = 0;
  for (std::size_t b = 0; b < velocities.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    const BodyVelocity<Dim>& v = velocities[b];
    BlockMotion<Dim> motion{static_cast<int>(b), v.velocity.norm(), v.spin.norm() * body.radius, 0, {}};
    if (motion.speed + motion.turning <= at_rest) continue;
    const Spin<Dim> momentum = angular_momentum<Dim>(body, {}, v.spin);
    const double rotating = momentum.cwiseAbs2().cwiseQuotient(body.inertia).sum(),
                 energy = rotating + body.mass * v.velocity.squaredNorm();
    motion.rotation_fraction = rotating / energy;
    if (motion.turning > at_rest * (motion.speed + motion.turning)) {
      ++mechanism.turning;
      motion.centre = centre_of(Vector<Dim>(model.origin + body.reference), v);
    }
    all += energy;
    of_rotation += rotating;
    mechanism.moving.push_back(motion);
  }
  if (all > 0) mechanism.rotation_fraction = of_rotation / all;
  return mechanism;
}

template Mechanism<2> describe_mechanism(const Model<2>&, const std::vector<BodyVelocity<2>>&);
template Mechanism<3> describe_mechanism(const Model<3>&, const std::vector<BodyVelocity<3>>&);

}  // namespace voussoir
