#include "core/step/loads.hpp"

#include "core/on_threads.hpp"

namespace voussoir {
namespace {

// what a contact that touches does to one of its bodies
template <int Dim>
void push(const Model<Dim>& model, const State<Dim>& state, int place, int body, Load<Dim>& load) {
  const Contact<Dim>& c = state.contacts[place];
  if (!c.touching()) return;
  const int a = model.parts[c.part_a].body, b = model.parts[c.part_b].body;
  const bool on_b = body == b;
  Vector<Dim> centroid = Vector<Dim>::Zero();  // of this body, from that of the first
  if (on_b) centroid = between(state.stances[a], state.stances[b]);
  Spin<Dim> turn = Spin<Dim>::Zero();  // of the force on the second body, about the centroid of this one
  const auto add = [&](const Vector<Dim>& point, const Vector<Dim>& force) {
    turn += moment(Vector<Dim>(point - centroid), force);
  };
  if (c.cells == 0) {
    add(c.geometry.point, c.force);
  } else {
    for (const SubContact<Dim>& s : subs_of(state, static_cast<std::size_t>(place)))
      if (s.area > 0) add(s.point, s.force);
  }
  const double sign = on_b ? 1 : -1;
  load.force += sign * c.force;
  load.moment += sign * turn;
}

}  // namespace

template <int Dim>
void sum_loads(const Model<Dim>& model, const Settings& settings, State<Dim>& state) {
  each_on_threads(settings.threads, state.loads.size(), [&](int b) {
    Load<Dim> load = boundary_load(model.bodies[b], state.stances[b].axes);
    load.force += weight(model, state, static_cast<std::size_t>(b));
    for (const int place : contacts_of(state, b))
      push(model, state, place, b, load);
    state.loads[b] = load;
  });
}

template void sum_loads<2>(const Model<2>&, const Settings&, State<2>&);
template void sum_loads<3>(const Model<3>&, const Settings&, State<3>&);

}  // namespace voussoir
