#include "core/step/joint_forces.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/on_threads.hpp"
#include "core/contact/integrable.hpp"
#include "core/joint_laws/joint_law.hpp"
#include "core/step/contacts.hpp"
#include "core/step/face_forces.hpp"
#include "core/step/flight.hpp"
#include "core/step/neighbours.hpp"

namespace voussoir {
namespace {

double spin_about(const Vector<3>& normal, const Spin<3>& a, const Spin<3>& b) {
  return 0.5 * normal.dot(a + b);
}
double spin_about(const Vector<2>&, const Spin<2>&, const Spin<2>&) {
  return 0;
}

template <int Dim>
PairMotion<Dim> motion_of(const Model<Dim>& model, const BodiesState<Dim>& bodies, const Contact<Dim>& c) {
  const CachedPose<Dim>&a = bodies.poses[model.parts[c.part_a].body], &b = bodies.poses[model.parts[c.part_b].body];
  return {between(a, b), b.velocity - a.velocity, a.spin, b.spin, a.inverse_mass + b.inverse_mass};
}

// loading of a joint at a point
template <int Dim>
struct Bearing {
  Vector<Dim> point, normal;
  double overlap, area;         // m, m²; the area is 1, or a fraction of it, for a constant stiffness
  double overlap_variance = 0;  // m², variance of the overlap
  double fraction = 1;          // of the contact's area
  double stiffness_factor = 1;  // of a constant stiffness
};

// contribution of some contacts to the energy balance, J
struct JointSums {
  double elastic = 0, friction = 0, lost_area = 0, dashpots = 0, stiffening = 0, dilation = 0, crushing = 0;
  long long snap_backs = 0, bonds_made = 0;
};

// current friction of some joint properties
struct Friction {
  double angle;            // rad
  double coefficient;      // its tangent
  double strength_factor;  // divides cohesion; the tangent is already divided
};

Friction friction_of(const Schedule& schedule, std::size_t properties) {
  const double angle = schedule.friction[properties];
  return {angle, std::tan(angle), schedule.strength_factor.empty() ? 1 : schedule.strength_factor[properties]};
}

// of all joint properties; until the next call on this thread
const std::vector<Friction>& frictions_of(const Schedule& schedule) {
  static thread_local std::vector<Friction> frictions;
  frictions.clear();
  for (std::size_t i = 0; i < schedule.friction.size(); ++i)
    frictions.push_back(friction_of(schedule, i));
  return frictions;
}

// the force of a plain joint, inlined as below; `damping` over the root of the normal stiffness
template <int Dim>
[[gnu::always_inline]] inline JointForce<Dim> plain_answer(const JointProperties& properties, double friction,
                                                           double damping, const JointKinematics<Dim>& k,
                                                           JointState<Dim>& history) {
  const double dashpot = damping > 0 ? damping * std::sqrt(properties.normal_stiffness) : 0;
  const JointForce<Dim> answer = elastic_coulomb<Dim>(properties, friction, dashpot, k, history.shear_force);
  history.plastic_slip += answer.plastic_slip;
  return answer;
}

// the force of a joint with laws of its own; never inlined, as the loop of plain joints would have its registers
template <int Dim>
[[gnu::noinline]] JointForce<Dim> answer_of_laws(const JointProperties& properties, double friction, double damping,
                                                 const JointKinematics<Dim>& k, double strength_factor, JointSums& sums,
                                                 JointState<Dim>& history, const PlaceOfJoint<Dim>& place) {
  const double largest = place.rise ? place.rise->largest_closure : 0;
  const double stiffness =
      damping > 0 ? normal_answer(properties, k.overlap, history.bond == Bond::whole, largest).stiffness : 0;
  if (place.rise) {
    JointRise<Dim>& rise = *place.rise;
    if (!rise.normal.isZero(0)) rise.offset = carried(rise.offset, rise.normal, k.normal, k.turn);
    rise.normal = k.normal;
  }
  const double pushed = history.dashpot;
  const LawForce<Dim> answer =
      joint_law<Dim>(properties, friction, damping * std::sqrt(stiffness), k, history, strength_factor, place);
  sums.stiffening += answer.stiffening;
  sums.dilation += answer.dilation - 0.5 * (pushed + answer.dashpot) * answer.grown;
  sums.dashpots += 0.5 * (pushed + answer.dashpot) * answer.grown;
  sums.crushing += answer.crushing;
  if (answer.snap_back) ++sums.snap_backs;
  return answer;
}

// A contact's normal dashpot, 2ξ √(m kn A) (Eq. 6.9), over the root of its normal stiffness per area, N s/m; `fraction`
// of the contact's mass belongs to this area. Between two immobile bodies there is nothing to damp.
template <int Dim>
[[gnu::always_inline]] inline double dashpot_of(const JointStep& step, const PairMotion<Dim>& motion, double area,
                                                double fraction = 1) {
  return step.viscous_ratio > 0 && motion.inverse_mass > 0
             ? 2 * step.viscous_ratio * std::sqrt(area / motion.inverse_mass * fraction)
             : 0;
}

// Force on the second body; the history continues. Inlined by force: the call and its arguments would cost a plain
// joint some percent of its law (benchmarks/price_of_laws.sh).
template <int Dim>
[[gnu::always_inline]] inline Vector<Dim> joint_force(const JointProperties& properties, const JointStep& step,
                                                      const PairMotion<Dim>& motion, const Bearing<Dim>& at,
                                                      const Friction& friction, JointState<Dim>& history,
                                                      JointRise<Dim>* rise, JointSums& sums) {
  // the slip is that of the last step
  const double dt = step.length;
  const Vector<Dim>& n = at.normal;
  const Vector<Dim> velocity = motion.velocity_at(at.point);

  JointKinematics<Dim> k;
  k.normal = n;
  k.overlap = at.overlap;
  k.overlap_variance = at.overlap_variance;
  k.area = at.area;
  k.stiffness_factor = at.stiffness_factor;
  k.closing_speed = -velocity.dot(n);

  // a new contact has no shear yet, and slips for the time that it has been closed; an existing one rotates its shear
  // to the new plane
  const bool standing = !history.normal.isZero(0);
  double closing_before = 0;
  if (standing) {
    // the mean of the contact's old and new position: the work of its shear force then equals the energy that the
    // bodies lose
    const Vector<Dim> before = motion.velocity_before_at(history.point, dt);
    closing_before = -before.dot(history.normal);
    const Vector<Dim> twice = velocity + before + closing_before * history.normal;
    k.slip = 0.5 * dt * (twice - twice.dot(n) * n);
    k.turn = spin_about(n, motion.spin_a, motion.spin_b) * dt;
    // lost area takes its stress with it: the remaining area could not support the force of an area a thousand times as
    // large
    if (k.area < history.area) {
      const double left = k.area / history.area;
      const double stiffness =
          history.area * (history.shear_stiffness > 0 ? history.shear_stiffness : properties.shear_stiffness);
      if (stiffness > 0) sums.lost_area += 0.5 * history.shear_force.squaredNorm() / stiffness * (1 - left);
      history.shear_force *= left;
    }
    history.shear_force = carried(history.shear_force, history.normal, n, k.turn);
  } else {
    const double closed = k.closing_speed * dt, since = closed > k.overlap ? std::max(k.overlap, 0.0) / closed : 1;
    k.slip = since * dt * (velocity + k.closing_speed * n);
  }

  const double damping = dashpot_of(step, motion, k.area * k.stiffness_factor, at.fraction);
  const JointForce<Dim> answer =
      properties.laws.is_plain()
          ? plain_answer<Dim>(properties, friction.coefficient, damping, k, history)
          : answer_of_laws<Dim>(properties, friction.angle, damping, k, friction.strength_factor, sums, history,
                                {properties.remembers_place() ? rise : nullptr, dt});
  sums.elastic += answer.elastic;
  sums.friction += answer.friction;
  sums.dashpots += 0.5 * (history.dashpot * closing_before + answer.dashpot * k.closing_speed) * dt;
  history.normal = n;
  history.point = at.point;
  history.dashpot = answer.dashpot;
  history.area = k.area;
  return answer.force;
}

// The joint of an integrated face contact. Not inlined, so that scenes without it have a short loop.
template <int Dim>
[[gnu::noinline]] FaceForce<Dim> whole_face_force(const JointProperties& properties, const JointStep& step,
                                                  const PairMotion<Dim>& motion, const ContactGeometry<Dim>& geometry,
                                                  const IntegratedContact<Dim>& face, double friction,
                                                  JointState<Dim>& history, Vector<3>* slip_normal = nullptr) {
  const double dashpot = dashpot_of(step, motion, geometry.area) * std::sqrt(properties.normal_stiffness);
  return face_force<Dim>(properties, friction, dashpot, step.length, motion, geometry, face, history, slip_normal);
}

// Bonds the compressed parts of a contact whose bond is due. One that was `closed` without force when its bond became
// due is bonded as a whole when a part of it is first compressed: the bond carries the load that would part the rest.
template <int Dim>
void bond_what_presses(const JointProperties& properties, bool closed, std::size_t place, ContactsState<Dim>& contacts,
                       long long& made) {
  Contact<Dim>& c = contacts.list[place];
  const auto presses = [&](double overlap) { return normal_answer(properties, overlap, false).stress > 0; };
  const auto is_whole = [&](std::span<const SubContact<Dim>> cells) {
    return closed &&
           std::ranges::any_of(cells, [&](const SubContact<Dim>& s) { return s.area > 0 && presses(s.overlap); });
  };
  const auto bond = [&](bool bonds, JointState<Dim>& history) {
    if (history.bond != Bond::lost || !bonds) return;
    history.bond = Bond::whole;
    history.bond_slip = 0;
    ++made;
  };
  if (!properties.laws.bond) {
    c.bond_due = false;
  } else if (c.cells == 0) {
    bond(presses(c.geometry.overlap), c.history);
    c.bond_due = c.history.bond == Bond::lost;
  } else {
    const bool whole = is_whole(subs_of(std::as_const(contacts), place));
    for (SubContact<Dim>& s : subs_of(contacts, place))
      if (s.area > 0) bond(whole || presses(s.overlap), s.history);
  }
}

// a slipped bond gives way to a new one
template <int Dim>
void renew_slipped(std::size_t place, ContactsState<Dim>& contacts) {
  const auto renew = [](JointState<Dim>& history) {
    if (history.bond == Bond::slipped) history.bond = Bond::lost;
  };
  renew(contacts.list[place].history);
  for (SubContact<Dim>& s : subs_of(contacts, place))
    renew(s.history);
}

// load of a touching contact on its bodies; the second one's centroid is `apart` from the first's
template <int Dim>
[[gnu::always_inline]] inline void note_load(const Contact<Dim>& c, std::span<const SubContact<Dim>> subs, int second,
                                             const Vector<Dim>& apart, ContactLoad<Dim>& load) {
  load = {.second = second, .force = c.force};
  const auto add = [&](const Vector<Dim>& point, const Vector<Dim>& force) {
    load.about_first += moment(point, force);
    load.about_second += moment(Vector<Dim>(point - apart), force);
  };
  if (c.cells == 0) add(c.geometry.point, c.force);
  for (const SubContact<Dim>& s : subs)
    if (s.area > 0) add(s.point, s.force);
}

// The joint of one contact, or of each of its cells; inlined as above. With `Places` some joint remembers its place.
template <int Dim, bool Places>
[[gnu::always_inline]] inline void answer(const Model<Dim>& model, const Settings& settings,
                                          const std::vector<Friction>& frictions, const JointStep& step,
                                          const BodiesState<Dim>& bodies, std::size_t place, const Climb& climb,
                                          ContactsState<Dim>& contacts, JointSums& sums) {
  Contact<Dim>& c = contacts.list[place];
  if (!c.touching()) {
    if constexpr (Places)
      fly<Dim>(model.properties[c.properties],
               dilation_in_force(model.properties[c.properties], frictions[c.properties].angle,
                                 frictions[c.properties].strength_factor),
               step.length * motion_of(model, bodies, c).velocity_at(c.geometry.point), rises_of(contacts, place));
    return;
  }
  const JointProperties& properties = model.properties[c.properties];
  if (c.bond_due) [[unlikely]]
    bond_what_presses(properties, bonds_of(contacts, place).held() == 0, place, contacts, sums.bonds_made);
  const Friction& friction = frictions[c.properties];
  const PairMotion<Dim> motion = motion_of(model, bodies, c);
  if (is_integrated(settings.contact, properties)) [[unlikely]] {
    const FaceForce<Dim> f = whole_face_force<Dim>(properties, step, motion, c.geometry, contacts.faces[place],
                                                   friction.coefficient, c.history);
    c.force = f.force;
    contacts.loads[place] = {model.parts[c.part_b].body, f.force, f.about, f.about - moment(motion.between, f.force)};
    sums.elastic += f.elastic;
    sums.friction += f.friction;
    sums.lost_area += f.lost_area;
    sums.dashpots += f.dashpots;
    return;
  }
  std::span<JointRise<Dim>> rises;
  double drawn = 0;  // m: by this the pair was drawn together
  if constexpr (Places) {
    rises = rises_of(contacts, place);
    drawn = drawn_by<Dim>(model, bodies, c, rises, climb);
  }
  if (c.cells == 0) {
    Bearing<Dim> at{c.geometry.point, c.geometry.normal, c.geometry.overlap, c.geometry.area};
    if (properties.constant_stiffness) {
      at.area = 1;
      at.stiffness_factor = c.geometry.stiffness_factor;
    }
    JointRise<Dim>* const rise = Places ? rises.data() : nullptr;
    if (drawn > 0) at.overlap = closure_of<Dim>(at.overlap, drawn, *rise);
    c.force = joint_force<Dim>(properties, step, motion, at, friction, c.history, rise, sums);
    note_load<Dim>(c, {}, model.parts[c.part_b].body, motion.between, contacts.loads[place]);
    return;
  }
  // each cell has its own force; the contact keeps their sum
  double whole = 0;
  for (const SubContact<Dim>& s : subs_of(contacts, place))
    whole += s.area;
  c.force.setZero();
  c.history = {};
  c.history.normal = c.geometry.normal;
  c.history.point = c.geometry.point;
  c.history.area = properties.constant_stiffness ? 1 : whole;
  c.history.bond = whole > 0 ? Bond::whole : Bond::lost;
  for (SubContact<Dim>& s : subs_of(contacts, place)) {
    if (!(s.area > 0)) continue;
    JointRise<Dim>* const rise = Places ? &rises[&s - subs_of(contacts, place).data()] : nullptr;
    const double overlap = drawn > 0 ? closure_of<Dim>(s.overlap, drawn, *rise) : s.overlap;
    const double area = properties.constant_stiffness ? s.area / whole : s.area;
    const Bond before = s.history.bond;
    s.force = joint_force<Dim>(properties, step, motion,
                               {s.point, c.geometry.normal, overlap, area, s.overlap_variance, s.area / whole},
                               friction, s.history, rise, sums);
    c.force += s.force;
    c.history.shear_force += s.history.shear_force;
    c.history.plastic_slip += s.area / whole * s.history.plastic_slip;
    c.history.dashpot += s.history.dashpot;
    if (c.history.bond != Bond::lost && s.history.bond != Bond::whole) c.history.bond = s.history.bond;
    c.history.bond_slip += s.area / whole * s.history.bond_slip;
    if (before != Bond::lost && s.history.bond == Bond::lost)
      c.bond_due = false;  // if one breaks, none is made any more
  }
  note_load<Dim>(c, subs_of(std::as_const(contacts), place), model.parts[c.part_b].body, motion.between,
                 contacts.loads[place]);
}

// the sums of all groups of contacts, in their order
void add(const std::vector<JointSums>& sums, Ledger& ledger, Counters& counters) {
  ledger.energy.elastic = 0;
  for (const JointSums& b : sums) {
    ledger.energy.elastic += b.elastic;
    ledger.energy.flows[Source::friction] += b.friction;
    ledger.energy.flows[Source::lost_area] += b.lost_area;
    ledger.energy.flows[Source::dashpots] += b.dashpots;
    ledger.energy.flows[Source::stiffening] += b.stiffening;
    ledger.energy.flows[Source::dilation] += b.dilation;
    ledger.energy.flows[Source::irrecoverable_closure] += b.crushing;
    counters.snap_backs += b.snap_backs;
    ledger.bonds.made += b.bonds_made;
  }
}

}  // namespace

template <int Dim>
PairWrench<Dim> joint_wrench(const Model<Dim>& model, const Schedule& schedule, const JointStep& step,
                             const Contact<Dim>& c, std::span<const SubContact<Dim>> subs,
                             const IntegratedContact<Dim>* face, const PairMotion<Dim>& motion,
                             const JointState<Dim>& history, std::span<const JointState<Dim>> sub_histories,
                             std::span<const JointRise<Dim>> rises, double drawn, Vector<3>* slip_normal) {
  PairWrench<Dim> wrench = PairWrench<Dim>::Zero();
  if (!c.touching()) return wrench;
  const JointProperties& properties = model.properties[c.properties];
  const Friction friction = friction_of(schedule, c.properties);
  if (face != nullptr) {
    JointState<Dim> past = history;
    const FaceForce<Dim> f =
        whole_face_force<Dim>(properties, step, motion, c.geometry, *face, friction.coefficient, past, slip_normal);
    wrench.template head<Dim>() = f.force;
    wrench.template tail<spin_freedoms<Dim>>() = f.about - moment(motion.between, f.force);
    return wrench;
  }
  JointSums sums;
  const auto add = [&](const Bearing<Dim>& at, JointState<Dim> past, std::size_t k) {
    JointRise<Dim> rise = rises.empty() ? JointRise<Dim>{} : rises[k];
    const Vector<Dim> force = joint_force<Dim>(properties, step, motion, at, friction, past, &rise, sums);
    wrench.template head<Dim>() += force;
    wrench.template tail<spin_freedoms<Dim>>() += moment(Vector<Dim>(at.point - motion.between), force);
  };
  if (c.cells == 0) {
    Bearing<Dim> at{c.geometry.point, c.geometry.normal, c.geometry.overlap, c.geometry.area};
    if (properties.constant_stiffness) {
      at.area = 1;
      at.stiffness_factor = c.geometry.stiffness_factor;
    }
    if (drawn > 0) at.overlap = closure_of<Dim>(at.overlap, drawn, rises[0]);
    add(at, history, 0);
    return wrench;
  }
  double whole = 0;
  for (const SubContact<Dim>& s : subs)
    whole += s.area;
  for (std::size_t i = 0; i < subs.size(); ++i) {
    const SubContact<Dim>& s = subs[i];
    if (!(s.area > 0)) continue;
    const double area = properties.constant_stiffness ? s.area / whole : s.area;
    const double overlap = drawn > 0 ? closure_of<Dim>(s.overlap, drawn, rises[i]) : s.overlap;
    add({s.point, c.geometry.normal, overlap, area, s.overlap_variance, s.area / whole}, sub_histories[i], i);
  }
  return wrench;
}

template <int Dim>
void find_joint_forces(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                       const JointStep& step, BodiesState<Dim>& bodies, ContactsState<Dim>& contacts, Ledger& ledger,
                       Counters& counters) {
  static thread_local std::vector<JointSums> own;
  std::vector<JointSums>& sums = own;  // of this thread, filled by all
  sums.assign(groups_of(contacts.list.size()), {});
  const std::vector<Friction>& frictions = frictions_of(schedule);
  const auto find = [&](auto places) {
    const Climb climb = places ? climb_over(model, step.length) : Climb{};
    const auto answer_found = [&](int group, std::span<Contact<Dim>* const> found) {
      for (const Contact<Dim>* c : found)
        answer<Dim, decltype(places)::value>(model, settings, frictions, step, bodies,
                                             static_cast<std::size_t>(c - contacts.list.data()), climb, contacts,
                                             sums[group]);
    };
    find_contacts<Dim>(model, settings, step.length, bodies, contacts, counters, std::ref(answer_found));
  };
  contacts.rises.empty() ? find(std::false_type()) : find(std::true_type());
  add(sums, ledger, counters);
}

template <int Dim>
void apply_joint_laws(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                      const JointStep& step, const BodiesState<Dim>& bodies, ContactsState<Dim>& contacts,
                      Ledger& ledger, Counters& counters) {
  contacts.loads.resize(contacts.list.size());
  const std::vector<Friction>& frictions = frictions_of(schedule);
  const auto work = [&](auto places) {
    const Climb climb = places ? climb_over(model, step.length) : Climb{};
    return sums_in_groups<JointSums>(settings.threads, contacts.list.size(), [&](int i, JointSums& sum) {
      answer<Dim, decltype(places)::value>(model, settings, frictions, step, bodies, static_cast<std::size_t>(i), climb,
                                           contacts, sum);
    });
  };
  add(contacts.rises.empty() ? work(std::false_type()) : work(std::true_type()), ledger, counters);
}

template <int Dim>
void make_bonds(const Model<Dim>& model, const Settings& settings, BodiesState<Dim>& bodies,
                ContactsState<Dim>& contacts, BondTally& bonds, Counters& counters,
                const std::vector<std::pair<int, int>>* between) {
  if (std::ranges::none_of(model.properties, [](const JointProperties& p) { return p.laws.bond; })) return;
  // the closed ones of the near pairs are found as each is examined
  find_neighbours(model, settings, bodies, contacts, counters);
  for (Contact<Dim>& c : contacts.list) {
    const std::pair<int, int> pair = std::minmax({model.parts[c.part_a].body, model.parts[c.part_b].body});
    c.bond_due = !between || std::ranges::binary_search(*between, pair);
  }
  for (std::size_t i = 0; i < contacts.list.size(); ++i) {
    if (contacts.list[i].bond_due) renew_slipped(i, contacts);
  }
  find_contacts(model, settings, 0, bodies, contacts, counters);
  for (std::size_t i = 0; i < contacts.list.size(); ++i)
    if (const Contact<Dim>& c = contacts.list[i]; c.bond_due && c.touching())
      bond_what_presses(model.properties[c.properties], false, i, contacts, bonds.made);
}

template <int Dim>
void remove_bonds(const Model<Dim>& model, ContactsState<Dim>& contacts, BondTally& bonds) {
  for (std::size_t i = 0; i < contacts.list.size(); ++i) {
    Contact<Dim>& c = contacts.list[i];
    if (model.bodies[model.parts[c.part_a].body].present && model.bodies[model.parts[c.part_b].body].present) continue;
    bonds.removed += bonds_of(contacts, i).held();
    c.history.bond = Bond::lost;
    for (SubContact<Dim>& s : subs_of(contacts, i))
      s.history.bond = Bond::lost;
  }
}

template <int Dim>
void zero_slip(ContactsState<Dim>& contacts) {
  for (Contact<Dim>& c : contacts.list)
    c.history.plastic_slip = 0;
  for (SubContact<Dim>& s : contacts.subs)
    s.history.plastic_slip = 0;
}

template <int Dim>
BondCount count_bonds(const ContactsState<Dim>& contacts, const BondTally& bonds) {
  BondCount count{.made = bonds.made, .removed = bonds.removed};
  for (std::size_t i = 0; i < contacts.list.size(); ++i) {
    const Bonds now = bonds_of(contacts, i);
    count.whole += now.whole;
    count.slipped += now.slipped;
    count.due += contacts.list[i].bond_due && now.held() == 0;
  }
  count.broken = count.made - count.removed - count.whole - count.slipped;
  return count;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                      \
  template PairWrench<Dim> joint_wrench<Dim>(                                                                          \
      const Model<Dim>&, const Schedule&, const JointStep&, const Contact<Dim>&, std::span<const SubContact<Dim>>,     \
      const IntegratedContact<Dim>*, const PairMotion<Dim>&, const JointState<Dim>&, std::span<const JointState<Dim>>, \
      std::span<const JointRise<Dim>>, double, Vector<3>*);                                                            \
  template void find_joint_forces<Dim>(const Model<Dim>&, const Settings&, const Schedule&, const JointStep&,          \
                                       BodiesState<Dim>&, ContactsState<Dim>&, Ledger&, Counters&);                    \
  template void apply_joint_laws<Dim>(const Model<Dim>&, const Settings&, const Schedule&, const JointStep&,           \
                                      const BodiesState<Dim>&, ContactsState<Dim>&, Ledger&, Counters&);               \
  template void make_bonds<Dim>(const Model<Dim>&, const Settings&, BodiesState<Dim>&, ContactsState<Dim>&,            \
                                BondTally&, Counters&, const std::vector<std::pair<int, int>>*);                       \
  template void remove_bonds<Dim>(const Model<Dim>&, ContactsState<Dim>&, BondTally&);                                 \
  template void zero_slip<Dim>(ContactsState<Dim>&);                                                                   \
  template BondCount count_bonds<Dim>(const ContactsState<Dim>&, const BondTally&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
