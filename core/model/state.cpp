#include "core/model/state.hpp"

#include <cmath>

#include "core/base/on_threads.hpp"

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
  for (const Water& water : model.waters)
    state.schedule.water.push_back(water.values);
  state.schedule.last_water = state.schedule.water;
  return state;
}

template <int Dim>
void add_bodies(const Model<Dim>& model, State<Dim>& state) {
  if (model.bodies.size() == state.motions.size()) return;
  state.motions.resize(model.bodies.size());
  state.loads.resize(model.bodies.size());
  forget_lists(state);
}

template <int Dim>
void forget_lists(State<Dim>& state) {
  state.built.clear();
  state.counted_at.clear();
  state.path_bounds.clear();
  state.left_behind.clear();
  state.poses.clear();
  state.by_body = {};
  state.contact_loads.clear();
  state.frequency.clear();
  for (Contact<Dim>& c : state.contacts)
    c.near_until = c.free_until = 0;  // paths are counted from 0 again
}

BeamNode moved_node(const State<2>& state, int body) {
  return {state.motions[body].displacement, state.motions[body].rotation.angle};
}

std::vector<BeamForces> forces_of_beams(const Lining& lining, const State<2>& state) {
  std::vector<BeamForces> all;
  for (int k = 0; k < lining.beams(); ++k) {
    const Beam beam = lining.beam(k);
    all.push_back(beam_forces(beam, beam_strain(beam, moved_node(state, lining.first_body + k),
                                                moved_node(state, lining.first_body + lining.next(k)))));
  }
  return all;
}

template <int Dim>
void set_strength(const Model<Dim>& model, Searched searched, const std::vector<int>& properties, double level,
                  Schedule& schedule) {
  if (searched == Searched::factor) schedule.strength_factor.resize(model.properties.size(), 1);
  for (const int p : properties) {
    schedule.friction[p] = level;
    if (searched == Searched::friction) continue;
    const double stated = model.properties[p].friction;
    schedule.friction[p] = level == 1 ? stated : std::atan(std::tan(stated) / level);
    schedule.strength_factor[p] = level;
  }
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
void cache_poses(const Model<Dim>& model, int threads, State<Dim>& state) {
  state.poses.resize(model.bodies.size());
  each_on_threads(threads, state.poses.size(), [&](int b) {
    const Body<Dim>& body = model.bodies[b];
    const Motion<Dim>& motion = state.motions[b];
    state.poses[b] = {body.reference,
                      motion.displacement,
                      matrix(motion.rotation),
                      motion.velocity,
                      angular_velocity(body, motion),
                      body.fixed ? 0 : 1 / body.mass};
  });
}

template <int Dim>
void list_by_body(const Model<Dim>& model, State<Dim>& state) {
  std::vector<int>&first = state.by_body.first, &places = state.by_body.places;
  first.assign(model.bodies.size() + 1, 0);
  places.resize(2 * state.contacts.size());
  const auto each = [&](const auto& visit) {
    for (std::size_t i = state.contacts.size(); i-- > 0;)
      for (const int part : {state.contacts[i].part_a, state.contacts[i].part_b})
        visit(model.parts[part].body, static_cast<int>(i));
  };
  // the end of each body's, lowered to its begin as they go in from the last to the first
  each([&](int body, int) { ++first[body]; });
  for (std::size_t b = 0; b + 1 < first.size(); ++b)
    first[b + 1] += first[b];
  each([&](int body, int place) { places[--first[body]] = place; });
}

template <int Dim>
Vector<Dim> between(const CachedPose<Dim>& a, const CachedPose<Dim>& b) {
  return (b.reference - a.reference) + (b.displacement - a.displacement);
}

template <int Dim>
Standing<Dim> standing(const CachedPose<Dim>& pose) {
  return {pose.reference + pose.displacement, pose.axes};
}

template <int Dim>
Vector<Dim> weight(const Model<Dim>& model, const State<Dim>& state, std::size_t body) {
  return model.bodies[body].mass * state.schedule.gravity_factor * model.gravity;
}

template void add_bodies<2>(const Model<2>&, State<2>&);
template void add_bodies<3>(const Model<3>&, State<3>&);
template void forget_lists<2>(State<2>&);
template void forget_lists<3>(State<3>&);
template State<2> initial_state<2>(const Model<2>&);
template State<3> initial_state<3>(const Model<3>&);
template void set_strength<2>(const Model<2>&, Searched, const std::vector<int>&, double, Schedule&);
template void set_strength<3>(const Model<3>&, Searched, const std::vector<int>&, double, Schedule&);
template void cache_poses<2>(const Model<2>&, int, State<2>&);
template void cache_poses<3>(const Model<3>&, int, State<3>&);
template void list_by_body<2>(const Model<2>&, State<2>&);
template void list_by_body<3>(const Model<3>&, State<3>&);
template Vector<2> between<2>(const CachedPose<2>&, const CachedPose<2>&);
template Vector<3> between<3>(const CachedPose<3>&, const CachedPose<3>&);
template Standing<2> standing<2>(const CachedPose<2>&);
template Standing<3> standing<3>(const CachedPose<3>&);
template Vector<2> weight<2>(const Model<2>&, const State<2>&, std::size_t);
template Vector<3> weight<3>(const Model<3>&, const State<3>&, std::size_t);

}  // namespace voussoir
