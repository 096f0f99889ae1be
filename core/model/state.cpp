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
void add_bodies(const Model<Dim>& model, BodiesState<Dim>& bodies, ContactsState<Dim>& contacts, LoadsState<Dim>& loads,
                TimeStep& time_step) {
  if (model.bodies.size() == bodies.motions.size()) return;
  bodies.motions.resize(model.bodies.size());
  loads.total.resize(model.bodies.size());
  forget_lists(bodies, contacts, time_step);
}

template <int Dim>
void forget_lists(BodiesState<Dim>& bodies, ContactsState<Dim>& contacts, TimeStep& time_step) {
  bodies.listed_at.clear();
  bodies.counted_at.clear();
  bodies.path_bounds.clear();
  bodies.left_behind.clear();
  bodies.poses.clear();
  contacts.by_body = {};
  contacts.loads.clear();
  time_step.frequency.clear();
  for (Contact<Dim>& c : contacts.list)
    c.near_until = c.free_until = 0;  // paths are counted from 0 again
}

template <int Dim>
Vector<Dim> weight(const Model<Dim>& model, const Schedule& schedule, std::size_t body) {
  return model.bodies[body].mass * schedule.gravity_factor * model.gravity;
}

template void add_bodies<2>(const Model<2>&, BodiesState<2>&, ContactsState<2>&, LoadsState<2>&, TimeStep&);
template void add_bodies<3>(const Model<3>&, BodiesState<3>&, ContactsState<3>&, LoadsState<3>&, TimeStep&);
template void forget_lists<2>(BodiesState<2>&, ContactsState<2>&, TimeStep&);
template void forget_lists<3>(BodiesState<3>&, ContactsState<3>&, TimeStep&);
template State<2> initial_state<2>(const Model<2>&);
template State<3> initial_state<3>(const Model<3>&);
template Vector<2> weight<2>(const Model<2>&, const Schedule&, std::size_t);
template Vector<3> weight<3>(const Model<3>&, const Schedule&, std::size_t);

}  // namespace voussoir
