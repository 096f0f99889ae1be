#include "core/state.hpp"

namespace voussoir {
namespace {

// principal axes of the body in world axes, as columns
template <int Dim>
Matrix<Dim> principal_to_world(const Body<Dim>& body, const Rotation<Dim>& rotation) {
  return matrix(rotation) * body.principal_axes;
}

}  // namespace

template <int Dim>
State<Dim> initial_state(const Model<Dim>& model) {
  State<Dim> state;
  state.motions.resize(model.bodies.size());
  state.loads.resize(model.bodies.size());
  for (const JointProperties& p : model.properties)
    state.schedule.friction.push_back(p.friction);
  return state;
}

template <>
Spin<2> angular_velocity(const Body<2>& body, const Motion<2>& motion) {
  return motion.angular_momentum / body.inertia[0];
}

template <>
Spin<3> angular_velocity(const Body<3>& body, const Motion<3>& motion) {
  return principal_to_world(body, motion.rotation) * motion.angular_momentum.cwiseQuotient(body.inertia);
}

template <>
Spin<2> angular_momentum(const Body<2>& body, const Rotation<2>&, const Spin<2>& velocity) {
  return velocity * body.inertia[0];
}

template <>
Spin<3> angular_momentum(const Body<3>& body, const Rotation<3>& rotation, const Spin<3>& velocity) {
  return (principal_to_world(body, rotation).transpose() * velocity).cwiseProduct(body.inertia);
}

template <int Dim>
Stance<Dim> stance(const Body<Dim>& body, const Motion<Dim>& motion) {
  return {body.reference,
          motion.displacement,
          matrix(motion.rotation),
          motion.velocity,
          angular_velocity(body, motion),
          body.fixed ? 0 : 1 / body.mass};
}

template State<2> initial_state<2>(const Model<2>&);
template State<3> initial_state<3>(const Model<3>&);
template Stance<2> stance<2>(const Body<2>&, const Motion<2>&);
template Stance<3> stance<3>(const Body<3>&, const Motion<3>&);

}  // namespace voussoir
