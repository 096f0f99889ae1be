#include "app/check/judge_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "app/check/blocks.hpp"
#include "app/check/forecast.hpp"
#include "core/base/chains.hpp"
#include "core/scene/judge_values.hpp"
#include "core/step/relaxation.hpp"

namespace voussoir {
namespace {

constexpr double wide_size_ratio = 100;  // largest over smallest inscribed radius

// cannot follow gravity: fixed, driven, or restrained along all axes that it acts on
template <int Dim>
bool is_held(const Model<Dim>& model, const Body<Dim>& body) {
  if (!is_free(body)) return true;
  for (int k = 0; k < Dim; ++k)
    if (body.free_translation[k] && model.gravity[k] != 0) return false;
  return true;
}

// in water, whose buoyancy may carry it
template <int Dim>
bool is_wet(const State<Dim>& state, int body) {
  const auto acts = [&](Source source) {
    const std::vector<Load<Dim>>& loads = state.loads.by_source[source];
    return !loads.empty() && !loads[static_cast<std::size_t>(body)].force.isZero(0);
  };
  return acts(Source::water) || acts(Source::water_pressure);
}

}  // namespace

template <int Dim>
void judge_bodies(const Prepared<Dim>& prepared, const Model<Dim>& model, const State<Dim>& state,
                  std::vector<std::string>& warnings) {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  bool anything_moves = model.gravity.norm() > 0 || !model.boundary.empty() ||
                        std::any_of(prepared.stages.begin(), prepared.stages.end(),
                                    [](const StagePlan& s) { return !s.change.force.empty(); });
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    anything_moves |= body.prescribed;
    if (!moves(body)) continue;
    smallest = std::min(smallest, inscribed_radius(body));
    largest = std::max(largest, inscribed_radius(body));
    const Motion<Dim>& motion = state.bodies.motions[b];
    anything_moves |= motion.velocity.norm() > 0 || motion.angular_momentum.norm() > 0;
  }
  if (!anything_moves && state.contacts.list.empty())
    warnings.push_back("no gravity, no velocity, no force and no contact: nothing will move");
  if (largest > wide_size_ratio * smallest)
    warnings.push_back(
        fmt::format("inscribed radii of free blocks range from {:.2g} to {:.2g} m: the smallest sets the time step; "
                    "consider slicing.smallest_inscribed_radius",
                    smallest, largest));
}

template <int Dim>
void judge_ties(const Model<Dim>& model, const State<Dim>& state, std::vector<std::string>& warnings) {
  if (model.gravity.norm() == 0) return;
  Chains groups(model.bodies.size());
  for (const Contact<Dim>& contact : state.contacts.list)
    groups.tie(model.parts[contact.part_a].body, model.parts[contact.part_b].body);
  const int count = static_cast<int>(model.bodies.size());
  std::set<int> tied;
  for (int b = 0; b < count; ++b)
    if (model.bodies[b].present && is_held(model, model.bodies[b])) tied.insert(groups.find(b));
  std::map<int, std::vector<int>> untied;
  for (int b = 0; b < count; ++b)
    if (is_free(model.bodies[b]) && !tied.contains(groups.find(b))) untied[groups.find(b)].push_back(b);

  std::vector<int> alone;
  std::size_t together = 0;
  const std::vector<int>* first_group = nullptr;
  for (const auto& [root, bodies] : untied) {
    if (bodies.size() == 1) {
      if (!is_wet(state, bodies.front())) alone.push_back(bodies.front());
      continue;
    }
    together += bodies.size();
    if (!first_group || bodies.front() < first_group->front()) first_group = &bodies;
  }
  std::sort(alone.begin(), alone.end());
  if (alone.size() == 1)
    warnings.push_back(fmt::format("block {} has no neighbour: it falls at the start", name_of(model, alone.front())));
  if (alone.size() > 1)
    warnings.push_back(fmt::format("{} blocks have no neighbour, {} the first: they fall at the start", alone.size(),
                                   name_of(model, alone.front())));
  if (together > 0)
    warnings.push_back(fmt::format(
        "{} blocks, {} the first, are near one another, but no chain of neighbours connects them to a fixed one: they "
        "fall at the start; fix the blocks that should support them",
        together, name_of(model, first_group->front())));
}

template <int Dim>
void judge_last_block(const Prepared<Dim>& prepared, std::vector<std::string>& warnings) {
  const auto moves = [](const Body<Dim>& body) { return body.present && (!body.fixed || body.prescribed); };
  Model<Dim> model = prepared.model;
  bool before = std::any_of(model.bodies.begin(), model.bodies.end(), moves);
  for (const StagePlan& stage : prepared.stages) {
    const Change& change = stage.change;
    if (change.fix.empty() && change.release.empty() && change.remove.empty() && change.excavate.empty() &&
        change.move.empty())
      continue;
    model = apply(std::move(model), change);
    const bool after = std::any_of(model.bodies.begin(), model.bodies.end(), moves);
    if (before && !after)
      warnings.push_back(
          fmt::format("stage.{} {} the last free block: none is left to move; keep one, or end the run before",
                      stage.name, change.remove.empty() && change.excavate.empty() ? "fixes" : "removes"));
    before = after;
  }
}

template <int Dim>
void judge_velocities(const Prepared<Dim>& prepared, const Model<Dim>& model, std::vector<std::string>& warnings) {
  if (prepared.stages.empty()) return;
  const StagePlan& first = prepared.stages.front();
  if (!begins_relaxing(first, first.statics.value_or(prepared.settings.statics))) return;
  for (std::size_t b = 0; b < prepared.state.bodies.motions.size(); ++b) {
    const Motion<Dim>& motion = prepared.state.bodies.motions[b];
    if (!moves(model.bodies[b]) || (motion.velocity.isZero(0) && motion.angular_momentum.isZero(0))) continue;
    warnings.push_back(
        fmt::format("block {} begins with a velocity (its own, or that of initial_velocity) that is lost: stage.{} is "
                    "solved by "
                    "relaxation, which stops every block; let a stage of kind \"run\" come first, or state "
                    "stage.{}.statics = \"local\"",
                    name_of(model, static_cast<int>(b)), first.name, first.name));
    return;  // one warning is enough
  }
}

template void judge_bodies<2>(const Prepared<2>&, const Model<2>&, const State<2>&, std::vector<std::string>&);
template void judge_bodies<3>(const Prepared<3>&, const Model<3>&, const State<3>&, std::vector<std::string>&);
template void judge_ties<2>(const Model<2>&, const State<2>&, std::vector<std::string>&);
template void judge_ties<3>(const Model<3>&, const State<3>&, std::vector<std::string>&);
template void judge_last_block<2>(const Prepared<2>&, std::vector<std::string>&);
template void judge_last_block<3>(const Prepared<3>&, std::vector<std::string>&);
template void judge_velocities<2>(const Prepared<2>&, const Model<2>&, std::vector<std::string>&);
template void judge_velocities<3>(const Prepared<3>&, const Model<3>&, std::vector<std::string>&);

}  // namespace voussoir
