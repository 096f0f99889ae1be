#include "core/run/excavate.hpp"

#include <algorithm>
#include <tuple>

#include "core/stage/excavation.hpp"
#include "core/stage/support_table.hpp"
#include "core/step.hpp"

namespace voussoir {
namespace {

// the motions of bodies that lost parts, at their new centroids
template <int Dim>
void carry_motions(const Model<Dim>& before, const Model<Dim>& model, const Excavated<Dim>& moved,
                   std::vector<Motion<Dim>>& motions) {
  const std::vector<Motion<Dim>> then = motions;
  motions.resize(model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const int origin = moved.origin[b];
    const Body<Dim>&was = before.bodies[origin], &is = model.bodies[b];
    if (is.parts.size() == was.parts.size()) continue;
    Motion<Dim> m = then[origin];
    const Vector<Dim> arm = matrix(m.rotation) * moved.shift[b];
    const Spin<Dim> spin = angular_velocity(was, m);
    m.velocity += cross(spin, arm);
    m.displacement += arm - moved.shift[b];
    m.angular_momentum = angular_momentum(is, m.rotation, spin);
    motions[b] = m;
  }
}

// the remaining contacts, by their new keys
template <int Dim>
void carry_contacts(const Model<Dim>& before, const Model<Dim>& model, const Excavated<Dim>& moved,
                    const std::vector<Motion<Dim>>& then, const std::vector<Motion<Dim>>& now,
                    ContactsState<Dim>& contacts, BondTally& bonds) {
  const std::size_t stride = sub_stride(contacts);
  std::vector<std::tuple<int, int, std::size_t>> order;
  for (std::size_t i = 0; i < contacts.list.size(); ++i) {
    const auto [a, b] = std::minmax(moved.part[contacts.list[i].part_a], moved.part[contacts.list[i].part_b]);
    if (a >= 0)
      order.emplace_back(a, b, i);
    else
      bonds.removed += bonds_of(contacts, i).held();
  }
  std::ranges::sort(order);

  std::vector<Contact<Dim>> list;
  std::vector<SubContact<Dim>> subs(order.size() * stride);
  std::vector<JointRise<Dim>> rises;
  for (const auto& [a, b, from] : order) {
    Contact<Dim> c = contacts.list[from];
    const std::span<SubContact<Dim>> cells = std::span(subs).subspan(list.size() * stride, stride);
    std::ranges::copy(std::span(contacts.subs).subspan(from * stride, stride), cells.begin());
    const int was = before.parts[c.part_a].body, is = model.parts[a].body;
    const bool turned = moved.part[c.part_a] != a;
    c.part_a = moved.part[c.part_a];
    c.part_b = moved.part[c.part_b];
    std::ranges::copy(rises_of(contacts, from), std::back_inserter(rises));
    if (turned) turn_round(model, c, cells, std::span(rises).last(rises_of(contacts, from).size()));
    // points are relative to the first body's centroid
    const Vector<Dim> shift =
        (model.bodies[is].reference - before.bodies[was].reference) + (now[is].displacement - then[was].displacement);
    c.geometry.point -= shift;
    c.history.point -= shift;
    for (SubContact<Dim>& s : cells) {
      s.point -= shift;
      s.history.point -= shift;
    }
    if (turned || !shift.isZero(0)) c.proof = {};  // it is in that body's frame
    c.area_rated = -1;
    list.push_back(c);
  }
  contacts.list = std::move(list);
  contacts.subs = std::move(subs);
  contacts.rises = std::move(rises);
}

template <int Dim>
std::vector<Load<Dim>> loads_now(const Model<Dim>& model, const Settings& settings, State<Dim> state) {
  find_forces(model, settings, state);
  return state.loads.total;
}

}  // namespace

template <int Dim>
Excavated<Dim> excavate(const std::vector<std::string>& names, const Settings& settings, bool hold, Model<Dim>& model,
                        State<Dim>& state) {
  const Model<Dim> before = model;
  std::vector<Load<Dim>> then;
  if (hold) then = loads_now(model, settings, state);
  const Excavated<Dim> moved = excavate(model, names);
  const std::vector<Motion<Dim>> motions = state.bodies.motions;
  carry_motions(before, model, moved, state.bodies.motions);
  state.loads.total.resize(model.bodies.size());
  carry_contacts(before, model, moved, motions, state.bodies.motions, state.contacts, state.ledger.bonds);
  for (const StageSupport<Dim>& row : stage_supports<Dim>)
    if (row.carry) row.carry(before, model, moved, state);
  forget_lists(state.bodies, state.contacts, state.time_step);
  if (!hold) return moved;

  const std::vector<Load<Dim>> now = loads_now(model, settings, state);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    if (!body.present || body.immobile()) continue;
    const int origin = moved.origin[b];
    const Load<Dim>& whole = then[origin];
    const double share = body.mass / before.bodies[origin].mass;
    const Vector<Dim> arm = matrix(motions[origin].rotation) * moved.shift[b];
    ReliefLoad<Dim> held{.body = static_cast<int>(b), .load = {}};
    held.load.force = share * whole.force - now[b].force;
    held.load.moment = share * (whole.moment - moment(arm, whole.force)) - now[b].moment;
    if (!held.load.force.isZero(0) || !held.load.moment.isZero(0)) state.loads.relief.push_back(held);
  }
  return moved;
}

template Excavated<2> excavate<2>(const std::vector<std::string>&, const Settings&, bool, Model<2>&, State<2>&);
template Excavated<3> excavate<3>(const std::vector<std::string>&, const Settings&, bool, Model<3>&, State<3>&);

}  // namespace voussoir
