#include "core/run/trial_record.hpp"

#include <algorithm>

#include "core/output/bolt_output.hpp"
#include "core/run/find_mechanism.hpp"
#include "core/run/record.hpp"
#include "core/run/search_levels.hpp"
#include "core/step.hpp"
#include "core/step/bolt_forces.hpp"
#include "core/step/joint_forces.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// the level, in its unit, that the motion of a watched trial required; nothing if it required less than no strength
template <int Dim>
std::optional<double> required_level(const ReducePlan& plan, const TrialWatch<Dim>& trial) {
  if (trial.required.empty() || !(trial.required.back().strength > 0)) return {};
  const Levels levels = levels_of(plan);
  return levels.level_of(trial.required.back().strength) / levels.unit;
}

// the state with its bodies at these places and the forces there
template <int Dim>
State<Dim> forces_at(const StageInForce<Dim>& stage, const std::vector<Placement<Dim>>& placed, State<Dim> state) {
  for (std::size_t b = 0; b < placed.size(); ++b) {
    state.bodies.motions[b].displacement = placed[b].displacement;
    state.bodies.motions[b].rotation = placed[b].rotation;
  }
  find_forces(stage.model, stage.settings, state);
  return state;
}

// N, by body; empty without water
template <int Dim>
std::vector<double> forces_of_water(const LoadsState<Dim>& loads) {
  std::vector<Vector<Dim>> sum;
  for (const Source source : {Source::water, Source::water_pressure}) {
    const std::vector<Load<Dim>>& of_source = loads.by_source[source];
    if (sum.size() < of_source.size()) sum.resize(of_source.size(), Vector<Dim>::Zero());
    for (std::size_t b = 0; b < of_source.size(); ++b)
      sum[b] += of_source[b].force;
  }
  std::vector<double> sizes;
  for (const Vector<Dim>& force : sum)
    sizes.push_back(force.norm());
  return sizes;
}

// what supports and water do at the trial's end; of its first trial a search keeps the water's forces
template <int Dim>
void note_supports_and_water(const StageInForce<Dim>& stage, const State<Dim>& now, ReductionProgress<Dim>& search,
                             TrialRow& row) {
  if (const std::optional<double> turned = most_turned(stage.model, now.bodies, now.supports)) {
    row.bolts_turned = to_degrees(*turned);
    row.bolts_use = largest_bolt_use(stage.model, now);
  }
  const std::vector<double> water = forces_of_water(now.loads);
  if (search.trial == 0) search.water = water;
  if (row.body >= 0 && !search.water.empty() && search.water[row.body] > 0)
    row.water_lost = 1 - (water.empty() ? 0 : water[row.body]) / search.water[row.body];
}

// from the last stable state, or from where the search began, to bodies at these places with these forces
template <int Dim>
FailureMechanism mechanism_of(const Model<Dim>& model, const Progress<Dim>& progress,
                              const std::vector<Placement<Dim>>& placed, const State<Dim>& now) {
  const State<Dim>& base = progress.reduction.base;
  const bool has_base = base.bodies.motions.size() == placed.size();
  std::vector<Placement<Dim>> from = progress.reduction.begun;
  if (has_base) note_placements(base.bodies, from);
  FailureMechanism mechanism = find_mechanism(model, from, base.contacts, placed, now.contacts);
  mechanism.bonds = bonds_of_motion(
      has_base ? count_bonds(base.contacts, base.ledger.bonds).broken : progress.broken_before_stage, now);
  return mechanism;
}

}  // namespace

template <int Dim>
void note_trial(const StageInForce<Dim>& stage, const State<Dim>& state, double level, const char* unit,
                SearchTrial outcome, Progress<Dim>& progress) {
  ReductionProgress<Dim>& search = progress.reduction;
  const WatchPlan& plan = search.watch.plan;
  std::vector<Placement<Dim>> placed;
  note_accepted(stage.model, state, placed);
  const bool watched = !plan.elastic.empty();
  const std::vector<double>& elastic = watched ? plan.elastic : std::vector<double>(placed.size(), 0.0);
  const MovingBodies moving = moving_bodies(stage.model, search.begin, placed, elastic);
  TrialRow row{.stage = stage.place + 1,
               .trial = search.trial + 1,
               .level = level,
               .unit = unit,
               .outcome = outcome_of(outcome),
               .body = moving.body,
               .name = moving.body < 0 ? "" : stage.model.bodies[moving.body].name,
               .displacement = moving.farthest};
  if (moving.most_of > 0) row.elastic_displacements = moving.farthest / moving.most_of;
  if (watched && outcome == SearchTrial::failed)
    row.required = required_level(std::get<ReducePlan>(stage.plan().plan), search.watch.trial);
  const bool held_or_wet = !state.supports.bolt_springs.empty() || !stage.model.waters.empty();
  if (outcome != SearchTrial::broken && (held_or_wet || outcome == SearchTrial::failed)) {
    const State<Dim> now = forces_at(stage, placed, state);
    if (held_or_wet) note_supports_and_water(stage, now, search, row);
    if (outcome == SearchTrial::failed) row.mechanism = mechanism_of(stage.model, progress, placed, now);
  }
  if (outcome == SearchTrial::stable) note_stable(stage, state, progress, row);
  if (outcome == SearchTrial::failed)
    for (StableState& at : progress.results.at_last_stable_state)
      if (at.stage == stage.plan().name) at.failed = row;
  progress.results.trials.push_back(std::move(row));
}

template <int Dim>
void note_followed(const StageInForce<Dim>& stage, const State<Dim>& state, Progress<Dim>& progress) {
  const ReductionProgress<Dim>& search = progress.reduction;
  std::vector<Placement<Dim>> placed;
  note_accepted(stage.model, state, placed);
  if (farthest_since(stage.model, displacements(search.base.bodies), placed) < search.failed_way) return;
  const FailureMechanism mechanism = mechanism_of(stage.model, progress, placed, forces_at(stage, placed, state));
  for (StableState& at : progress.results.at_last_stable_state) {
    if (at.stage != stage.plan().name || !at.failed) continue;
    at.failed->mechanism = mechanism;
    for (TrialRow& row : progress.results.trials)
      if (row.stage == at.failed->stage && row.trial == at.failed->trial) row.mechanism = mechanism;
  }
}

template void note_trial<2>(const StageInForce<2>&, const State<2>&, double, const char*, SearchTrial, Progress<2>&);
template void note_trial<3>(const StageInForce<3>&, const State<3>&, double, const char*, SearchTrial, Progress<3>&);
template void note_followed<2>(const StageInForce<2>&, const State<2>&, Progress<2>&);
template void note_followed<3>(const StageInForce<3>&, const State<3>&, Progress<3>&);

}  // namespace voussoir
