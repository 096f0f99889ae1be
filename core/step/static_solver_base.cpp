#include "core/step/static_solver_base.hpp"
#include "core/step/support_table.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace voussoir {

template <int Dim>
Unknowns<Dim>::Unknowns(const Model<Dim>& model) : place(model.bodies.size(), -1) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed && model.bodies[b].present) {
      place[b] = static_cast<int>(bodies.size());
      bodies.push_back(static_cast<int>(b));
    }
  upwards.resize(bodies.size());
  std::iota(upwards.begin(), upwards.end(), 0);
  std::ranges::stable_sort(upwards, std::ranges::greater{},
                           [&](int i) { return model.gravity.dot(model.bodies[bodies[i]].reference); });
  for (const Body<Dim>& body : model.bodies)
    radius.push_back(inscribed_radius(body));
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
      // a body that rotates about its centre: a third of the square of its radius
      scale[F * i + f] = stiffest * face * (f < Dim ? 1 : body.radius * body.radius / 3);
      free[F * i + f] = f < Dim ? body.free_translation[f] : body.free_rotation[f - Dim];
    }
  }
  for (const StepSupport<Dim>& row : step_supports<Dim>)
    if (row.scale_unknowns) row.scale_unknowns(model, place, scale);
}

template <int Dim>
StaticBase<Dim> base_of(const State<Dim>& state) {
  return {.motions = state.bodies.motions,
          .histories = histories_of(state.contacts),
          .supports = state.supports,
          .ledger = state.ledger,
          .loads = state.loads.by_source,
          .held_bonds = bonds_of(state.contacts).held(),
          .listed = state.counters.neighbour_builds};
}

template <int Dim>
void follow_list(const ContactsState<Dim>& contacts, long long listed, StaticBase<Dim>& base,
                 std::vector<PairStiffness<Dim>>& closed) {
  if (base.listed == listed) return;
  base.listed = listed;
  const std::vector<int> places = follow_list(contacts, base.histories);
  for (PairStiffness<Dim>& pair : closed)
    pair.contact = places[pair.contact];
  std::erase_if(closed, [](const PairStiffness<Dim>& pair) { return pair.contact < 0; });
}

template <int Dim>
void set_trial(const Model<Dim>& model, const Unknowns<Dim>& unknowns, const StaticBase<Dim>& base,
               const Eigen::VectorXd& q, BodiesState<Dim>& bodies, ContactsState<Dim>& contacts,
               SupportsState<Dim>& supports, Ledger& ledger, TimeStep& time_step) {
  constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;
  for (std::size_t i = 0; i < unknowns.count(); ++i) {
    const int b = unknowns.bodies[i];
    Motion<Dim>& m = bodies.motions[b];
    const Vector<Dim> way = q.segment<Dim>(F * i);
    const Spin<Dim> turn = q.segment<S>(F * i + Dim);
    m.displacement = base.motions[b].displacement + way;
    m.rotation = turned(base.motions[b].rotation, turn);
    m.velocity = way;  // per time step of one
    m.angular_momentum = angular_momentum(model.bodies[b], m.rotation, turn);
  }
  set_histories(base.histories, contacts);
  supports = base.supports;
  ledger = base.ledger;
  time_step.length = 1;
}

template <int Dim>
void add_work_of_increment(const Unknowns<Dim>& unknowns, const LoadsBySource<Dim>& loads_then,
                           const Eigen::VectorXd& q, const LoadsBySource<Dim>& loads_now, EnergyBalance& energy) {
  constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;
  for (std::size_t i = 0; i < load_count; ++i) {
    const std::vector<Load<Dim>>&then = loads_then.values[i], &now = loads_now.values[i];
    double work = 0;
    for (std::size_t k = 0; k < unknowns.count(); ++k) {
      const auto along = [&](const Load<Dim>& l) {
        return l.force.dot(q.segment<Dim>(F * k)) + l.moment.dot(q.segment<S>(F * k + Dim));
      };
      const auto b = static_cast<std::size_t>(unknowns.bodies[k]);
      work += 0.5 * ((b < then.size() ? along(then[b]) : 0) + (b < now.size() ? along(now[b]) : 0));
    }
    energy.flows.values[i] += source_table[i].motion * work;
    energy.flows[Source::relaxation] += work;
  }
  energy.kinetic = 0;
  balance(energy);
}

template <int Dim>
double fraction_in_new_contacts(const ContactsState<Dim>& contacts, const JointHistories<Dim>& of_base) {
  double all = 0, of_new = 0;
  for (std::size_t i = 0; i < contacts.list.size(); ++i) {
    if (!contacts.list[i].touching()) continue;
    const double force = contacts.list[i].force.norm();
    all += force;
    if (of_base.contacts[i].history.normal.isZero(0)) of_new += force;
  }
  return all > 0 ? of_new / all : 0;
}

template <int Dim>
std::vector<Placement<Dim>> accepted_placements(const Model<Dim>& model, const StaticIncrement<Dim>& increment) {
  std::vector<Placement<Dim>> placed;
  const double* q = increment.progress.accepted.data();  // of the free bodies, in order
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    placed.push_back({increment.base.motions[b].displacement, increment.base.motions[b].rotation});
    if (model.bodies[b].fixed || !model.bodies[b].present) continue;
    placed.back().displacement += Eigen::Map<const Vector<Dim>>(q);
    placed.back().rotation = turned(placed.back().rotation, Spin<Dim>(Eigen::Map<const Spin<Dim>>(q + Dim)));
    q += freedoms<Dim>;
  }
  return placed;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                   \
  template struct Unknowns<Dim>;                                                                                    \
  template StaticBase<Dim> base_of<Dim>(const State<Dim>&);                                                         \
  template void follow_list<Dim>(const ContactsState<Dim>&, long long, StaticBase<Dim>&,                            \
                                 std::vector<PairStiffness<Dim>>&);                                                 \
  template void add_work_of_increment<Dim>(const Unknowns<Dim>&, const LoadsBySource<Dim>&, const Eigen::VectorXd&, \
                                           const LoadsBySource<Dim>&, EnergyBalance&);                              \
  template double fraction_in_new_contacts<Dim>(const ContactsState<Dim>&, const JointHistories<Dim>&);             \
  template std::vector<Placement<Dim>> accepted_placements<Dim>(const Model<Dim>&, const StaticIncrement<Dim>&);    \
  template void set_trial<Dim>(const Model<Dim>&, const Unknowns<Dim>&, const StaticBase<Dim>&,                     \
                               const Eigen::VectorXd&, BodiesState<Dim>&, ContactsState<Dim>&, SupportsState<Dim>&, \
                               Ledger&, TimeStep&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
