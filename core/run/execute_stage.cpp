#include "core/run/execute_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/implicit/implicit_step.hpp"
#include "core/run/bonds_as_sliced.hpp"
#include "core/run/failure_watch.hpp"
#include "core/run/half_error.hpp"
#include "core/run/record.hpp"
#include "core/run/trial_record.hpp"
#include "core/step/free_fall.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

template <int Dim>
bool anything_moves(const Model<Dim>& model) {
  return std::any_of(model.bodies.begin(), model.bodies.end(),
                     [](const Body<Dim>& body) { return body.present && !body.immobile(); });
}

// the result of a search, and the displayed number of a level
struct SearchedQuantity {
  const char *name, *unit, *found;
  double (*number)(double level);
};

SearchedQuantity sought_by(const ReducePlan& plan) {
  if (plan.searched == Searched::factor)
    return {"factor_of_safety", "1", "factor of safety found", [](double factor) { return factor; }};
  return {"critical_friction", "deg", "critical friction found", to_degrees};
}

template <int Dim>
void judge(const StageInForce<Dim>& stage, const RunReport& report, bool goal_reached, Results& results) {
  if (report.reason == StopReason::no_contact_answer || report.reason == StopReason::not_finite)
    fail(stage.plan(), Outcome::failed, describe(report.reason) + "; " + report.detail, results);
  else if (!goal_reached)
    fail(stage.plan(), Outcome::incomplete,
         fmt::format("no equilibrium: {} (unbalanced {:.2g}, required {:.2g}){}{}", describe(report.reason),
                     report.unbalanced, stage.settings.equilibrium.unbalanced, report.unreached,
                     and_more(report.detail)),
         results);
}

// a body without connection and without support below, before the first step of a stage that needs equilibrium
template <int Dim>
std::optional<StageOutcome> falls_from_begin(const StageInForce<Dim>& stage, const State<Dim>& state,
                                             Results& results) {
  const int body = tied_to_nothing(stage.model, state);
  if (body < 0) return {};
  fail(stage.plan(), Outcome::incomplete,
       fmt::format("no equilibrium: {} falls freely: no chain of near blocks, bolts or linings connects it to a fixed "
                   "block, and there is "
                   "nothing below it; fix the blocks that should support it",
                   label_of(stage.model, body)),
       results);
  return StageOutcome{describe(StopReason::falls_free), std::numeric_limits<double>::infinity()};
}

template <int Dim>
std::optional<StageOutcome> run_to(const StageInForce<Dim>& stage, const RunGoal& goal, const GravityPlan& gravity,
                                   StopReason wanted, const Watcher<Dim>& watcher, Progress<Dim>& progress) {
  const StagePlan& plan = stage.plan();
  const RunSchedule schedule{
      .gravity = gravity, .properties = {}, .water = plan.water, .excavation_forces = plan.excavation_forces};
  const RunReport report = run(stage.model, stage.settings, goal, schedule, progress.state, progress.run,
                               record_run(stage, goal.end_time, watcher, progress));
  if (report.reason == StopReason::interrupted) return {};
  judge(stage, report, report.reason == wanted, progress.results);
  if (report.reason == StopReason::equilibrium) note_stable(stage, progress.state, progress);
  return StageOutcome{describe(report.reason), report.unbalanced};
}

template <int Dim>
void note_begin(const StageInForce<Dim>& stage, const State<Dim>& now, Progress<Dim>& progress) {
  const StagePlan* const before = stage.place > 0 ? &stage.plan() - 1 : nullptr;
  progress.settle = settle_begin(stage.model, now, before && std::holds_alternative<RunPlan>(before->plan));
}

template <int Dim>
std::optional<StageOutcome> execute(const SettlePlan& settle, const StageInForce<Dim>& stage,
                                    const Watcher<Dim>& watcher, Progress<Dim>& progress) {
  if (!progress.run.under_way) {
    const State<Dim> now = with_forces(stage, progress.state, false);
    note_begin(stage, now, progress);
    const GravityPlan& gravity = settle.gravity;
    const bool weighs = gravity.to.value_or(gravity.ramp > 0 ? 1 : now.schedule.gravity_factor) != 0;
    if (weighs)
      if (std::optional<StageOutcome> ended = falls_from_begin(stage, now, progress.results)) return ended;
  }
  RunGoal goal;
  goal.rest = true;
  goal.time_limit = progress.stage_began + settle.time_limit;
  goal.step_limit = settle.step_limit;
  goal.bonds = stage.plan().change.bond || (stage.place == 0 && has_bonds_as_sliced(stage.model));
  return run_to(stage, goal, settle.gravity, StopReason::equilibrium, watcher, progress);
}

template <int Dim>
std::optional<StageOutcome> execute(const RunPlan& timed, const StageInForce<Dim>& stage, const Watcher<Dim>& watcher,
                                    Progress<Dim>& progress) {
  if (!progress.run.under_way) note_begin(stage, with_forces(stage, progress.state, false), progress);
  if (stage.settings.time.integration == Integration::implicit_steps)
    if (const std::string why = not_followed_implicitly(stage.model, stage.settings); !why.empty()) {
      fail(stage.plan(), Outcome::incomplete, why, progress.results);
      return StageOutcome{"a motion that implicit steps do not follow"};
    }
  if (!progress.run.under_way && stage.settings.time.half_error && !run_by_half_error(timed, stage, watcher, progress))
    return {};
  RunGoal goal;
  goal.end_time = progress.stage_began + timed.duration;
  return run_to(stage, goal, timed.gravity, StopReason::end_time, watcher, progress);
}

std::string found_by(const ReductionReport& report) {
  if (report.by == CriticalBy::required_strength) return found_by_strength;
  if (report.by == CriticalBy::stable_fit) return found_by_fit;
  return report.watched ? found_by_bracket : found_by_displacement;
}

// the value that a search has found, if any, and its message
// joints that dilated by less than stated at the level that a search has found (dilation_in_force)
template <int Dim>
void note_lowered_dilation(const StageInForce<Dim>& stage, const ReducePlan& plan, double critical, Results& results) {
  const bool factor = plan.searched == Searched::factor;
  for (const int k : chosen_properties(stage.model, plan)) {
    const JointProperties& p = stage.model.properties[k];
    if (p.laws.dilation == DilationLaw::none || p.dilation == 0) continue;
    const double drop = p.laws.friction == FrictionLaw::softening ? p.softening_drop : 0;
    // the level at which friction in force, as softening leaves it, is the dilation
    const double level =
        factor ? (std::tan(p.friction) - drop) / std::tan(p.dilation) : std::atan(std::tan(p.dilation) + drop);
    if (factor ? critical <= level : critical >= level) continue;
    results.warnings.push_back(
        fmt::format("stage {}: {} {} the friction in force of {} is less than its dilation_deg = {:.4g}; there it "
                    "dilates by that friction, as more would make energy",
                    stage.plan().name, factor ? "above a factor of" : "below",
                    factor ? fmt::format("{:.4g}", level) : fmt::format("{:.4g} deg", to_degrees(level)), p.name,
                    to_degrees(p.dilation)));
  }
}

template <int Dim>
StageOutcome judge_search(const ReducePlan& reduction, const ReductionReport& report, const StageInForce<Dim>& stage,
                          Results& results) {
  judge(stage, report.last, true, results);
  const SearchedQuantity sought = sought_by(reduction);
  if (report.bracketed) {
    const bool unique = !results.find(sought.name);
    const std::string name = unique ? sought.name : stage.plan().name + "_" + sought.name;
    Value value{sought.number(report.critical), sought.unit, sought.number(report.error_bar), report.rule};
    if (report.bracket > 0) {
      value.bracket = sought.number(report.bracket);
      value.found_by = found_by(report);
      value.bracket_middle = sought.number(0.5 * (report.stable + report.failed));
      value.turned = report.turned;
    }
    if (report.by != CriticalBy::bracket) {
      value.covers = "criterion";
      value.criterion = *value.error_bar - (report.by == CriticalBy::bracket_of_turning ? *value.bracket : 0);
    }
    if (reduction.searched == Searched::factor) value.divides = divided_by_factor(reduction.properties);
    results.values.emplace_back(name, std::move(value));
    note_lowered_dilation(stage, reduction, report.critical, results);
    for (StableState& at : results.at_last_stable_state) {
      if (at.stage != stage.plan().name) continue;
      if (report.by == CriticalBy::required_strength || report.by == CriticalBy::stable_fit)
        at.taken_out = sought.number(report.taken_out);
      at.bracket_because = report.bracket_because;
      at.followed = report.followed;
    }
  }
  const bool found = report.message.empty();
  const bool none_is_stable = !results.trials.empty() && results.trials.back().trial == 1;
  const std::string what_fails = !found && none_is_stable ? and_more(sentence_of(results.trials.back().mechanism)) : "";
  if (!found && results.outcome != Outcome::failed)
    fail(stage.plan(), Outcome::incomplete,
         (report.bracketed ? "the bracket is wider than required: " : "no bracket: ") + report.message + what_fails,
         results);
  return StageOutcome{found ? sought.found : describe(report.last.reason), report.unbalanced};
}

// Of a search the ends of its trials are recorded, detours with their number; at constant rate, with one trial for the
// stage, all rows and frames.
template <int Dim>
std::optional<StageOutcome> execute(const ReducePlan& reduction, const StageInForce<Dim>& stage,
                                    const Watcher<Dim>& watcher, Progress<Dim>& progress) {
  State<Dim>& state = progress.state;
  Results& results = progress.results;
  const bool continuous = reduction.method == ReductionMethod::rate;
  const bool begins = progress.reduction.begin.empty() && reduction.failure_fraction == 0;
  if (begins && state.schedule.gravity_factor != 0)
    if (std::optional<StageOutcome> ended = falls_from_begin(stage, with_forces(stage, state, false), results))
      return ended;
  const SearchedQuantity sought = sought_by(reduction);
  const TrialHook<Dim> on_trial = [&](const State<Dim>& moved, double level, SearchTrial outcome) {
    if (progress.reduction.leg != FollowLeg::none) return note_followed(stage, moved, progress);
    note_trial(stage, moved, sought.number(level), sought.unit, outcome, progress);
    if (continuous) return;
    const State<Dim> now = with_forces(stage, moved, outcome == SearchTrial::broken);
    const int number = progress.reduction.trial + 1;
    const bool detour = is_detour(reduction.method, progress.reduction.trial, outcome);
    results.history.rows.push_back(row_of(stage, now, progress.ends, detour ? number : 0));
    if (detour) add_trial_frame(stage, now, number, watcher, progress);
  };
  const RunHooks<Dim> hooks =
      continuous ? record_run(stage, {}, watcher, progress) : report_trials(stage, watcher, progress);
  const ReductionReport report =
      reduce(stage.model, stage.settings, reduction, state, progress.reduction, hooks, on_trial);
  if (report.last.reason == StopReason::interrupted) return {};
  return judge_search(reduction, report, stage, results);
}

}  // namespace

template <int Dim>
std::optional<StageOutcome> execute_stage(const StageInForce<Dim>& stage, const Watcher<Dim>& watcher,
                                          Progress<Dim>& progress) {
  Results& results = progress.results;
  if (results.outcome != Outcome::done) return StageOutcome{"bolts that cannot be installed"};
  if (!anything_moves(stage.model)) {
    fail(stage.plan(), Outcome::incomplete,
         "no block is free to move: this stage, or one before it, fixed or removed the last one; leave one free, or "
         "end with the stage "
         "before",
         results);
    return StageOutcome{"no block is free to move"};
  }
  try {
    return std::visit([&](const auto& plan) { return execute(plan, stage, watcher, progress); }, stage.plan().plan);
  } catch (
      const std::logic_error& error) {  // thrown by kernels for inconsistent input; errors of files have other types
    fail(stage.plan(), Outcome::failed, error.what(), results);
    return StageOutcome{error.what()};
  }
}

template std::optional<StageOutcome> execute_stage<2>(const StageInForce<2>&, const Watcher<2>&, Progress<2>&);
template std::optional<StageOutcome> execute_stage<3>(const StageInForce<3>&, const Watcher<3>&, Progress<3>&);

}  // namespace voussoir
