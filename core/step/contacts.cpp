#include "core/step/contacts.hpp"

#include <algorithm>
#include <limits>

#include "core/contact/narrow_phase.hpp"
#include "core/contact/sub_contacts.hpp"
#include "core/on_threads.hpp"
#include "core/step/neighbours.hpp"

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
void resolve(const Model<Dim>& model, const Settings& settings, State<Dim>& state, QueryLevel level, double gap,
             int first, int last, Tally& tally) {
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
    pairs.push_back(pair_of(model, state, c.part_a, c.part_b, level));
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

}  // namespace

template <int Dim>
void find_contacts(const Model<Dim>& model, const Settings& settings, State<Dim>& state) {
  const int count = static_cast<int>(state.contacts.size());
  const QueryLevel level = needs_area(model) ? QueryLevel::area : QueryLevel::overlap;
  const double gap = closed_gap(model);
  cache_poses(model, settings.threads, state);
  count_travels(model, settings, state);
  // batches that stay in the cache, and enough of them for every thread
  const int batch = std::clamp(count / settings.threads + 1, 16, 256), batches = (count + batch - 1) / batch;
  static thread_local std::vector<Tally> own;
  std::vector<Tally>& tallies = own;  // this thread's, filled by all
  tallies.assign(batches, {});
  on_threads(settings.threads, batches, [&](int i) {
    resolve(model, settings, state, level, gap, i * batch, std::min(count, (i + 1) * batch), tallies[i]);
  });
  for (const Tally& tally : tallies)
    add(state.counters, tally);
}

template void find_contacts<2>(const Model<2>&, const Settings&, State<2>&);
template void find_contacts<3>(const Model<3>&, const Settings&, State<3>&);

}  // namespace voussoir
