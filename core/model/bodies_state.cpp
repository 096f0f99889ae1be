#include "core/model/bodies_state.hpp"

#include "core/base/on_threads.hpp"

namespace voussoir {
namespace {

// principal axes of the body in world axes, as columns
template <int Dim>
Matrix<Dim> principal_to_world(const Body<Dim>& body, const Rotation<Dim>& rotation) {
  return matrix(rotation) * body.principal_axes;
}

}  // namespace

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
void note_placements(const BodiesState<Dim>& bodies, std::vector<Placement<Dim>>& placements) {
  placements.clear();
  for (const Motion<Dim>& m : bodies.motions)
    placements.push_back({m.displacement, m.rotation});
}

template <int Dim>
std::vector<Vector<Dim>> displacements(const BodiesState<Dim>& bodies) {
  std::vector<Vector<Dim>> moved;
  for (const Motion<Dim>& m : bodies.motions)
    moved.push_back(m.displacement);
  return moved;
}

template <int Dim>
void cache_poses(const Model<Dim>& model, int threads, BodiesState<Dim>& bodies) {
  bodies.poses.resize(model.bodies.size());
  each_on_threads(threads, bodies.poses.size(), [&](int b) {
    const Body<Dim>& body = model.bodies[b];
    const Motion<Dim>& motion = bodies.motions[b];
    bodies.poses[b] = {body.reference,
                       motion.displacement,
                       matrix(motion.rotation),
                       motion.velocity,
                       angular_velocity(body, motion),
                       body.fixed && !body.image ? 0 : 1 / body.mass};
  });
}

template <int Dim>
void stop(std::vector<Motion<Dim>>& motions) {
  for (Motion<Dim>& m : motions) {
    m.velocity.setZero();
    m.angular_momentum.setZero();
  }
}

template <int Dim>
Vector<Dim> between(const CachedPose<Dim>& a, const CachedPose<Dim>& b) {
  return (b.reference - a.reference) + (b.displacement - a.displacement);
}

template <int Dim>
Standing<Dim> standing(const CachedPose<Dim>& pose) {
  return {pose.reference + pose.displacement, pose.axes};
}

template void cache_poses<2>(const Model<2>&, int, BodiesState<2>&);
template void cache_poses<3>(const Model<3>&, int, BodiesState<3>&);
template void stop<2>(std::vector<Motion<2>>&);
template void stop<3>(std::vector<Motion<3>>&);
template Vector<2> between<2>(const CachedPose<2>&, const CachedPose<2>&);
template Vector<3> between<3>(const CachedPose<3>&, const CachedPose<3>&);
template Standing<2> standing<2>(const CachedPose<2>&);
template Standing<3> standing<3>(const CachedPose<3>&);
template void note_placements<2>(const BodiesState<2>&, std::vector<Placement<2>>&);
template void note_placements<3>(const BodiesState<3>&, std::vector<Placement<3>>&);
template std::vector<Vector<2>> displacements<2>(const BodiesState<2>&);
template std::vector<Vector<3>> displacements<3>(const BodiesState<3>&);

}  // namespace voussoir
