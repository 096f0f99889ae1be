#include "core/stages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/contact/narrow_phase.hpp"
#include "core/contact/sub_contacts.hpp"
#include "core/motion/integrate.hpp"
#include "core/motion/prescribed.hpp"
#include "core/motion/relaxation.hpp"
#include "core/motion/time_step.hpp"
#include "core/neighbours.hpp"
#include "core/on_threads.hpp"

namespace voussoir {
namespace {

// a few roundings: what is multiplied by this is a lower bound of what it would be without any
constexpr double downwards = 1 - 8 * std::numeric_limits<double>::epsilon();

// the joint a contact lies on: of the two faces' joints the later cut
template <int Dim>
int joint_of(const Model<Dim>& model, const Contact<Dim>& c) {
  if (model.joints.empty()) return no_joint;
  return std::max(model.polytope(c.part_a).joints[c.geometry.face_a],
                  model.polytope(c.part_b).joints[c.geometry.face_b]);
}

template <int Dim>
bool needs_area(const Model<Dim>& model) {
  return std::any_of(model.properties.begin(), model.properties.end(),
                     [](const JointProperties& p) { return !p.constant_stiffness || p.sub_contacts > 1; });
}

// nor do its sub-contacts count any more
template <int Dim>
void forget(Contact<Dim>& contact) {
  contact.history = {};
  contact.force.setZero();
  contact.cells = 0;
  contact.divided_face = -1;
}

// what the candidates' skin has added leaves no trace: the result is the same for any skin
template <int Dim>
void set_apart(Contact<Dim>& contact) {
  if (contact.status == ContactStatus::apart) return;
  contact.status = ContactStatus::apart;
  contact.area_rated = -1;
  contact.proof = {};
  contact.free_until = 0;
  forget(contact);
}

// what some contacts have cost, and how many are without an answer
struct Tally {
  KernelCounters kernel;
  long long unconverged = 0;
};

// the contacts [first, last) of the list, in one batch
template <int Dim>
void resolve(const Model<Dim>& model, const Settings& settings, State<Dim>& state, Stage stage, double gap, int first,
             int last, Tally& tally) {
  static thread_local std::vector<Pair<Dim>> pairs;
  static thread_local std::vector<Contact<Dim>*> waiting;
  static thread_local std::vector<char> touched;  // of those that wait, before
  pairs.clear();
  waiting.clear();
  touched.clear();
  for (int i = first; i < last; ++i) {
    Contact<Dim>& c = state.contacts[i];
    if (!is_near(model, state, gap, c)) {
      if (c.bond_due && whole_bonds(state, static_cast<std::size_t>(i)) > 0)
        c.bond_due = false;  // lost, not to be made again
      set_apart(c);
      continue;
    }
    if (c.status == ContactStatus::separated && !c.bond_due && travelled(model, state, c) < c.free_until) {
      ++tally.kernel.motion_skips;
      continue;
    }
    pairs.push_back(pair_of(model, state, c.part_a, c.part_b, stage));
    waiting.push_back(&c);
    touched.push_back(c.touching());
  }
  narrow_phase<Dim>(pairs, settings.contact, model.solvers, waiting, tally.kernel);

  const std::size_t stride = state.contacts.empty() ? 0 : state.subs.size() / state.contacts.size();
  for (std::size_t i = 0; i < waiting.size(); ++i) {
    Contact<Dim>* const c = waiting[i];
    const std::size_t place = c - state.contacts.data();
    const long long bonds = c->bond_due ? whole_bonds(state, place) : 0;
    if (c->unanswered()) ++tally.unconverged;
    if (c->touching()) {
      c->joint = joint_of(model, *c);
      c->properties = c->joint == no_joint ? model.default_properties : model.joints[c->joint].properties;
      const int along = model.properties[c->properties].sub_contacts;
      if (const int cells = sub_contact_count<Dim>(along); cells > 0)
        divide<Dim>(pairs[i], along, *c, std::span(state.subs).subspan(place * stride, cells));
      else
        c->cells = 0;
      if (bonds > 0 && whole_bonds(state, place) < bonds) c->bond_due = false;
      continue;
    }
    if (bonds > 0 || (c->status == ContactStatus::separated && c->proof.margin > gap)) c->bond_due = false;
    if (touched[i]) {
      c->near_until = 0;  // only its boxes were looked at
      if (!is_near(model, state, gap, *c)) {
        set_apart(*c);
        continue;
      }
    }
    forget(*c);
    c->free_until =
        c->status == ContactStatus::separated ? (travelled(model, state, *c) + c->proof.margin) * downwards : 0;
  }
}

void add(Counters& total, const Tally& tally) {
  const KernelCounters& k = tally.kernel;
  total.unconverged += tally.unconverged;
  total.contact_evaluations += k.evaluations;
  total.motion_skips += k.motion_skips;
  total.axis_hits += k.axis_hits;
  total.cold_starts += k.cold_starts;
  total.lp_solves += k.lp_solves;
  total.lp_pivots += k.lp_pivots;
  total.newton_iterations += k.newton_iterations;
  total.centre_fallbacks += k.centre_fallbacks;
  total.undecided += k.undecided;
  total.areas += k.areas;
  total.normal_fallbacks += k.normal_fallbacks;
  total.deep_overlaps += k.deep_overlaps;
}

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

// The next step of a motion: as long as allowed, or as much shorter as lets equal steps end the run when it shall end.
template <int Dim>
double next_step(const State<Dim>& state) {
  if (!std::isfinite(state.schedule.ends)) return state.step_allowed;
  constexpr double rounding = 1e-6;  // of a step: a million steps do not sum up to one more
  const double left = state.schedule.ends - state.time;
  return left / std::max(1.0, std::ceil(left / state.step_allowed - rounding));
}

// gravity that grows lifts or lowers the potential energy of what has already moved
template <int Dim>
void book_gravity_ramp(const Model<Dim>& model, State<Dim>& state) {
  const double growth = state.schedule.gravity_factor - state.schedule.last_gravity_factor;
  state.schedule.last_gravity_factor = state.schedule.gravity_factor;
  if (growth == 0 || state.energy.phase == LedgerPhase::not_begun) return;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].still())
      state.energy.flows.ramp -= growth * model.bodies[b].mass * model.gravity.dot(state.motions[b].displacement);
}

// What the motion of some bodies adds to the books: kinetic energy, and flows before and after the time of the
// positions.
struct Booked {
  double kinetic = 0;
  EnergyFlows before, after;
};

void book(EnergyFlows& flows, double gravity, double boundary, double load, double damping, double prescribed) {
  flows.gravity += gravity;
  flows.boundary += boundary;
  flows.contacts += load - gravity - boundary;
  flows.local += damping;
  flows.prescribed += prescribed;
}

void add(EnergyFlows& flows, const EnergyFlows& more) {
  flows.gravity += more.gravity;
  flows.boundary += more.boundary;
  flows.contacts += more.contacts;
  flows.local += more.local;
  flows.prescribed += more.prescribed;
}

template <int Dim>
void book(const Model<Dim>& model, const State<Dim>& state, const std::vector<KickEnergy<Dim>>& kicks, int b,
          Booked& booked) {
  const Body<Dim>& body = model.bodies[b];
  if (body.still()) return;
  const KickEnergy<Dim>& kick = kicks[b];
  const Vector<Dim> gravity = weight(model, state, static_cast<std::size_t>(b));
  const BoundaryWork push = boundary_work(body, state.stances[b].axes, kick);
  booked.kinetic += kick.kinetic;
  book(booked.before, gravity.dot(kick.path_before), push.before, kick.load_before, kick.damping_before,
       kick.prescribed_before);
  book(booked.after, gravity.dot(kick.path_after), push.after, kick.load_after, kick.damping_after,
       kick.prescribed_after);
}

}  // namespace

template <int Dim>
void find_contacts(const Model<Dim>& model, const Settings& settings, State<Dim>& state) {
  const int count = static_cast<int>(state.contacts.size());
  const Stage stage = needs_area(model) ? Stage::area : Stage::overlap;
  const double gap = closed_gap(model);
  find_stances(model, settings.threads, state);
  count_travels(model, settings, state);
  // batches that stay in the cache, and enough of them for every thread
  const int batch = std::clamp(count / settings.threads + 1, 16, 256), batches = (count + batch - 1) / batch;
  static thread_local std::vector<Tally> own;
  std::vector<Tally>& tallies = own;  // this thread's, filled by all
  tallies.assign(batches, {});
  on_threads(settings.threads, batches, [&](int i) {
    resolve(model, settings, state, stage, gap, i * batch, std::min(count, (i + 1) * batch), tallies[i]);
  });
  for (const Tally& tally : tallies)
    add(state.counters, tally);
}

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

template <int Dim>
void move_bodies(const Model<Dim>& model, const Settings& settings, State<Dim>& state) {
  if (state.relaxation.under_way) {
    book_gravity_ramp(model, state);
    return relax_bodies(model, settings, state);
  }

  // within a stage the step only shrinks, as soon as a contact is stiffer than it was chosen for
  const double last = state.time_step;
  if (state.counters.steps % steps_between_looks == 0) state.frequency.clear();  // rest is judged by them, too
  if (const auto renewed = renew_time_step(model, settings, settings.damping, state)) {
    state.step_allowed = state.step_allowed > 0 ? std::min(state.step_allowed, renewed->step) : renewed->step;
    demand_time_step(state);
  }
  state.time_step = next_step(state);

  book_gravity_ramp(model, state);
  const StepTimes times{0.5 * (last + state.time_step), state.time_step};
  const double elapsed = state.time + 0.5 * state.time_step - state.schedule.started;  // at the middle of the step
  const KickRule rule{.local_damping = settings.damping.local};
  std::vector<KickEnergy<Dim>>& kicks = advance_bodies<Dim>(model, settings.threads, {&rule, 1}, times, state);
  for (const PrescribedMotion<Dim>& p : model.prescribed)
    force(model.bodies[p.body], p, state.loads[p.body], elapsed, times, state.motions[p.body], kicks[p.body]);

  EnergyLedger& energy = state.energy;
  energy.kinetic = 0;
  EnergyFlows after;
  const auto work = [&](int b, Booked& sum) { book(model, state, kicks, b, sum); };
  for (const Booked& sum : sums_in_groups<Booked>(settings.threads, kicks.size(), work)) {
    energy.kinetic += sum.kinetic;
    add(energy.flows, sum.before);
    add(after, sum.after);
  }
  balance(energy);
  add(energy.flows, after);
  const bool ends = state.time_step == state.schedule.ends - state.time;
  state.time = ends ? state.schedule.ends : state.time + state.time_step;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                    \
  template void find_contacts<Dim>(const Model<Dim>&, const Settings&, State<Dim>&); \
  template void sum_loads<Dim>(const Model<Dim>&, const Settings&, State<Dim>&);     \
  template void move_bodies<Dim>(const Model<Dim>&, const Settings&, State<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
