#include "core/step/free_fall.hpp"
#include "core/step/support_table.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "core/base/chains.hpp"

namespace voussoir {
namespace {

// widths of the model: no stage waits for a body to come back from this distance
constexpr double lost = 1e3;

// diagonal of the box around all bodies in their initial positions
template <int Dim>
double width_of(const Model<Dim>& model) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vector<Dim> low = Vector<Dim>::Constant(infinity), high = -low;
  for (const Body<Dim>& body : model.bodies) {
    low = low.cwiseMin(body.reference - Vector<Dim>::Constant(body.radius));
    high = high.cwiseMax(body.reference + Vector<Dim>::Constant(body.radius));
  }
  return (high - low).norm();
}

template <int Dim>
bool all_directions_free(const Body<Dim>& body) {
  return body.present && !body.fixed && !body.prescribed &&
         std::all_of(body.free_translation.begin(), body.free_translation.end(), [](bool free) { return free; });
}

// loads that act on a body at any position
constexpr bool follows_body(Source source) {
  return source == Source::gravity || source == Source::boundary_stress || source == Source::applied_forces ||
         source == Source::excavation_forces;
}

// N, by body: of the loads that follow it, if nothing else exerts a force on it and it is free in all directions; else
// 0
template <int Dim>
std::vector<Vector<Dim>> pulls(const Model<Dim>& model, const State<Dim>& state) {
  std::vector<Vector<Dim>> pull;
  std::vector<bool> alone;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    pull.push_back(weight(model, state.schedule, b));
    alone.push_back(all_directions_free(model.bodies[b]));
  }
  for (std::size_t i = 0; i < state.contacts.loads.size(); ++i) {
    const ContactLoad<Dim>& contact = state.contacts.loads[i];
    if (contact.second < 0 || contact.force.isZero(0)) continue;
    alone[contact.second] = alone[model.parts[state.contacts.list[i].part_a].body] = false;
  }
  for (const SourceRow& row : std::span(source_table).first(load_count)) {
    if (row.motion < 0 || row.source == Source::gravity) continue;
    const std::vector<Load<Dim>>& loads = state.loads.by_source[row.source];
    for (std::size_t b = 0; b < loads.size(); ++b) {
      if (follows_body(row.source))
        pull[b] += loads[b].force;
      else if (!loads[b].force.isZero(0))
        alone[b] = false;
    }
  }
  for (std::size_t b = 0; b < pull.size(); ++b)
    if (!alone[b]) pull[b].setZero();
  return pull;
}

// the bodies connected by near pairs and supports
template <int Dim>
Chains chains_of(const Model<Dim>& model, const State<Dim>& state) {
  Chains chains(model.bodies.size());
  for (const Contact<Dim>& contact : state.contacts.list)
    chains.tie(model.parts[contact.part_a].body, model.parts[contact.part_b].body);
  for (const StepSupport<Dim>& row : step_supports<Dim>)
    row.tie(model, state.supports, [&](int a, int b) { chains.tie(a, b); });
  return chains;
}

// whether a body that falls along `ahead` might meet the other: by the spheres around them, with a margin
template <int Dim>
bool lies_below(const Model<Dim>& model, const State<Dim>& state, const Vector<Dim>& ahead, int falling, int other) {
  const Body<Dim>&first = model.bodies[falling], &second = model.bodies[other];
  const Vector<Dim> way = (second.reference - first.reference) +
                          (state.bodies.motions[other].displacement - state.bodies.motions[falling].displacement);
  const double along = way.dot(ahead);
  return along + second.radius > -first.radius && (way - along * ahead).norm() < 2 * first.radius + second.radius;
}

}  // namespace

template <int Dim>
int falling_free(const Model<Dim>& model, const State<Dim>& state) {
  if (!model.prescribed.empty()) return -1;
  const std::vector<Vector<Dim>> pull = pulls(model, state);
  const double width = width_of(model);
  const int count = static_cast<int>(model.bodies.size());
  std::vector<bool> away;
  for (int b = 0; b < count; ++b)
    away.push_back(!pull[b].isZero(0) && state.bodies.motions[b].displacement.norm() > width);
  const auto may_be_caught = [&](int b) {
    const Vector<Dim> ahead = pull[b].normalized();
    for (int other = 0; other < count; ++other)
      if (model.bodies[other].present && !away[other] && lies_below(model, state, ahead, b, other)) return true;
    return false;
  };
  for (int b = 0; b < count; ++b) {
    if (!away[b]) continue;
    const Motion<Dim>& motion = state.bodies.motions[b];
    if (motion.displacement.norm() > lost * width) return b;
    if (motion.velocity.dot(motion.displacement) >= 0 && !may_be_caught(b)) return b;
  }
  return -1;
}

template <int Dim>
int tied_to_nothing(const Model<Dim>& model, const State<Dim>& state) {
  if (model.gravity.isZero(0) || !model.waters.empty() || !model.prescribed.empty()) return -1;
  const int count = static_cast<int>(model.bodies.size());
  Chains chains = chains_of(model, state);
  const auto other_load = [&](int b) {
    return std::ranges::any_of(source_table, [&](const SourceRow& row) {
      const bool may_hold = follows_body(row.source) && row.source != Source::gravity;
      return may_hold && !state.loads.by_source[row.source].empty() &&
             !state.loads.by_source[row.source][b].force.isZero(0);
    });
  };
  const auto moves = [&](int b) {
    return !state.bodies.motions[b].velocity.isZero(0) || !state.bodies.motions[b].angular_momentum.isZero(0);
  };
  std::vector<bool> falls(count, true);  // by chain
  for (int b = 0; b < count; ++b)
    if (model.bodies[b].present && (!all_directions_free(model.bodies[b]) || other_load(b) || moves(b)))
      falls[chains.find(b)] = false;
  // a caught chain may catch others, a falling one catches nothing
  const Vector<Dim> ahead = model.gravity.normalized();
  const auto is_caught = [&](int b) {
    for (int other = 0; other < count; ++other)
      if (model.bodies[other].present && !falls[chains.find(other)] && lies_below(model, state, ahead, b, other))
        return true;
    return false;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (int b = 0; b < count; ++b) {
      if (!model.bodies[b].present || !falls[chains.find(b)] || !is_caught(b)) continue;
      falls[chains.find(b)] = false;
      changed = true;
    }
  }
  for (int b = 0; b < count; ++b)
    if (model.bodies[b].present && falls[chains.find(b)]) return b;
  return -1;
}

template <int Dim>
int fastest(const Model<Dim>& model, const State<Dim>& state) {
  int found = -1;
  double most = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    if (!body.present || body.fixed) continue;
    const Motion<Dim>& motion = state.bodies.motions[b];
    const double speed = motion.velocity.norm() + body.radius * angular_velocity(body, motion).norm();
    if (!(speed > most)) continue;
    most = speed;
    found = static_cast<int>(b);
  }
  return found;
}

template int falling_free<2>(const Model<2>&, const State<2>&);
template int falling_free<3>(const Model<3>&, const State<3>&);
template int tied_to_nothing<2>(const Model<2>&, const State<2>&);
template int tied_to_nothing<3>(const Model<3>&, const State<3>&);
template int fastest<2>(const Model<2>&, const State<2>&);
template int fastest<3>(const Model<3>&, const State<3>&);

}  // namespace voussoir
