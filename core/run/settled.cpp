#include "core/run/settled.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "core/run/failure_watch.hpp"
#include "core/run/run.hpp"
#include "core/step/support_table.hpp"

namespace voussoir {
namespace {

// Of the smaller inscribed radius: smaller gaps are rounding errors of coordinates, between faces that should touch.
constexpr double closed_gap_fraction = 1e-6;

template <int Dim>
bool touches(const Model<Dim>& model, const Contact<Dim>& c) {
  if (c.status != ContactStatus::separated) return c.status != ContactStatus::apart;
  const double size = std::min(model.polytope(c.part_a).inscribed_radius, model.polytope(c.part_b).inscribed_radius);
  return c.proof.kind != ProofKind::none && c.proof.kind != ProofKind::least_point &&
         c.proof.margin <= closed_gap_fraction * size;
}

// present closure of a pair of bodies, m, from the first to the second
template <int Dim>
using Closures = std::map<std::pair<int, int>, Vector<Dim>>;

template <int Dim>
Closures<Dim> closures_of(const Model<Dim>& model, const State<Dim>& state) {
  Closures<Dim> closures;
  for (const Contact<Dim>& c : state.contacts.list) {
    if (!c.touching()) continue;
    int a = model.parts[c.part_a].body, b = model.parts[c.part_b].body;
    Vector<Dim> closure = c.geometry.overlap * c.geometry.normal;
    if (a > b) {
      std::swap(a, b);
      closure = -closure;
    }
    Vector<Dim>& deepest = closures.try_emplace({a, b}, Vector<Dim>::Zero()).first->second;
    if (closure.norm() > deepest.norm()) deepest = closure;
  }
  return closures;
}

template <int Dim>
struct Settling {
  const Model<Dim>& model;
  const SettleBegin<Dim>& begin;
  const State<Dim>& now;
  Closures<Dim> closures = closures_of(model, now);
  std::vector<std::vector<int>> near{};  // by body
  std::vector<char> stays{};             // by body

  // m: displacement of a body's centroid in another's frame
  double against(int body, int other) const {
    const Placement<Dim>&was = begin.placed[body], &seat = begin.placed[other];
    const Motion<Dim>&is = now.bodies.motions[body], &frame = now.bodies.motions[other];
    const Vector<Dim> arm =
        (model.bodies[body].reference - model.bodies[other].reference) + (was.displacement - seat.displacement);
    const Matrix<Dim> turn = matrix(frame.rotation) * matrix(seat.rotation).transpose();
    Vector<Dim> moved =
        (is.displacement - was.displacement) - (frame.displacement - seat.displacement) - (turn * arm - arm);
    if (const auto found = closures.find(std::minmax(body, other)); found != closures.end()) {
      const Vector<Dim> closure = body < other ? found->second : Vector<Dim>(-found->second);
      const double depth = closure.norm(), closer = depth > 0 ? moved.dot(closure) / depth : 0;
      if (closer > 0) moved -= std::min(closer, depth) / depth * closure;
    }
    return moved.norm();
  }

  // m: by which a body has left its place
  double far(int body) const { return failure_fraction_of_radius * inscribed_radius(model.bodies[body]); }

  bool counts(int body) const { return model.bodies[body].present && !model.bodies[body].parts.empty(); }

  void find_near() {
    near.resize(model.bodies.size());
    for (const NearBodies& pair : begin.near) {
      near[pair.a].push_back(pair.b);
      near[pair.b].push_back(pair.a);
    }
  }

  // starting from held or driven bodies, or else the heaviest
  void find_what_stays() {
    const int count = static_cast<int>(model.bodies.size());
    stays.assign(model.bodies.size(), false);
    std::vector<int> found;
    for (int b = 0; b < count; ++b)
      if (counts(b) && (model.bodies[b].fixed || model.bodies[b].prescribed)) found.push_back(b);
    if (found.empty())
      found.push_back(
          static_cast<int>(std::ranges::max_element(model.bodies, {}, &Body<Dim>::mass) - model.bodies.begin()));
    for (const int b : found)
      stays[b] = true;
    for (std::size_t k = 0; k < found.size(); ++k)
      for (const int b : near[found[k]]) {
        if (stays[b] || !counts(b) || against(b, found[k]) > far(b)) continue;
        stays[b] = true;
        found.push_back(b);
      }
  }

  // whether it has left all bodies that it touched, if any, and no bolt holds it
  bool has_left_all(int body) const {
    for (const StepSupport<Dim>& row : step_supports<Dim>)
      if (row.hangs && row.hangs(now.supports, body)) return false;
    bool touched = false;
    for (const NearBodies& pair : begin.near) {
      if (!pair.touched || (pair.a != body && pair.b != body)) continue;
      if (closures.contains({pair.a, pair.b})) return false;
      touched = true;
    }
    return touched;
  }

  MovedBody moved(int body) const {
    MovedBody m;
    m.body = body;
    m.name = model.bodies[body].name;
    m.inscribed_radius = voussoir::inscribed_radius(model.bodies[body]);
    m.distance = std::numeric_limits<double>::infinity();
    for (const int other : near[body])
      if (stays[other] && against(body, other) < m.distance) {
        m.distance = against(body, other);
        m.against = other;
      }
    // it was on a body that has moved, or on nothing
    if (m.against < 0) m.distance = (now.bodies.motions[body].displacement - begin.placed[body].displacement).norm();
    const Vector<Dim> place = model.origin + model.bodies[body].reference + now.bodies.motions[body].displacement;
    m.place.assign(place.data(), place.data() + Dim);
    m.left_all = has_left_all(body);
    return m;
  }
};

}  // namespace

template <int Dim>
SettleBegin<Dim> settle_begin(const Model<Dim>& model, const State<Dim>& state, bool moving) {
  SettleBegin<Dim> begin;
  note_placements(state.bodies, begin.placed);
  std::map<std::pair<int, int>, bool> near;
  for (const Contact<Dim>& c : state.contacts.list)
    if (c.status != ContactStatus::apart)
      near[std::minmax(model.parts[c.part_a].body, model.parts[c.part_b].body)] |= !moving && touches(model, c);
  std::ranges::copy_if(state.contacts.list, std::back_inserter(begin.contacts.list), &Contact<Dim>::touching);
  for (const auto& [pair, touched] : near)
    begin.near.push_back({pair.first, pair.second, touched});
  return begin;
}

template <int Dim>
std::vector<MovedBody> moved_bodies(const Model<Dim>& model, const SettleBegin<Dim>& begin, const State<Dim>& now) {
  Settling<Dim> settling{.model = model, .begin = begin, .now = now};
  settling.find_near();
  settling.find_what_stays();
  std::vector<MovedBody> all;
  for (int b = 0; b < static_cast<int>(begin.placed.size()); ++b) {
    if (!settling.counts(b) || settling.stays[b]) continue;
    MovedBody moved = settling.moved(b);
    if (moved.distance > settling.far(b)) all.push_back(std::move(moved));
  }
  std::ranges::stable_sort(all, std::ranges::greater{}, &MovedBody::distance);
  return all;
}

template <int Dim>
std::string moved_text(const Model<Dim>& model, const std::vector<MovedBody>& moved) {
  const auto left = std::ranges::find_if(moved, &MovedBody::left_all);
  const MovedBody& worst = left == moved.end() ? moved.front() : *left;
  std::string text = fmt::format(
      "{} moved by {:.3g} m while settling, more than {:.2g} times its inscribed radius of {:.3g} m{}, and reached "
      "equilibrium at ({:.4g})",
      label_of(model, worst.body), worst.distance, failure_fraction_of_radius, worst.inscribed_radius,
      worst.left_all ? ", lost every contact that it had" : "", fmt::join(worst.place, ", "));
  if (moved.size() > 1) text += fmt::format("; so did {} more (results.json, moved)", moved.size() - 1);
  return text;
}

template std::string moved_text<2>(const Model<2>&, const std::vector<MovedBody>&);
template std::string moved_text<3>(const Model<3>&, const std::vector<MovedBody>&);
template SettleBegin<2> settle_begin<2>(const Model<2>&, const State<2>&, bool);
template SettleBegin<3> settle_begin<3>(const Model<3>&, const State<3>&, bool);
template std::vector<MovedBody> moved_bodies<2>(const Model<2>&, const SettleBegin<2>&, const State<2>&);
template std::vector<MovedBody> moved_bodies<3>(const Model<3>&, const SettleBegin<3>&, const State<3>&);

}  // namespace voussoir
