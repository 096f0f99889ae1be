#include "core/step/contacts.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "core/base/on_threads.hpp"
#include "core/contact/integrable.hpp"
#include "core/contact/narrow_phase.hpp"
#include "core/contact/rounding.hpp"
#include "core/contact/sub_contacts.hpp"
#include "core/step/flight.hpp"
#include "core/step/neighbours.hpp"

namespace voussoir {
namespace {

// vertices of a contact polygon: up to this number the step allocates no memory
constexpr std::size_t expected_corners = 16;

template <int Dim>
bool needs_area(const Model<Dim>& model, const ContactSettings& settings) {
  return std::any_of(model.properties.begin(), model.properties.end(), [&](const JointProperties& p) {
    return (!p.constant_stiffness || p.sub_contacts > 1) && !is_integrated(settings, p);
  });
}

// depth of the contact solution: integrated face contacts need only a point in the overlap
template <int Dim>
QueryLevel level_of(const Model<Dim>& model, const ContactSettings& settings) {
  const auto whole = [&](const JointProperties& p) { return is_integrated(settings, p); };
  if (!model.properties.empty() && std::ranges::all_of(model.properties, whole)) return QueryLevel::point;
  return needs_area(model, settings) ? QueryLevel::area : QueryLevel::overlap;
}

// The joint of a contact, and the kind of its contact; true: integrated, with the planes of both parts. If there are
// integrated contacts, the faces nearest to the contact point determine the joint of every contact.
template <int Dim>
[[gnu::always_inline]] inline bool choose_joint(const Model<Dim>& model, const ContactSettings& settings,
                                                const Pair<Dim>& pair, Contact<Dim>& c, HalfSpaces<Dim>& planes) {
  if (settings.face == ContactFace::integrated && c.proof.kind == ProofKind::interior_point) [[unlikely]]
    find_nearest_faces<Dim>(pair, c, planes);
  c.joint = joint_of(model, c);
  c.properties = c.joint == no_joint ? model.default_properties : model.joints[c.joint].properties;
  return is_integrated(settings, model.properties[c.properties]);
}

// nor are its sub-contacts valid any more
template <int Dim>
void forget(Contact<Dim>& contact) {
  contact.history = {};
  contact.force.setZero();
  contact.cells = 0;
  contact.divided_face = -1;
}

// candidates added by the skin have no effect: the result is the same for any skin
template <int Dim>
void set_apart(Contact<Dim>& contact) {
  if (contact.status == ContactStatus::apart) return;
  contact.status = ContactStatus::apart;
  contact.area_rated = -1;
  contact.proof = {};
  contact.free_until = 0;
  forget(contact);
}

// nor is the place of its joint
template <int Dim>
void forget_place(ContactsState<Dim>& contacts, std::size_t place) {
  std::ranges::fill(rises_of(contacts, place), JointRise<Dim>{});
}

// m: by how far the parts of a pair are separated along a direction, that of `axes`; without vertices as far as can be
template <int Dim>
double gap_along(const Pair<Dim>& pair, const Vector<Dim>& direction) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Vector<Dim> of_a = pair.axes.transpose() * direction, of_b = pair.rotation.transpose() * of_a;
  double high = -infinity, low = infinity;
  for (const Vector<Dim>& v : pair.a->vertices)
    high = std::max(high, of_a.dot(v));
  for (const Vector<Dim>& v : pair.b->vertices)
    low = std::min(low, of_b.dot(v));
  return low < infinity ? low + of_a.dot(pair.offset) - high : infinity;
}

// Whether a joint that has parted keeps the place to which it had slipped: while its block flies no higher above the
// risen plane than the joint has risen. The pair has been drawn together by that rise.
template <int Dim>
bool keeps_place(const Contact<Dim>& c, const Pair<Dim>& pair, std::span<const JointRise<Dim>> rises) {
  const JointRise<Dim>* const rise = highest(rises);
  return rise && c.status == ContactStatus::separated && gap_along<Dim>(pair, rise->normal) <= rise->rise;
}

// Sub-contacts that do not touch, and all of them if another face was divided, take the place of the highest one.
template <int Dim>
void follow_cells(int divided_before, std::size_t place, ContactsState<Dim>& contacts) {
  const std::span<JointRise<Dim>> rises = rises_of(contacts, place);
  const std::span<const SubContact<Dim>> cells = subs_of(std::as_const(contacts), place);
  const JointRise<Dim>* const most = highest<Dim>(rises);
  if (!most) return;
  const JointRise<Dim> risen = *most;
  const bool other_face = divided_before >= 0 && contacts.list[place].divided_face != divided_before;
  for (std::size_t k = 0; k < std::min(cells.size(), rises.size()); ++k) {
    if (!other_face && cells[k].area > 0) continue;
    rises[k] = risen;
    rises[k].stress = 0;
  }
}

// the cost of some contacts, and the number of those without a result
struct Tally {
  KernelCounters kernel;
  long long unconverged = 0;
};

// Contacts to be resolved together, and, already computed, those whose faces are in contact as before.
template <int Dim>
struct PendingPairs {
  int count = 0;
  std::array<Pair<Dim>, pairs_together> pairs;
  std::array<Contact<Dim>*, pairs_together> contacts;
  std::array<bool, pairs_together> touched;  // before
  int looked_at = 0;
  std::array<Contact<Dim>*, pairs_together> all;

  template <bool Places>
  void add(const Model<Dim>& model, const Settings& settings, const BodiesState<Dim>& bodies, QueryLevel level,
           double drawn, ContactsState<Dim>& candidates, Contact<Dim>& c, KernelCounters& counters) {
    Pair<Dim>& pair = pairs[count];
    set_pair(model, bodies, c.part_a, c.part_b, level, pair);
    if constexpr (Places)
      if (drawn > 0)
        draw_together<Dim>(drawn, drawn_along<Dim>(rises_of(candidates, &c - candidates.list.data())), pair);
    all[looked_at++] = &c;
    if (c.touching() && is_integrated(settings.contact, model.properties[c.properties])) [[unlikely]] {
      if (integrate_as_before<Dim>(pair, c, candidates.faces[&c - candidates.list.data()])) {
        ++counters.evaluations;
        return;
      }
    }
    contacts[count] = &c;
    touched[count] = c.touching();
    ++count;
  }
};

// Their results. With `Places` some joint remembers its place (ContactsState::rises); compiled apart, so that other
// models have no instruction of it.
template <int Dim, bool Places>
void resolve(const Model<Dim>& model, const Settings& settings, const BodiesState<Dim>& bodies, double gap,
             const PendingPairs<Dim>& pending, ContactsState<Dim>& contacts, Tally& tally) {
  const std::span resolved = std::span(pending.contacts).first(pending.count);
  resolve_pairs<Dim>(model, settings.contact, std::span(pending.pairs).first(pending.count), resolved, tally.kernel);
  const std::size_t stride = sub_stride(contacts);
  static thread_local HalfSpaces<Dim> planes;
  for (int i = 0; i < pending.count; ++i) {
    Contact<Dim>* const c = resolved[i];
    const std::size_t place = c - contacts.list.data();
    const long long bonds = c->bond_due ? bonds_of(contacts, place).held() : 0;
    [[maybe_unused]] const int divided = c->divided_face;
    if (c->touching()) {
      const bool whole = choose_joint(model, settings.contact, pending.pairs[i], *c, planes);
      const int along = model.properties[c->properties].sub_contacts;
      if (whole) [[unlikely]] {
        c->cells = 0;
        if (!integrate_contact<Dim>(pending.pairs[i], planes, *c, contacts.faces[place])) {
          c->status = ContactStatus::no_face;
          ++tally.unconverged;
        }
      } else if (const int cells = sub_contact_count<Dim>(along); cells > 0) {
        divide<Dim>(pending.pairs[i], along, *c, std::span(contacts.subs).subspan(place * stride, cells));
        if constexpr (Places) follow_cells(divided, place, contacts);
      } else {
        c->cells = 0;
      }
      if (bonds > 0 && bonds_of(contacts, place).held() < bonds) c->bond_due = false;
      continue;
    }
    if (c->unanswered()) ++tally.unconverged;
    if (bonds > 0 || (c->status == ContactStatus::separated && c->proof.margin > gap)) c->bond_due = false;
    if constexpr (Places) {
      if (keeps_place<Dim>(*c, pending.pairs[i], rises_of(std::as_const(contacts), place))) {
        forget(*c);
        c->free_until = 0;
        continue;
      }
      forget_place(contacts, place);
    }
    if (pending.touched[i]) {
      c->near_until = 0;  // only its boxes were compared
      if (!is_near(model, bodies, gap, *c)) {
        set_apart(*c);
        continue;
      }
    }
    forget(*c);
    c->free_until =
        c->status == ContactStatus::separated ? (travelled(model, bodies, *c) + c->proof.margin) * downwards : 0;
  }
}

// the contacts of one group
template <int Dim, bool Places>
void find_contacts_of(const Model<Dim>& model, const Settings& settings, const Climb& climb,
                      const BodiesState<Dim>& bodies, QueryLevel level, double gap, int group,
                      const FoundContacts<Dim>& found, ContactsState<Dim>& contacts, Tally& tally) {
  static thread_local PendingPairs<Dim> pending;
  const auto resolve_waiting = [&] {
    resolve<Dim, Places>(model, settings, bodies, gap, pending, contacts, tally);
    if (found) found(group, std::span(pending.all).first(pending.looked_at));
    pending.count = pending.looked_at = 0;
  };
  const std::size_t first = group * summed_together, last = std::min(first + summed_together, contacts.list.size());
  for (std::size_t i = first; i < last; ++i) {
    Contact<Dim>& c = contacts.list[i];
    if (!contacts.kept.empty() && contacts.kept[i]) [[unlikely]]
      continue;
    contacts.loads[i].second = -1;
    double drawn = 0;
    if constexpr (Places) drawn = drawn_by<Dim>(model, bodies, c, rises_of(contacts, i), climb);
    if (!(drawn > 0 ? is_near_risen(model, bodies, drawn, c) : is_near(model, bodies, gap, c))) {
      if constexpr (Places) forget_place(contacts, i);
      if (c.bond_due && bonds_of(contacts, i).held() > 0) c.bond_due = false;  // broken, not to be made again
      set_apart(c);
      continue;
    }
    if (c.status == ContactStatus::separated && !c.bond_due && travelled(model, bodies, c) < c.free_until) {
      ++tally.kernel.motion_skips;
      continue;
    }
    pending.template add<Places>(model, settings, bodies, level, drawn, contacts, c, tally.kernel);
    if (pending.looked_at == pairs_together) resolve_waiting();
  }
  if (pending.looked_at > 0) resolve_waiting();
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
  total.undecided += k.undecided;
  total.areas += k.areas;
  total.normal_fallbacks += k.normal_fallbacks;
  total.deep_overlaps += k.deep_overlaps;
}

}  // namespace

template <int Dim>
void find_contacts(const Model<Dim>& model, const Settings& settings, double seconds, BodiesState<Dim>& bodies,
                   ContactsState<Dim>& contacts, Counters& counters, const FoundContacts<Dim>& found) {
  const QueryLevel level = level_of(model, settings.contact);
  const double gap = closed_gap(model);
  cache_poses(model, settings.threads, bodies);
  count_travels(model, settings, bodies);
  contacts.loads.resize(contacts.list.size());
  if (std::ranges::any_of(model.properties,
                          [&](const JointProperties& p) { return is_integrated(settings.contact, p); })) {
    const std::size_t before = contacts.faces.size();
    if (before < contacts.list.size()) contacts.faces.resize(contacts.list.size());
    for (std::size_t i = before; i < contacts.faces.size(); ++i)
      contacts.faces[i].polygon.corners.reserve(expected_corners);
  }
  static thread_local std::vector<Tally> own;
  std::vector<Tally>& tallies = own;  // of this thread, filled by all
  tallies.assign(groups_of(contacts.list.size()), {});
  const bool places = !contacts.rises.empty();
  const Climb climb = places ? climb_over(model, seconds) : Climb{};
  on_threads(settings.threads, static_cast<int>(tallies.size()), [&](int group) {
    if (places)
      find_contacts_of<Dim, true>(model, settings, climb, bodies, level, gap, group, found, contacts, tallies[group]);
    else
      find_contacts_of<Dim, false>(model, settings, climb, bodies, level, gap, group, found, contacts, tallies[group]);
  });
  for (const Tally& tally : tallies)
    add(counters, tally);
  contacts.kept.clear();
}

template void find_contacts<2>(const Model<2>&, const Settings&, double, BodiesState<2>&, ContactsState<2>&, Counters&,
                               const FoundContacts<2>&);
template void find_contacts<3>(const Model<3>&, const Settings&, double, BodiesState<3>&, ContactsState<3>&, Counters&,
                               const FoundContacts<3>&);

}  // namespace voussoir
