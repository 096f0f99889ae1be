#include "core/run/trial_record.hpp"

#include "core/run/search_levels.hpp"
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

}  // namespace

template <int Dim>
void note_trial(const StageInForce<Dim>& stage, const State<Dim>& state, double level, const char* unit,
                SearchTrial outcome, Progress<Dim>& progress) {
  const ReductionProgress<Dim>& search = progress.reduction;
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
               .displacement = moving.farthest};
  if (moving.most_of > 0) row.elastic_displacements = moving.farthest / moving.most_of;
  if (watched && outcome == SearchTrial::failed)
    row.required = required_level(std::get<ReducePlan>(stage.plan().plan), search.watch.trial);
  progress.results.trials.push_back(std::move(row));
}

template void note_trial<2>(const StageInForce<2>&, const State<2>&, double, const char*, SearchTrial, Progress<2>&);
template void note_trial<3>(const StageInForce<3>&, const State<3>&, double, const char*, SearchTrial, Progress<3>&);

}  // namespace voussoir
