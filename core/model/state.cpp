#include "core/model/state.hpp"

namespace voussoir {

template <int Dim>
State<Dim> initial_state(const Model<Dim>& model) {
  State<Dim> state;
  state.bodies.motions.resize(model.bodies.size());
  state.loads.total.resize(model.bodies.size());
  for (const JointProperties& p : model.properties)
    state.schedule.friction.push_back(p.friction);
  for (const Water& water : model.waters)
    state.schedule.water.push_back(water.values);
  state.schedule.last_water = state.schedule.water;
  return state;
}

template <int Dim>
void add_bodies(const Model<Dim>& model, State<Dim>& state) {
  if (model.bodies.size() == state.bodies.motions.size()) return;
  state.bodies.motions.resize(model.bodies.size());
  state.loads.total.resize(model.bodies.size());
  forget_lists(state);
}

template <int Dim>
void forget_lists(State<Dim>& state) {
  state.bodies.listed_at.clear();
  state.bodies.counted_at.clear();
  state.bodies.path_bounds.clear();
  state.bodies.left_behind.clear();
  state.bodies.poses.clear();
  state.contacts.by_body = {};
  state.contacts.loads.clear();
  state.time_step.frequency.clear();
  for (Contact<Dim>& c : state.contacts.list)
    c.near_until = c.free_until = 0;  // paths are counted from 0 again
}

template <int Dim>
Vector<Dim> weight(const Model<Dim>& model, const Schedule& schedule, std::size_t body) {
  return model.bodies[body].mass * schedule.gravity_factor * model.gravity;
}

template void add_bodies<2>(const Model<2>&, State<2>&);
template void add_bodies<3>(const Model<3>&, State<3>&);
template void forget_lists<2>(State<2>&);
template void forget_lists<3>(State<3>&);
template State<2> initial_state<2>(const Model<2>&);
template State<3> initial_state<3>(const Model<3>&);
template Vector<2> weight<2>(const Model<2>&, const Schedule&, std::size_t);
template Vector<3> weight<3>(const Model<3>&, const Schedule&, std::size_t);

}  // namespace voussoir
