#include "core/step/static_solver_base.hpp"
#include "core/step/support_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace voussoir {

template <int Dim>
Unknowns<Dim>::Unknowns(const Model<Dim>& model) : place(model.bodies.size(), -1) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed && model.bodies[b].present) {
      place[b] = static_cast<int>(bodies.size());
      bodies.push_back(static_cast<int>(b));
    }
  double stiffest = 0;
  for (const JointProperties& p : model.properties)
    stiffest = std::max(stiffest, p.normal_stiffness);
  scale.resize(F * bodies.size());
  free.resize(F * bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body<Dim>& body = model.bodies[bodies[i]];
    double face = 0;
    for (const Polytope<Dim>& part : body.parts)
      face = std::max(face, part.largest_face);
    for (int f = 0; f < F; ++f) {
      // a body that turns about its middle: a third of the square of its radius
      scale[F * i + f] = stiffest * face * (f < Dim ? 1 : body.radius * body.radius / 3);
      free[F * i + f] = f < Dim ? body.free_translation[f] : body.free_rotation[f - Dim];
    }
  }
  for (const StepSupport<Dim>& row : step_supports<Dim>)
    if (row.scale_unknowns) row.scale_unknowns(model, place, scale);
}

template <int Dim>
void take_base(const Model<Dim>& model, const Settings& settings, const Unknowns<Dim>& unknowns, State<Dim>& state) {
  for (Motion<Dim>& m : state.bodies.motions) {
    m.velocity.setZero();
    m.angular_momentum.setZero();
  }
  StaticIncrement<Dim>& n = state.increment;
  n.base = state.bodies.motions;
  n.supports = state.supports;
  n.ledger = state.ledger;
  n.whole_bonds = whole_bonds(state.contacts);
  n.histories.clear();
  for (const Contact<Dim>& c : state.contacts.list)
    n.histories.push_back({c.part_a, c.part_b, c.divided_face, c.bond_due, c.history});
  n.sub_histories.clear();
  for (const SubContact<Dim>& s : state.contacts.subs)
    n.sub_histories.push_back(s.history);
  n.listed = state.counters.neighbour_builds;
  n.accepted.assign(static_cast<std::size_t>(unknowns.free.size()), 0);
  n.since_commit = 0;
  cache_poses(model, settings.threads, state.bodies);  // they stand still
}

template <int Dim>
void follow_list(State<Dim>& state) {
  StaticIncrement<Dim>& n = state.increment;
  if (n.listed == state.counters.neighbour_builds) return;
  n.listed = state.counters.neighbour_builds;
  const std::vector<BaseHistory<Dim>> old = std::move(n.histories);
  const std::vector<JointState<Dim>> old_subs = std::move(n.sub_histories);
  const std::size_t cells = old.empty() ? 0 : old_subs.size() / old.size(), stride = sub_stride(state.contacts);
  n.histories.assign(state.contacts.list.size(), {});
  n.sub_histories.assign(state.contacts.subs.size(), {});
  std::map<int, int> moved;  // places of contacts, old to new
  std::size_t from = 0;
  for (std::size_t i = 0; i < state.contacts.list.size(); ++i) {  // both lists ascend
    const std::pair key(state.contacts.list[i].part_a, state.contacts.list[i].part_b);
    n.histories[i].part_a = key.first;
    n.histories[i].part_b = key.second;
    while (from < old.size() && std::pair(old[from].part_a, old[from].part_b) < key)
      ++from;
    if (from == old.size() || std::pair(old[from].part_a, old[from].part_b) != key) continue;
    n.histories[i] = old[from];
    for (std::size_t k = 0; k < std::min(cells, stride); ++k)
      n.sub_histories[i * stride + k] = old_subs[from * cells + k];
    moved[static_cast<int>(from)] = static_cast<int>(i);
  }
  std::vector<PairStiffness<Dim>> closed;
  for (PairStiffness<Dim>& c : n.closed)
    if (const auto to = moved.find(c.contact); to != moved.end()) {
      c.contact = to->second;
      closed.push_back(c);
    }
  n.closed = std::move(closed);
}

template <int Dim>
void set_trial(const Model<Dim>& model, const Unknowns<Dim>& unknowns, const Eigen::VectorXd& q, State<Dim>& state) {
  constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;
  const StaticIncrement<Dim>& n = state.increment;
  for (std::size_t i = 0; i < unknowns.count(); ++i) {
    const int b = unknowns.bodies[i];
    Motion<Dim>& m = state.bodies.motions[b];
    const Vector<Dim> way = q.segment<Dim>(F * i);
    const Spin<Dim> turn = q.segment<S>(F * i + Dim);
    m.displacement = n.base[b].displacement + way;
    m.rotation = turned(n.base[b].rotation, turn);
    m.velocity = way;  // per time step of one
    m.angular_momentum = angular_momentum(model.bodies[b], m.rotation, turn);
  }
  for (std::size_t i = 0; i < n.histories.size(); ++i) {
    state.contacts.list[i].history = n.histories[i].history;
    state.contacts.list[i].divided_face = n.histories[i].divided_face;
    state.contacts.list[i].bond_due = n.histories[i].bond_due;
  }
  for (std::size_t i = 0; i < n.sub_histories.size(); ++i)
    state.contacts.subs[i].history = n.sub_histories[i];
  state.supports = n.supports;
  state.ledger = n.ledger;
  state.time_step.length = 1;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                      \
  template struct Unknowns<Dim>;                                                                       \
  template void take_base<Dim>(const Model<Dim>&, const Settings&, const Unknowns<Dim>&, State<Dim>&); \
  template void follow_list<Dim>(State<Dim>&);                                                         \
  template void set_trial<Dim>(const Model<Dim>&, const Unknowns<Dim>&, const Eigen::VectorXd&, State<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
