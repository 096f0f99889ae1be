#include "core/step/neighbours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/on_threads.hpp"
#include "core/contact/broad_phase.hpp"
#include "core/contact/integrable.hpp"
#include "core/contact/nearness.hpp"
#include "core/contact/rounding.hpp"
#include "core/contact/sub_contacts.hpp"
#include "core/contact/thin_directions.hpp"

namespace voussoir {
namespace {

// candidates are within half a skin of either part, plus a margin: enough until one has moved that far
constexpr double candidate_reach = 0.5 * (1 + 1e-9);

// faces that part by less than this times the smallest inscribed radius are still a closed joint, for make_bonds
constexpr double closed_fraction = 1e-3;

// a few rounding errors: a value multiplied by this is an upper bound of the exact value
constexpr double upwards = 1 + 4 * std::numeric_limits<double>::epsilon();

template <int Dim>
double smallest_size(const Model<Dim>& model) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Body<Dim>& b : model.bodies)
    if (!b.fixed) smallest = std::min(smallest, b.size);
  return std::isfinite(smallest) ? smallest : 0;
}

// bounds of the angle of a rotation, rad
double turned_by(const Rotation<2>& from, const Rotation<2>& to) {
  return std::abs(to.angle - from.angle);
}
double turned_by(const Rotation<3>& from, const Rotation<3>& to) {
  // |Δq| = 2 sin(angle/4); beyond a quarter of a turn the bound is only the largest angle
  constexpr double longest = 2 * std::numbers::pi;
  const double chord = (to.quaternion.coeffs() - from.quaternion.coeffs()).norm();
  return chord < 0.5 ? 2.1 * chord : longest;
}

// upper bound of the displacement of any point of a body
template <int Dim>
double moved(const Body<Dim>& body, const Placement<Dim>& then, const Motion<Dim>& now) {
  return (now.displacement - then.displacement).norm() + body.radius * turned_by(then.rotation, now.rotation);
}

// rounding error of a coordinate
constexpr double coordinate_rounding = 8 * std::numeric_limits<double>::epsilon();

// the box around a part, from the present position of its vertices (Eq. C.1), widened by `margin` and the rounding
// error
template <int Dim>
Box<Dim> bounds(const Model<Dim>& model, const BodiesState<Dim>& bodies, int part, double margin) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const PartId id = model.parts[part];
  const Body<Dim>& body = model.bodies[id.body];
  // images of one column do not meet: only its bodies do
  Box<Dim> box{Vector<Dim>::Constant(infinity), Vector<Dim>::Constant(-infinity), id.body,
               body.immobile() || body.image};
  if (!body.present) return box;
  const CachedPose<Dim>& at = bodies.poses[id.body];
  for (const Vector<Dim>& v : body.parts[id.part].vertices) {
    const Vector<Dim> x = at.axes * v;
    box.low = box.low.cwiseMin(x);
    box.high = box.high.cwiseMax(x);
  }
  const Vector<Dim> centroid = at.reference + at.displacement;
  const Vector<Dim> reach =
      Vector<Dim>::Constant(margin + coordinate_rounding * body.radius) + coordinate_rounding * centroid.cwiseAbs();
  box.low += centroid - reach;
  box.high += centroid + reach;
  return box;
}

// The extent of each part along some directions in which parts are thin, like its box along the axes.
template <int Dim>
struct ThinSpans {
  struct Span {
    double low, high;  // m
  };
  std::size_t directions = 0;
  std::vector<Span> spans;  // by part, then by direction

  bool meet(int a, int b) const {
    for (std::size_t k = 0; k < directions; ++k) {
      const Span &of_a = spans[a * directions + k], &of_b = spans[b * directions + k];
      if (of_a.low > of_b.high || of_b.low > of_a.high) return false;
    }
    return true;
  }
};

// enough of them to find whether many parts have the same orientation
constexpr std::size_t most_sampled = 32;

template <int Dim>
void find_thin_spans(const Model<Dim>& model, const Settings& settings, const BodiesState<Dim>& bodies, double margin,
                     ThinSpans<Dim>& thin) {
  std::vector<TurnedPart<Dim>> sample;
  const std::size_t parts = model.parts.size(), sampled = std::min(parts, most_sampled);
  for (std::size_t i = 0; i < sampled; ++i) {
    const int part = static_cast<int>(parts * i / sampled);
    sample.push_back({&model.polytope(part), bodies.poses[model.parts[part].body].axes});
  }
  const std::vector<Vector<Dim>> directions = thin_directions<Dim>(sample);
  thin.directions = directions.size();
  thin.spans.resize(parts * directions.size());
  if (directions.empty()) return;
  each_on_threads(settings.threads, parts, [&](int part) {
    const int body = model.parts[part].body;
    const CachedPose<Dim>& at = bodies.poses[body];
    const Vector<Dim> centroid = at.reference + at.displacement;
    const double reach = margin + coordinate_rounding * (model.bodies[body].radius + centroid.norm());
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const Vector<Dim> seen = at.axes.transpose() * directions[k];
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Vector<Dim>& v : model.polytope(part).vertices) {
        low = std::min(low, v.dot(seen));
        high = std::max(high, v.dot(seen));
      }
      const double middle = centroid.dot(directions[k]);
      thin.spans[part * directions.size() + k] = {middle + low - reach, middle + high + reach};
    }
  });
}

template <int Dim>
double radius_of(const Model<Dim>& model, int part) {
  return model.bodies[model.parts[part].body].radius;
}

template <int Dim>
Nearness nearness_of(const Model<Dim>& model, const BodiesState<Dim>& bodies, int a, int b) {
  return nearness(pair_of(model, bodies, a, b, QueryLevel::decision), radius_of(model, a), radius_of(model, b));
}

// number of entries of ContactsState::subs for each contact
template <int Dim>
std::size_t most_cells(const Model<Dim>& model, const ContactSettings& settings) {
  int most = 0;
  for (const JointProperties& p : model.properties)
    if (!is_integrated(settings, p)) most = std::max(most, sub_contact_count<Dim>(p.sub_contacts));
  return static_cast<std::size_t>(most);
}

// whether a body may have left its half of the skin
template <int Dim>
bool outdated(const Model<Dim>& model, const Settings& settings, const BodiesState<Dim>& bodies, double skin) {
  if (bodies.listed_at.size() != model.bodies.size()) return true;
  std::atomic<bool> left = false;
  each_on_threads(settings.threads, model.bodies.size(), [&](int b) {
    if (!model.bodies[b].immobile() && moved(model.bodies[b], bodies.listed_at[b], bodies.motions[b]) > 0.5 * skin)
      left.store(true, std::memory_order_relaxed);
  });
  return left;
}

// The part with the most pairs, and the centre of the intersection of its box with all its partners' boxes.
template <int Dim>
std::string crowd_at(const Model<Dim>& model, const std::vector<Box<Dim>>& boxes,
                     const std::vector<std::pair<int, int>>& pairs) {
  std::vector<int> count(boxes.size());
  for (const auto& [a, b] : pairs) {
    ++count[a];
    ++count[b];
  }
  const int most = static_cast<int>(std::max_element(count.begin(), count.end()) - count.begin());
  Vector<Dim> low = boxes[most].low, high = boxes[most].high;
  for (const auto& [a, b] : pairs) {
    if (a != most && b != most) continue;
    const Box<Dim>& other = boxes[a == most ? b : a];
    low = low.cwiseMax(other.low);
    high = high.cwiseMin(other.high);
  }
  Vector<Dim> middle = model.origin + 0.5 * (low + high);
  for (double& x : middle)
    if (std::abs(x) < 1e-6 * radius_of(model, most)) x = 0;  // no digits that are only rounding errors
  return fmt::format(
      "more than {} pairs of blocks are near each other, {} of one block, around ({:.4g}) m: do many joints pass "
      "through one point or line "
      "there? Move some of them apart, or remove the slivers between them (slicing.smallest_inscribed_radius)",
      most_candidates(boxes.size()), count[most], fmt::join(middle, ", "));
}

// m, of all joints
template <int Dim>
double highest_rise(const ContactsState<Dim>& contacts) {
  double most = 0;
  for (const JointRise<Dim>& r : contacts.rises)
    most = std::max(most, r.rise);
  return most;
}

}  // namespace

std::size_t most_candidates(std::size_t parts) {
  return std::max<std::size_t>(2'000'000, 200 * parts);
}

// adds the displacement of each body since the last step; rounded upwards, so that it is a bound
template <int Dim>
void count_travels(const Model<Dim>& model, const Settings& settings, BodiesState<Dim>& bodies) {
  if (bodies.path_bounds.size() != model.bodies.size()) {
    note_placements(bodies, bodies.counted_at);
    bodies.path_bounds.assign(bodies.motions.size(), 0);
  }
  each_on_threads(settings.threads, bodies.path_bounds.size(), [&](int b) {
    if (model.bodies[b].immobile()) return;
    const Motion<Dim>& now = bodies.motions[b];
    double& travel = bodies.path_bounds[b];
    const double way = moved(model.bodies[b], bodies.counted_at[b], now);
    if (way > 0) travel = (travel + upwards * way) * upwards;
    bodies.counted_at[b] = {now.displacement, now.rotation};
  });
}

template <int Dim>
double closed_gap(const Model<Dim>& model) {
  const bool bonds = std::any_of(model.properties.begin(), model.properties.end(),
                                 [](const JointProperties& p) { return p.laws.bond; });
  return bonds ? closed_fraction * smallest_size(model) : 0;
}

template <int Dim>
bool is_near_risen(const Model<Dim>& model, const BodiesState<Dim>& bodies, double rise, Contact<Dim>& c) {
  c.near_until = 0;
  return c.touching() || meet(bounds(model, bodies, c.part_a, rise), bounds(model, bodies, c.part_b, rise));
}

template <int Dim>
bool is_near(const Model<Dim>& model, const BodiesState<Dim>& bodies, double gap, Contact<Dim>& c) {
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  const double way = travelled(model, bodies, c);
  if (way < c.near_until && !c.bond_due) return c.status != ContactStatus::apart;
  const Box<Dim> a = bounds(model, bodies, c.part_a, 0), b = bounds(model, bodies, c.part_b, 0);
  const double depth = (a.high.cwiseMin(b.high) - a.low.cwiseMax(b.low)).minCoeff();
  const double size = std::max({a.low.cwiseAbs().maxCoeff(), a.high.cwiseAbs().maxCoeff(), b.low.cwiseAbs().maxCoeff(),
                                b.high.cwiseAbs().maxCoeff()});
  double lasts = std::abs(depth) - rounding * size;
  bool near = meet(a, b), closed = -depth <= gap;
  if (near && !c.touching()) {
    const Nearness faces = nearness_of(model, bodies, c.part_a, c.part_b);
    near = closed = faces.near;  // faces that separate parts do so by far more than the gap
    lasts = near ? std::min(lasts, faces.lasts) : faces.lasts;
  }
  c.bond_due = c.bond_due && closed;
  c.near_until = downwards * (way + lasts);
  return near;
}

// what contacts that are kept have of the last step, in the order of the new list; one that is new is kept apart
template <int Dim>
void follow_origin(const std::vector<int>& origin, ContactsState<Dim>& contacts) {
  ContactsState<Dim> before;
  std::swap(before.faces, contacts.faces);
  std::swap(before.loads, contacts.loads);
  std::swap(before.kept, contacts.kept);
  contacts.loads.resize(origin.size());
  contacts.kept.resize(origin.size(), false);
  if (!before.faces.empty()) contacts.faces.resize(origin.size());
  for (std::size_t i = 0; i < origin.size(); ++i) {
    if (origin[i] < 0) continue;
    contacts.loads[i] = before.loads[origin[i]];
    contacts.kept[i] = before.kept[origin[i]];
    if (!before.faces.empty()) contacts.faces[i] = before.faces[origin[i]];
  }
}

template <int Dim>
void find_neighbours(const Model<Dim>& model, const Settings& settings, BodiesState<Dim>& bodies,
                     ContactsState<Dim>& contacts, Counters& counters) {
  // at least the gap by which a joint may open before it is bonded
  const double skin = std::max(settings.contact.skin * smallest_size(model), closed_gap(model));
  if (!outdated(model, settings, bodies, skin)) {
    if (contacts.by_body.first.empty()) list_by_body(model, contacts);  // read from a checkpoint
    return;
  }

  // lists that keep their memory: of this thread, filled by all
  static thread_local std::vector<Box<Dim>> own_boxes;
  static thread_local ThinSpans<Dim> own_spans;
  static thread_local std::vector<std::pair<int, int>> own_pairs;
  static thread_local std::vector<Contact<Dim>> own_renewed;
  static thread_local std::vector<SubContact<Dim>> own_subs;
  static thread_local std::vector<JointRise<Dim>> own_rises;
  static thread_local std::vector<int> own_origin;
  std::vector<Box<Dim>>& boxes = own_boxes;
  ThinSpans<Dim>& spans = own_spans;
  std::vector<std::pair<int, int>>& pairs = own_pairs;
  std::vector<Contact<Dim>>& renewed = own_renewed;
  std::vector<SubContact<Dim>>& renewed_subs = own_subs;
  std::vector<JointRise<Dim>>& renewed_rises = own_rises;
  std::vector<int>& origin = own_origin;  // of each pair: its index in the old list, or -1
  cache_poses(model, settings.threads, bodies);
  // either part reaches half as far as the pair; a joint that has risen is kept up to twice its rise
  const double reach = candidate_reach * skin + highest_rise(contacts);
  boxes.resize(model.parts.size());
  each_on_threads(settings.threads, boxes.size(), [&](int part) { boxes[part] = bounds(model, bodies, part, reach); });
  find_thin_spans(model, settings, bodies, reach, spans);
  std::atomic<std::size_t> count = 0;
  const std::size_t most = most_candidates(boxes.size());
  const auto wanted = [&](int a, int b) {
    if (count.load(std::memory_order_relaxed) > most || !spans.meet(a, b)) return false;
    const bool near = may_come_near(pair_of(model, bodies, a, b, QueryLevel::decision), radius_of(model, a),
                                    radius_of(model, b), reach);
    if (near) count.fetch_add(1, std::memory_order_relaxed);
    return near;
  };
  overlapping_pairs<Dim>(boxes, settings.threads, wanted, pairs);
  if (count > most) throw TooManyNeighbours(crowd_at(model, boxes, pairs));

  // continuing candidates keep their record: both lists are in ascending order
  const std::size_t stride = most_cells(model, settings.contact);
  const std::size_t places =
      std::ranges::any_of(model.properties, &JointProperties::remembers_place) ? std::max<std::size_t>(stride, 1) : 0;
  origin.assign(pairs.size(), -1);
  auto old = contacts.list.begin();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    while (old != contacts.list.end() && std::pair(old->part_a, old->part_b) < pairs[i])
      ++old;
    if (old != contacts.list.end() && std::pair(old->part_a, old->part_b) == pairs[i])
      origin[i] = static_cast<int>(old - contacts.list.begin());
  }
  renewed.resize(pairs.size());
  renewed_subs.assign(pairs.size() * stride, {});
  renewed_rises.assign(pairs.size() * places, {});
  each_on_threads(settings.threads, pairs.size(), [&](int i) {
    if (origin[i] >= 0) {
      renewed[i] = contacts.list[origin[i]];
      std::ranges::copy(subs_of(contacts, origin[i]), renewed_subs.begin() + i * static_cast<std::ptrdiff_t>(stride));
      std::ranges::copy(rises_of(contacts, origin[i]), renewed_rises.begin() + i * static_cast<std::ptrdiff_t>(places));
      return;
    }
    renewed[i] = {};
    renewed[i].part_a = pairs[i].first;
    renewed[i].part_b = pairs[i].second;
  });
  if (!contacts.kept.empty()) follow_origin(origin, contacts);
  std::swap(contacts.list, renewed);
  std::swap(contacts.subs, renewed_subs);
  std::swap(contacts.rises, renewed_rises);
  list_by_body(model, contacts);
  note_placements(bodies, bodies.listed_at);
  ++counters.neighbour_builds;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                \
  template void find_neighbours<Dim>(const Model<Dim>&, const Settings&, BodiesState<Dim>&, ContactsState<Dim>&, \
                                     Counters&);                                                                 \
  template void count_travels<Dim>(const Model<Dim>&, const Settings&, BodiesState<Dim>&);                       \
  template double closed_gap<Dim>(const Model<Dim>&);                                                            \
  template bool is_near_risen<Dim>(const Model<Dim>&, const BodiesState<Dim>&, double, Contact<Dim>&);           \
  template bool is_near<Dim>(const Model<Dim>&, const BodiesState<Dim>&, double, Contact<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
