#include "core/run/reduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/output/bolt_output.hpp"
#include "core/run/search_levels.hpp"
#include "core/run/search_rules.hpp"
#include "core/step/bolt_forces.hpp"
#include "core/step/relaxation.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// the bias of a constant rate is proportional to this power of it (cases/incline/README.md)
constexpr double bias_power = 2.0 / 3;

// two rates: the slower reduction starts this many lags of the faster above its failure; one would be enough on a plane
constexpr double nearer_by_lags = 1.5;

// A trial's steps are divided into rounds, as fractions of the step limit: relaxation has 20,000 steps by default,
// enough for the equilibrium of a column of 1,000 blocks, then true motion 100,000, then relaxation again, each from
// zero velocity. Relaxation is slow if a slope slides far before equilibrium, because damped vibrations slow the slide;
// true motion is slow at the end, because local damping does not act on a slide with nearly balanced forces.
constexpr long long relaxation_round = 50, motion_round = 10;

// 1.25 times Richardson's estimate bounds the error of the slower rate (Roache's grid convergence index, order known),
// so a quarter of the estimate bounds the error of the extrapolation
constexpr double extrapolation_margin = 0.25;

// Divides strength away: what is left of it is below rounding of the loads that it would balance.
constexpr double factor_without_strength = 1e9;

// A failed trial is followed to so many times the way at which it was judged: blocks that it frees move, and those
// that slip a little on their way to rest are left behind.
constexpr double followed_ways = 10;

// Brackets between a failed level and the base that it was tried from, beyond which it is tried once more.
constexpr double far_base = 4;

// A trial: equilibrium is sought at a level, or the friction is reduced at constant rate from the last stable angle to
// this one.
struct Attempt {
  int number = 0;          // of the trial, from 0
  double target = 0;       // level, rad or 1
  bool from_base = false;  // it begins at the last stable state, not at the end of the previous trial
  bool falls = false;
  double rate = 0;      // rad/s, of a reduction
  bool beside = false;  // a question beside the search: neither its bracket nor its records know the trial
  FollowLeg leg = FollowLeg::none;
};

// The search methods are at the end, each in one place. A method runs its trials by number, so that an interrupted
// search, called again with its progress, continues in the trial that was under way.
template <int Dim>
struct Search {
  const Model<Dim>& model;
  const Settings& settings;
  const ReducePlan& plan;
  const RunHooks<Dim>& hooks;
  const TrialHook<Dim>& on_trial;
  State<Dim>& state;
  ReductionProgress<Dim>& progress;
  std::vector<int> properties;
  double failure_displacement;  // m
  Levels levels;
  ReductionReport report;

  // ---- one trial ----------------------------------------------------------------------------------------------------

  // the counters of work since then are kept
  void go_back_to_base() {
    const Counters spent = state.counters;
    state = progress.base;
    state.counters = spent;
  }

  void begin(const Attempt& attempt) {
    if (attempt.from_base) go_back_to_base();
    progress.trial = attempt.number;
    progress.true_motion = false;
    progress.trial_steps = 0;
    progress.run.begin = attempt.falls                  ? std::vector<Vector<Dim>>{}
                         : attempt.leg == FollowLeg::on ? displacements(progress.base.bodies)
                                                        : progress.begin;
    if (watches()) begin_watch(state, attempt.target, progress.watch);
    progress.target = attempt.target;
    state.schedule.started = state.schedule.time;
    if (attempt.falls) {
      progress.level_from = progress.stable;
      progress.level_rate = attempt.rate;
      progress.time_limit = state.schedule.time + (progress.stable - attempt.target) / attempt.rate;
      return;
    }
    // strength is reduced gradually to the trial's level: a sudden change would set the model in motion, and slip due
    // to inertia would destroy the shear locked in during settlement
    progress.level_from = level_now();
    progress.level_rate = 0;
    const double ramp = static_cast<double>(plan.ramp_steps) * state.time_step.length;
    const double fall = levels.direction * (progress.target - progress.level_from);
    if (fall > 0 && ramp > 0)
      progress.level_rate = fall / ramp;
    else
      set_strength(model, plan.searched, properties, progress.target, state.schedule);
  }

  // ---- the strength that a motion requires --------------------------------------------------------------------------

  bool watches() const { return !progress.watch.plan.elastic.empty(); }
  // m: of the body that moved most, to the last trial that the static solver accepted
  double way_since(const std::vector<Vector<Dim>>& began) const {
    std::vector<Placement<Dim>> placed;
    note_accepted(model, state, placed);
    return farthest_since(model, began, placed);
  }
  bool judges(const Attempt& attempt) const { return attempt.leg == FollowLeg::none; }

  // a trial that has ended, as part of what is known of the critical strength
  void note_trial(double level, SearchTrial outcome) {
    if (watches() && outcome == SearchTrial::stable)
      note_stable_trial(model, state, progress.begin, progress.watch.plan, levels.strength(level), progress.known);
    if (watches() && outcome == SearchTrial::failed)
      note_failed_trial(progress.watch.trial, levels.strength(level), progress.known);
  }

  // Newton's method: the failed end was found from a base far from it, whose chord of slip may have failed it
  bool doubts_failed() const {
    return watches() && settings.statics.method == Statics::newton &&
           std::abs(progress.failed - progress.failed_from) > far_base * bracket();
  }
  double level_now() const { return level_in_force(plan.searched, properties, state.schedule); }

  // relaxation and true motion alternate
  bool relaxes_first(const Attempt& attempt) const { return relaxes(!attempt.falls, settings.statics); }
  long long round() const {
    return std::max(1LL, plan.step_limit / (progress.true_motion ? motion_round : relaxation_round));
  }

  long long step_limit(const Attempt& attempt) const {
    if (attempt.leg == FollowLeg::on) return std::max(progress.searched_steps, 1LL);
    return attempt.leg == FollowLeg::to_rest ? plan.follow_steps : plan.step_limit;
  }

  // true: the trial continues by the other of the two
  bool takes_turn(const Attempt& attempt) {
    if (report.last.reason != StopReason::interrupted) progress.trial_steps += report.last.steps;
    if (!relaxes_first(attempt) || report.last.reason != StopReason::step_limit ||
        progress.trial_steps >= step_limit(attempt))
      return false;
    progress.true_motion = !progress.true_motion;
    return true;
  }

  SearchTrial run_turn(const Attempt& attempt) {
    RunGoal goal;
    goal.rest = !attempt.falls;
    if (attempt.leg == FollowLeg::on)
      goal.moved_away = followed_ways * progress.failed_way;
    else if (judges(attempt) && !watches())
      goal.moved_away = failure_displacement;
    goal.moved_fraction = plan.failure_fraction;
    goal.step_limit = step_limit(attempt) - progress.trial_steps;
    if (relaxes_first(attempt)) goal.step_limit = std::min(*goal.step_limit, round());
    if (attempt.falls) goal.time_limit = progress.time_limit;
    const RunSchedule schedule{.searched = plan.searched,
                               .strength_rate = progress.level_rate,
                               .strength_from = progress.level_from,
                               .strength_to = progress.target,
                               .properties = properties};
    Settings own = settings;
    if (progress.true_motion) own.statics.method = Statics::local;
    own.statics.refuses_growth = true;
    report.last = run(model, own, goal, schedule, state, progress.run, hooks,
                      watches() && judges(attempt) ? &progress.watch : nullptr);
    report.unbalanced = report.last.unbalanced;
    return trial_of(report.last.reason);
  }

  // the level that the trial has reached
  double level_of(const Attempt& attempt) const { return attempt.falls ? level_now() : attempt.target; }

  // nothing: interrupted, or a numerical failure
  std::optional<SearchTrial> carry_out(const Attempt& attempt) {
    if (!progress.run.under_way) begin(attempt);
    SearchTrial outcome = run_turn(attempt);
    while (takes_turn(attempt))
      outcome = run_turn(attempt);
    if (report.last.reason == StopReason::interrupted) return {};
    if (on_trial && (!attempt.beside || attempt.leg == FollowLeg::on)) on_trial(state, level_of(attempt), outcome);
    if (outcome != SearchTrial::broken) return outcome;
    report.message = report.last.detail;
    return {};
  }

  // Stable or failed, and the bracket is updated; nothing: the search is over.
  std::optional<SearchTrial> decide(const Attempt& attempt) {
    const std::optional<SearchTrial> outcome = carry_out(attempt);
    if (!outcome) return {};
    const double level = level_of(attempt);
    note_trial(level, *outcome);
    progress.searched_steps += progress.trial_steps;
    if (outcome == SearchTrial::undecided) {
      if (plan.method == ReductionMethod::bisection && attempt.number > 1 && !progress.avoids) {
        progress.avoids = true;
        progress.undecided = level;
        return outcome;
      }
      give_up_undecided(attempt, level);
      return {};
    }
    if (outcome == SearchTrial::failed && attempt.number == 0) {
      report.message = fmt::format("fails already at from_{} = {:.6g}: start {}", levels.name,
                                   levels.from / levels.unit, levels.start);
      return {};
    }
    if (outcome == SearchTrial::failed) {
      progress.failed = level;
      progress.failed_from = progress.stable;
      if (watches()) progress.failed_way = way_since(displacements(progress.base.bodies));
      return outcome;
    }
    // a failed level that is stable from a nearer base: the bracket opens beyond it, to a level to be tried like it
    if (watches() && attempt.number > 1 && levels.direction * (level - progress.failed) >= 0)
      progress.failed = levels.safer(level + 2 * levels.direction * std::max(bracket(), levels.tolerance), levels.to);
    progress.stable = level;
    progress.unbalanced = report.last.unbalanced;
    if (plan.method != ReductionMethod::rate) progress.base = state;
    if (attempt.number == 0 || level != levels.to) return outcome;
    report.message = still_stable();
    return {};
  }
  std::string still_stable() const {
    return fmt::format("still stable at to_{} = {:.6g}: end {}", levels.name, levels.to / levels.unit, levels.end);
  }

  std::optional<SearchTrial> rest_at(int number, double level, bool from_base = false) {
    return decide({.number = number, .target = level, .from_base = from_base});
  }
  std::optional<SearchTrial> fall(int number, double rate) {
    return decide({.number = number, .target = plan.to, .falls = true, .rate = rate});
  }

  // ---- the end of a search ------------------------------------------------------------------------------------------

  void close(double critical, double error_bar) {
    report.bracketed = true;
    report.critical = critical;
    report.error_bar = error_bar;
  }
  Bracket ends() const { return {progress.stable, progress.failed}; }
  double bracket() const { return levels.direction * (progress.failed - progress.stable); }
  bool is_closed() const {
    return is_certified(levels, ends(), progress.known) || (bracket() <= levels.tolerance && !doubts_failed());
  }
  void close_bracket() {
    go_back_to_base();
    report.unbalanced = progress.unbalanced;
    report.bracket = 0.5 * bracket();
    const CriticalLevel critical = critical_level(levels, ends(), progress.known);
    report.by = critical.by;
    report.taken_out = critical.taken_out;
    report.bracket_because = watches() ? critical.bracket_because : why_not_watched();
    close(critical.level, critical.error_bar);
  }

  // the result of a search after an undecided trial
  void give_up_undecided(const Attempt& attempt, double level) {
    if (attempt.falls) {
      report.message = fmt::format("no failure {} to {} ({}), stable at {}", levels.towards, levels.text(level),
                                   describe(report.last.reason), levels.text(progress.stable));
      return;
    }
    report.message = fmt::format("neither equilibrium nor failure at {} within {} steps (unbalanced {:.2g}){}: {}",
                                 levels.text(level), progress.trial_steps, report.last.unbalanced,
                                 report.last.unreached, farthest_mover(model, state, progress.begin, [&](int b) {
                                   return watches() ? progress.watch.plan.moved_away[b] : failure_displacement;
                                 }));
    if (attempt.number == 0) {
      report.message += fmt::format("; neither a stable nor a failed {} is known", levels.one);
      return;
    }
    report.message += fmt::format("; stable at {}, ", levels.text(progress.stable));
    // of the methods that seek equilibrium only bisection knows a failed level, from its second trial on
    if (plan.method != ReductionMethod::bisection || attempt.number == 1) {
      report.message += fmt::format("no failed {} is known", levels.one);
      return;
    }
    report.message += fmt::format("failed at {}", levels.text(progress.failed));
    close_bracket();
  }

  TrialCriteria criteria() const { return {plan, settings, failure_displacement, watches(), why_not_watched()}; }
  std::string why_not_watched() const {
    return plan.criterion == FailureCriterion::required_strength ? not_watched(model, plan, state.supports) : "";
  }

  // ---- bolts that hold the blocks at any factor ---------------------------------------------------------------------

  bool is_stable_at_end() const { return progress.trial > 0 && progress.stable == levels.to; }
  bool bolts_act() const {
    if (plan.searched != Searched::factor) return false;
    for (std::size_t b = 0; b < model.bodies.size(); ++b)
      if (!model.bodies[b].fixed && hangs_on_spring(progress.base.supports, static_cast<int>(b))) return true;
    return false;
  }

  // A search that is stable to its end asks whether a greater end would find a factor: not if the blocks are in
  // equilibrium without the strength that it divides.
  void ask_bolts() {
    if (!is_stable_at_end() || report.last.reason == StopReason::interrupted || !bolts_act()) return;
    const std::optional<SearchTrial> outcome =
        carry_out({.number = 2, .target = factor_without_strength, .from_base = true, .beside = true});
    if (report.last.reason == StopReason::interrupted) return;
    report.message = outcome == SearchTrial::stable ? hangs_on_bolts(largest_bolt_use(model, state)) : still_stable();
    report.last = {.reason = StopReason::equilibrium, .unreached = {}};
    report.unbalanced = progress.unbalanced;
    go_back_to_base();
  }

  // ---- bisection: every trial starts from the last stable state -----------------------------------------------------

  void bisect() {
    if (progress.trial == 0 && !rest_at(0, levels.from)) return;
    if (progress.trial == 0) progress.watch.plan = watch_plan(model, settings, plan, levels, progress.base);
    if (is_stable_at_end()) return ask_bolts();
    if (progress.trial <= 1 && !rest_at(1, levels.to, true)) return ask_bolts();
    const int next = progress.run.under_way ? progress.trial : progress.trial + 1;
    for (int n = std::max(next, 2); progress.leg == FollowLeg::none && !is_closed(); ++n)
      if (!rest_at(n, bracket() > levels.tolerance ? next_level() : progress.failed, true)) return;
    if (follow_failed()) close_bracket();
  }

  // nothing: interrupted, or a numerical failure
  std::optional<SearchTrial> follow(FollowLeg leg, bool from_base) {
    const int number = progress.trial + (progress.run.under_way ? 0 : 1);
    progress.leg = leg;
    return carry_out({.number = number, .target = progress.failed, .from_base = from_base, .beside = true, .leg = leg});
  }
  // The failed end of the bracket once more, beyond its failure. False: interrupted.
  bool follow_failed() {
    const RunReport last = report.last;
    std::optional<SearchTrial> outcome = SearchTrial::failed;
    if (watches() && progress.leg != FollowLeg::to_rest) outcome = follow(FollowLeg::on, true);
    if (plan.follow_steps > 0 && outcome == SearchTrial::failed) outcome = follow(FollowLeg::to_rest, !watches());
    if (report.last.reason == StopReason::interrupted) return false;
    const double moved = way_since(progress.begin);
    if (plan.follow_steps > 0 || (outcome == SearchTrial::stable && moved > progress.failed_way))
      report.followed =
          FollowedTrial{outcome == SearchTrial::stable, moved, progress.trial_steps, describe(report.last.reason)};
    report.last = last;
    report.message.clear();
    return true;
  }

  // half way, or if no trial decides the level there, half way from it to the farther end
  double next_level() {
    if (const std::optional<double> level = level_by_estimate(levels, ends(), progress.known);
        level && !progress.avoids)
      return *level;
    const double below = progress.undecided - progress.stable, above = progress.failed - progress.undecided;
    progress.avoids = progress.avoids && levels.direction * below > 0 && levels.direction * above > 0;
    if (const std::optional<double> level = level_for_fit(levels, ends(), progress.known); level && !progress.avoids)
      return *level;
    if (!progress.avoids) return 0.5 * (progress.stable + progress.failed);
    return progress.undecided + 0.5 * (std::abs(below) > std::abs(above) ? -below : above);
  }
  // ---- steps: from equilibrium to equilibrium until one fails -------------------------------------------------------

  void go_by_steps() {
    for (int n = progress.trial;; ++n) {
      const std::optional<SearchTrial> outcome =
          rest_at(n, levels.safer(levels.from + levels.direction * n * levels.step, levels.to));
      if (outcome == SearchTrial::failed) close_bracket();
      if (outcome != SearchTrial::stable) return;
    }
  }
  // ---- rate: one reduction from equilibrium -------------------------------------------------------------------------

  // bias of the angle found at a rate on a plane, rad; 0 if there is no gravity
  double largest_lag(double rate) const {
    const double g = model.gravity.norm() * (1 - settings.damping.local);
    return g > 0 ? std::cbrt(6 * failure_displacement * rate * rate / g) : 0;
  }

  void fall_at_rate() {
    if (progress.trial == 0 && !rest_at(0, plan.from)) return;
    if (fall(1, plan.rate)) close(progress.failed, largest_lag(plan.rate));
  }
  // ---- two rates: reduction, equilibrium closer to failure, second reduction from there -----------------------------

  void fall_at_two_rates() {
    if (progress.trial == 0 && !rest_at(0, plan.from)) return;
    if (progress.trial <= faster_fall) {
      if (!fall(faster_fall, plan.rate)) return;
      progress.failed_faster = progress.failed;
    }
    if (progress.trial <= coming_nearer && !come_nearer()) return;
    if (fall(slower_fall, plan.slower_rate)) extrapolate();
  }

  // without equilibrium the slower reduction starts where the faster did; false: the search is over
  bool come_nearer() {
    const double friction = std::min(plan.from, progress.failed_faster + nearer_by_lags * largest_lag(plan.rate));
    const std::optional<SearchTrial> outcome =
        carry_out({.number = coming_nearer, .target = friction, .from_base = true});
    if (!outcome) return false;
    if (outcome != SearchTrial::stable) go_back_to_base();
    progress.stable = outcome == SearchTrial::stable ? friction : plan.from;
    return true;
  }

  // to the angle at zero rate
  void extrapolate() {
    const double growth = std::pow(plan.rate / plan.slower_rate, bias_power) - 1;
    const double bias = (progress.failed - progress.failed_faster) / growth;
    if (bias > 0)
      close(progress.failed + bias, extrapolation_margin * bias);
    else
      report.message = "the slower rate did not find the higher angle: the failure has no lag to extrapolate";
  }
  // -------------------------------------------------------------------------------------------------------------------

  void search() {
    if (progress.begin.empty()) {
      progress.begin = displacements(state.bodies);
      note_placements(state.bodies, progress.begun);
    }
    switch (plan.method) {
      case ReductionMethod::bisection:
        return bisect();
      case ReductionMethod::steps:
        return go_by_steps();
      case ReductionMethod::rate:
        return fall_at_rate();
      case ReductionMethod::two_rates:
        return fall_at_two_rates();
    }
  }

  std::string rule() const {
    switch (plan.method) {
      case ReductionMethod::bisection:
        return bisection_rule(criteria(), report.by);
      case ReductionMethod::steps:
        return fmt::format("steps of {:.4g}{}; ", levels.step / levels.unit, levels.symbol) +
               stable_and_failed_rule(criteria());
      case ReductionMethod::rate:
        return fmt::format("constant rate {:.4g} deg/s, found too low by up to {:.2g} deg; ", plan.rate / degree,
                           report.error_bar / degree) +
               failed_rule(criteria());
      case ReductionMethod::two_rates:
        return fmt::format("{:.6g} deg at {:.4g} deg/s, {:.6g} at {:.4g}, extrapolated by rate^(2/3); ",
                           progress.failed_faster / degree, plan.rate / degree, progress.failed / degree,
                           plan.slower_rate / degree) +
               failed_rule(criteria());
    }
    return {};
  }
};

bool of_rates(ReductionMethod method) {
  return method == ReductionMethod::rate || method == ReductionMethod::two_rates;
}

}  // namespace

template <int Dim>
ReductionReport reduce(const Model<Dim>& model, const Settings& settings, const ReducePlan& plan, State<Dim>& state,
                       ReductionProgress<Dim>& progress, const RunHooks<Dim>& hooks, const TrialHook<Dim>& on_trial) {
  Search<Dim> search{model, settings,        plan, hooks, on_trial, state, progress, chosen_properties(model, plan),
                     0,     levels_of(plan), {}};
  search.failure_displacement = failure_displacement_of(model, plan);
  ReductionReport& report = search.report;
  if (plan.searched == Searched::factor && of_rates(plan.method)) {
    report.message =
        "a factor of safety is searched by bisection or in steps: the delay of failure at a finite rate is not known";
    return report;
  }
  search.search();
  if (report.last.reason != StopReason::interrupted) {
    report.stable = progress.stable;
    report.failed = progress.failed;
  }
  report.rule = search.rule();
  report.watched = search.watches();
  report.turned = progress.known.no_line == NoLine::turned;
  if (report.bracketed && !report.message.empty()) report.rule += "; the search ended early: " + report.message;
  return report;
}

template ReductionReport reduce<2>(const Model<2>&, const Settings&, const ReducePlan&, State<2>&,
                                   ReductionProgress<2>&, const RunHooks<2>&, const TrialHook<2>&);
template ReductionReport reduce<3>(const Model<3>&, const Settings&, const ReducePlan&, State<3>&,
                                   ReductionProgress<3>&, const RunHooks<3>&, const TrialHook<3>&);

}  // namespace voussoir
