#include "core/run/stage_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "core/output/support_table.hpp"
#include "core/run/begin_open_sides.hpp"
#include "core/run/bonds_as_sliced.hpp"
#include "core/run/doubts.hpp"
#include "core/run/excavate.hpp"
#include "core/run/find_mechanism.hpp"
#include "core/run/half_error.hpp"
#include "core/run/history.hpp"
#include "core/run/record.hpp"
#include "core/run/stable_state.hpp"
#include "core/stage/support_table.hpp"
#include "core/step/free_fall.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/open_sides.hpp"
#include "core/step/relaxation.hpp"

namespace voussoir {
namespace {

template <int Dim>
void install_supports(const StageInForce<Dim>& stage, State<Dim>& state, Results& results) {
  const StagePlan& plan = stage.plan();
  for (const StageSupport<Dim>& row : stage_supports<Dim>)
    if (row.remove) row.remove(stage.model, state);
  for (const StageSupport<Dim>& row : stage_supports<Dim>) {
    if (!row.install) continue;
    try {
      for (const std::string& idle : row.install(stage.model, plan.change.install, state))
        results.warnings.push_back(fmt::format("stage {}: {}", plan.name, row.describe_idle(idle)));
    } catch (const std::invalid_argument& error) {  // grout that is too weak for the tightening force
      fail(plan, Outcome::failed, error.what(), results);
    }
  }
}

// candidates, time step and relief loads belong to the stage
template <int Dim>
void renew_for_stage(const Model<Dim>& model, State<Dim>& state) {
  state.bodies.listed_at.clear();
  state.time_step.frequency.clear();
  state.time_step.allowed = state.time_step.shortest = state.time_step.longest = 0;
  state.schedule.started = state.schedule.time;
  std::vector<ReliefLoad<Dim>>& relief = state.loads.relief;
  for (ReliefLoad<Dim>& load : relief)
    load.begun = load.share;
  std::erase_if(relief,
                [&](const ReliefLoad<Dim>& load) { return load.share == 0 || !model.bodies[load.body].present; });
  if (state.ledger.energy.phase == BalancePhase::running) state.ledger.energy.phase = BalancePhase::model_changed;
}

// bodies in equilibrium at another position: a later search would examine another slope than the scene's
template <int Dim>
void judge_moved(const StageInForce<Dim>& stage, const State<Dim>& now, const SettleBegin<Dim>& begin,
                 Results& results) {
  std::vector<MovedBody> moved = moved_bodies(stage.model, begin, now);
  if (moved.empty()) return;
  const bool left = std::ranges::any_of(moved, &MovedBody::left_all);
  const bool searched = std::any_of(stage.scene.stages.begin() + stage.place, stage.scene.stages.end(),
                                    [](const StagePlan& s) { return std::holds_alternative<ReducePlan>(s.plan); });
  const std::string text = moved_text(stage.model, moved);
  for (MovedBody& m : moved) {
    m.stage = stage.plan().name;
    results.moved.push_back(std::move(m));
  }
  results.warnings.push_back(fmt::format("stage {}: {}", stage.plan().name, text));
  if (left || searched)
    fail(stage.plan(), Outcome::incomplete,
         text + (searched ? "; the search that follows needs the blocks in the positions of the scene" : ""), results);
}

// The motion since the stage began, if it ended without equilibrium or with a body so far away that a search would have
// judged it failed; relative to its neighbours, so that blocks that ride on a driven one have not moved.
template <int Dim>
FailureMechanism motion_of_stage(const StageInForce<Dim>& stage, const State<Dim>& now, const Progress<Dim>& progress) {
  std::vector<Placement<Dim>> placed;
  note_accepted(stage.model, progress.state, placed);
  if (progress.settle.placed.size() != placed.size()) return {};
  const bool lost = progress.results.outcome == Outcome::incomplete;
  if (!lost && moved_bodies(stage.model, progress.settle, now).empty()) return {};
  FailureMechanism mechanism =
      find_mechanism(stage.model, progress.settle.placed, progress.settle.contacts, placed, now.contacts);
  mechanism.bonds = bonds_of_motion(progress.broken_before_stage, now);
  return mechanism;
}

template <int Dim>
StageResult result_of(const StageInForce<Dim>& stage, const StageOutcome& done, const Progress<Dim>& progress) {
  const State<Dim>& state = progress.state;
  StageResult r;
  r.name = stage.plan().name;
  r.kind = kind_of(stage.plan());
  r.ended = done.ended;
  r.relaxed = ends_relaxed(stage.plan(), stage.settings.statics);
  r.steps = state.counters.steps - progress.steps_before;
  r.time = state.schedule.time - progress.stage_began;
  r.time_step = state.time_step.longest > 0 ? state.time_step.longest : state.time_step.length;
  r.shortest_step = state.time_step.shortest;
  r.unbalanced = done.unbalanced;
  return r;
}

// Blocks that have left do not end a stage of given duration, but are probably not intended.
template <int Dim>
void warn_of_falling(const StageInForce<Dim>& stage, const State<Dim>& state, Results& results) {
  if (!std::holds_alternative<RunPlan>(stage.plan().plan)) return;
  const int body = falling_free(stage.model, state);
  if (body < 0) return;
  results.warnings.push_back(
      fmt::format("stage {}: {} falls freely, {:.3g} m from its initial position: there is nothing below",
                  stage.plan().name, label_of(stage.model, body), state.bodies.motions[body].displacement.norm()));
}

}  // namespace

template <int Dim>
void enter_stage(const Prepared<Dim>& scene, Model<Dim>& model, Settings& settings, Progress<Dim>& progress) {
  const StagePlan& plan = scene.stages[progress.stage];
  settings = settings_of(plan, scene.settings);
  settings.time.row_interval = scene.output.history_interval;
  settings.time.frame_interval = scene.output.any_frames() ? scene.output.frame_interval : 0;
  if (!progress.stage_under_way && !plan.change.excavate.empty()) {
    const Excavated<Dim> moved =
        excavate(plan.change.excavate, settings, plan.excavation_forces.has_value(), model, progress.state);
    for (StageEnd<Dim>& end : progress.ends)
      carry(moved, end);
    carry(moved, progress.bonded);
  }
  if (!progress.stage_under_way && !progress.state.loads.open_sides.plates.empty()) {
    // plates move up to the end of the stage before, whose waves end with it
    State<Dim>& state = progress.state;
    cache_poses(model, settings.threads, state.bodies);
    find_open_sides(model, state.schedule, state.bodies, state.contacts, state.loads, state.ledger);
  }
  model = apply(std::move(model), plan.change);
}

template <int Dim>
void begin_stage(const StageInForce<Dim>& stage, Progress<Dim>& progress) {
  State<Dim>& state = progress.state;
  const Change& change = stage.plan().change;
  for (const int p : properties_changed(stage.model, change)) {
    state.schedule.friction[p] = stage.model.properties[p].friction;
    if (!state.schedule.strength_factor.empty()) state.schedule.strength_factor[p] = 1;
  }
  add_bodies(stage.model, state.bodies, state.contacts, state.loads,
             state.time_step);  // bolts need the poses of all bodies
  remove_bonds(stage.model, state.contacts, state.ledger.bonds);
  install_supports(stage, state, progress.results);
  if (change.zero_slip) zero_slip(state.contacts);
  if (stage.place == 0) make_bonds_as_sliced(stage.model, stage.settings, state);
  if (change.bond)
    make_bonds(stage.model, stage.settings, state.bodies, state.contacts, state.ledger.bonds, state.counters);
  renew_for_stage(stage.model, state);
  begin_open_sides(stage, state);
  std::ranges::copy(estimated_media(stage), std::back_inserter(progress.results.warnings));
  progress.stage_began = state.schedule.time;
  progress.record = {};
  progress.record.interval = stage.scene.output.history_interval;
  progress.run = {};
  progress.settle = {};
  progress.broken_before_stage = count_bonds(state.contacts, state.ledger.bonds).broken;
  progress.reduction = {};
  progress.stage_under_way = true;
}

template <int Dim>
void end_stage(const StageInForce<Dim>& stage, const StageOutcome& done, const Watcher<Dim>& watcher,
               Progress<Dim>& progress) {
  const State<Dim>& state = progress.state;
  const StagePlan& plan = stage.plan();
  Results& results = progress.results;
  results.stages.push_back(result_of(stage, done, progress));
  results.stages.back().half_error = judge_half_error(stage.model, progress);
  progress.by_half_error.clear();
  std::ranges::copy(doubts_about(results.at_last_stable_state, plan.name), std::back_inserter(results.warnings));
  warn_of_falling(stage, state, results);
  std::ranges::copy(creep_of(stage, state), std::back_inserter(results.warnings));
  progress.steps_before = state.counters.steps;
  progress.stage_under_way = false;
  // poses of all bodies, for the monitors that measure from the end of this stage
  const auto counts = [&](const Monitor& m) { return m.since == stage.place; };
  if (std::ranges::any_of(stage.scene.monitors, counts)) progress.ends.push_back(stage_end(stage.place, state));
  const State<Dim> now = with_forces(stage, state, results.outcome == Outcome::failed);
  FailureMechanism& mechanism = results.stages.back().mechanism;
  if (results.outcome != Outcome::failed) mechanism = motion_of_stage(stage, now, progress);
  if (std::holds_alternative<SettlePlan>(plan.plan) && results.outcome == Outcome::done)
    judge_moved(stage, now, progress.settle, results);
  if (results.outcome == Outcome::incomplete) results.message += and_more(sentence_of(mechanism));
  finish_rows(stage, now, progress);
  for (const OutputSupport<Dim>& row : output_supports<Dim>)
    if (row.add_rows) row.add_rows(stage.model, now, stage.place + 1, results);
  add_frame(stage, now, watcher, progress);
  report_progress(stage, state, done.ended, done.unbalanced, 1, watcher);
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                               \
  template void enter_stage<Dim>(const Prepared<Dim>&, Model<Dim>&, Settings&, Progress<Dim>&); \
  template void begin_stage<Dim>(const StageInForce<Dim>&, Progress<Dim>&);                     \
  template void end_stage<Dim>(const StageInForce<Dim>&, const StageOutcome&, const Watcher<Dim>&, Progress<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
