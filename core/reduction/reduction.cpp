#include "core/reduction/reduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/motion/relaxation.hpp"

namespace voussoir {
namespace {

constexpr double degree = std::numbers::pi / 180;

// without a stated displacement, a body that moved by this share of its inscribed radius has failed
constexpr double default_failure_share = 0.1;

// the bias of a constant rate goes with this power of it (method.md section 6)
constexpr double bias_power = 2.0 / 3;

// two rates: the slower fall starts this many of the faster's lags above where that failed; one would do on a plane
constexpr double nearer_by_lags = 1.5;

// two rates: the trials after the one at rest
constexpr int faster_fall = 1, coming_nearer = 2, slower_fall = 3;

// A trial's steps are shared out in rounds, the step limit over these: relaxation has 20,000 steps by default, which is
// what a column of 1,000 blocks takes to come to rest, then true motion 100,000, then relaxation again. Relaxation is
// slow where a slope slides far before it rests, for the damping of what flutters as it slides holds up the slide; true
// motion is slow at the end, for local damping takes nothing from a slide whose forces are nearly in balance. Either
// begins at rest.
constexpr long long relaxation_round = 50, motion_round = 10;

// 1.25 times Richardson's estimate covers what the slower rate leaves open (Roache's grid convergence index, order
// known), so a quarter of it covers what the extrapolation leaves
constexpr double extrapolation_margin = 0.25;

Trial judge(StopReason reason) {
  switch (reason) {
    case StopReason::equilibrium:
      return Trial::stable;
    case StopReason::moved_away:
      return Trial::failed;
    case StopReason::no_contact_answer:
    case StopReason::not_finite:
      return Trial::broken;
    default:
      return Trial::undecided;
  }
}

template <int Dim>
struct Search {
  const Model<Dim>& model;
  const Settings& settings;
  const ReducePlan& plan;
  State<Dim>& state;
  ReductionProgress<Dim>& progress;
  std::vector<int> properties;
  double failure_displacement;
  ReductionReport report;

  // the trial that runs at constant rate, instead of to rest at an angle
  bool falls() const {
    return plan.method == ReductionMethod::rate ? progress.trial > 0 : falls_faster() || falls_slower();
  }

  // two rates: fall, come to rest nearer to where the first fall began to move, fall from there
  bool falls_faster() const { return two_rates() && progress.trial == faster_fall; }
  bool comes_nearer() const { return two_rates() && progress.trial == coming_nearer; }
  bool falls_slower() const { return two_rates() && progress.trial == slower_fall; }
  bool two_rates() const { return plan.method == ReductionMethod::two_rates; }

  double rate() const { return falls_slower() ? plan.slower_rate : plan.rate; }

  // how far too low an angle a rate can find on a plane, rad; 0 where nothing pulls
  double largest_lag(double rate) const {
    const double g = model.gravity.norm() * (1 - settings.damping.local);
    return g > 0 ? std::cbrt(6 * failure_displacement * rate * rate / g) : 0;
  }

  double next_target() const {
    if (progress.trial == 0) return plan.from;
    switch (plan.method) {
      case ReductionMethod::bisection:
        return progress.trial == 1 ? plan.to : 0.5 * (progress.stable + progress.failed);
      case ReductionMethod::steps:
        return std::max(plan.from - progress.trial * plan.step, plan.to);
      case ReductionMethod::two_rates:
        if (comes_nearer())
          return std::min(plan.from, progress.failed_faster + nearer_by_lags * largest_lag(plan.rate));
        return plan.to;
      case ReductionMethod::rate:
        return plan.to;
    }
    return plan.to;
  }

  // the work done since is not forgotten
  void go_back_to_base() {
    const Counters spent = state.counters;
    state = progress.base;
    state.counters = spent;
  }

  bool starts_from_base() const {
    return plan.method == ReductionMethod::bisection ? progress.trial > 0 : comes_nearer();
  }

  void begin_trial() {
    if (starts_from_base()) go_back_to_base();
    progress.true_motion = false;
    progress.trial_steps = 0;
    progress.run.begin = falls() ? std::vector<Vector<Dim>>{} : progress.begin;
    progress.target = next_target();
    state.schedule.started = state.time;
    if (falls()) {
      progress.friction_from = progress.stable;
      progress.friction_rate = rate();
      progress.time_limit = state.time + (progress.stable - plan.to) / rate();
      return;
    }
    // friction falls gently to the trial's angle: dropped at once, it would set the model in motion, and slip that
    // inertia causes wipes out the shear that settlement has locked in
    progress.friction_from = state.schedule.friction[properties.front()];
    progress.friction_rate = 0;
    const double ramp = static_cast<double>(plan.ramp_steps) * state.time_step;
    if (progress.target < progress.friction_from && ramp > 0)
      progress.friction_rate = (progress.friction_from - progress.target) / ramp;
    else
      for (int p : properties)
        state.schedule.friction[p] = progress.target;
  }

  // relaxation and true motion take turns
  bool relaxes_first() const { return relaxes(!falls(), settings.damping); }
  long long round() const {
    return std::max(1LL, plan.step_limit / (progress.true_motion ? motion_round : relaxation_round));
  }

  // true: the trial goes on by the other way
  bool takes_turn() {
    if (report.last.reason != StopReason::interrupted) progress.trial_steps += report.last.steps;
    if (!relaxes_first() || report.last.reason != StopReason::step_limit || progress.trial_steps >= plan.step_limit)
      return false;
    progress.true_motion = !progress.true_motion;
    return true;
  }

  Trial go_on(const RunHooks<Dim>& hooks) {
    RunGoal goal;
    goal.rest = !falls();
    goal.moved_away = failure_displacement;
    goal.step_limit = plan.step_limit - progress.trial_steps;
    if (relaxes_first()) goal.step_limit = std::min(goal.step_limit, round());
    if (falls()) goal.time_limit = progress.time_limit;
    const RunSchedule schedule{{}, progress.friction_rate, progress.friction_from, progress.target, properties};
    Settings own = settings;
    if (progress.true_motion) own.damping.statics = Statics::local;
    report.last = run(model, own, goal, schedule, state, progress.run, hooks);
    report.unbalanced = report.last.unbalanced;
    return judge(report.last.reason);
  }

  void close(double critical, double error_bar) {
    report.bracketed = true;
    report.critical = critical;
    report.error_bar = error_bar;
  }
  void close_bracket() {
    go_back_to_base();
    report.unbalanced = progress.unbalanced;
    close(0.5 * (progress.stable + progress.failed), 0.5 * (progress.stable - progress.failed));
  }

  // the angle at no rate at all
  bool close_extrapolated() {
    const double growth = std::pow(plan.rate / plan.slower_rate, bias_power) - 1;
    const double bias = (progress.failed - progress.failed_faster) / growth;
    if (!(bias > 0))
      return give_up("the slower rate did not find the higher angle: the failure has no lag to extrapolate");
    close(progress.failed + bias, extrapolation_margin * bias);
    return false;
  }

  bool give_up(const std::string& message) {
    report.message = message;
    return false;
  }

  // The body that is farthest from where the search began, as a clause: what an undecided trial shows. The trial ended
  // in true motion, so the velocity is one.
  std::string farthest_mover() const {
    int body = -1;
    double most = 0;
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const double moved = (state.motions[b].displacement - progress.begin[b]).norm();
      if (model.bodies[b].fixed || moved <= most) continue;
      most = moved;
      body = static_cast<int>(b);
    }
    if (body < 0) return "no body has moved";
    const Vector<Dim>& velocity = state.motions[body].velocity;
    const double away = velocity.dot(state.motions[body].displacement - progress.begin[body]) / most;
    return fmt::format("{} has moved by {:.3g} m of the {:.3g} m that are failure and {} at {:.2g} m/s",
                       label_of(model, body), most, failure_displacement,
                       away > 0.5 * velocity.norm() ? "creeps on" : "swings", velocity.norm());
  }

  // what a trial that neither came to rest nor failed leaves of the search; always false
  bool give_up_undecided(double friction) {
    if (falls())
      return give_up(fmt::format("no failure down to {:.6g} deg ({}), stable at {:.6g} deg", friction / degree,
                                 describe(report.last.reason), progress.stable / degree));
    const std::string why =
        fmt::format("neither rest nor failure at {:.6g} deg within {} steps (unbalanced {:.2g}): {}", friction / degree,
                    progress.trial_steps, report.last.unbalanced, farthest_mover());
    if (progress.trial == 0) return give_up(why + "; neither a stable nor a failed angle is known");
    // the first trial of a bisection is at `from`, the second at `to`
    if (plan.method != ReductionMethod::bisection || progress.trial == 1)
      return give_up(fmt::format("{}; stable at {:.6g} deg, no failed angle is known", why, progress.stable / degree));
    close_bracket();
    return give_up(fmt::format("{}; stable at {:.6g} deg, failed at {:.6g} deg", why, progress.stable / degree,
                               progress.failed / degree));
  }

  // draws the trial's consequences; false: the search is over
  bool conclude(Trial outcome, double friction) {
    if (outcome == Trial::broken) return give_up(report.last.detail);
    if (comes_nearer()) {
      // no rest there: the slower fall begins where the faster did
      if (outcome != Trial::stable) go_back_to_base();
      progress.stable = outcome == Trial::stable ? friction : plan.from;
      return true;
    }
    if (outcome == Trial::undecided) return give_up_undecided(friction);
    if (progress.trial == 0 && outcome == Trial::failed)
      return give_up(fmt::format("fails already at from_deg = {:.6g}: start higher", plan.from / degree));
    if (outcome == Trial::stable) {
      progress.stable = friction;
      progress.unbalanced = report.last.unbalanced;
      if (plan.method != ReductionMethod::rate) progress.base = state;
      if (progress.trial > 0 && friction == plan.to)
        return give_up(fmt::format("still stable at to_deg = {:.6g}: end lower", plan.to / degree));
    } else {
      progress.failed = friction;
    }
    if (progress.trial == 0) return true;
    return search_goes_on(outcome);
  }

  bool search_goes_on(Trial outcome) {
    if (falls_slower()) return close_extrapolated();
    if (falls_faster()) {
      progress.failed_faster = progress.failed;
      return true;
    }
    if (plan.method == ReductionMethod::rate) {
      close(progress.failed, largest_lag(plan.rate));
      return false;
    }
    const bool open = plan.method == ReductionMethod::bisection ? progress.stable - progress.failed > plan.tolerance
                                                                : outcome == Trial::stable;
    if (!open) close_bracket();
    return open;
  }

  void search(const RunHooks<Dim>& hooks, const TrialHook<Dim>& on_trial) {
    if (progress.begin.empty())
      for (const Motion<Dim>& m : state.motions)
        progress.begin.push_back(m.displacement);
    while (true) {
      if (!progress.run.under_way) begin_trial();
      Trial outcome = go_on(hooks);
      while (takes_turn())
        outcome = go_on(hooks);
      if (report.last.reason == StopReason::interrupted) return;
      const double friction = falls() ? state.schedule.friction[properties.front()] : progress.target;
      if (on_trial) on_trial(state, friction, outcome);
      if (!conclude(outcome, friction)) break;
      ++progress.trial;
    }
    report.stable = progress.stable;
    report.failed = progress.failed;
  }
};

template <int Dim>
double default_failure_displacement(const Model<Dim>& model) {
  double smallest = 0;
  for (const Body<Dim>& b : model.bodies)
    if (!b.fixed) smallest = smallest == 0 ? b.size : std::min(smallest, b.size);
  return default_failure_share * smallest;
}

}  // namespace

bool is_detour(ReductionMethod method, int trial, Trial outcome) {
  switch (method) {
    case ReductionMethod::bisection:
    case ReductionMethod::steps:
      return outcome != Trial::stable;
    case ReductionMethod::rate:
      return false;
    case ReductionMethod::two_rates:
      return trial == faster_fall || (trial == coming_nearer && outcome != Trial::stable);
  }
  return false;
}

template <int Dim>
std::vector<int> chosen_properties(const Model<Dim>& model, const ReducePlan& plan) {
  std::vector<int> chosen;
  for (std::size_t p = 0; p < model.properties.size(); ++p)
    if (plan.properties.empty() ||
        std::find(plan.properties.begin(), plan.properties.end(), model.properties[p].name) != plan.properties.end())
      chosen.push_back(static_cast<int>(p));
  return chosen;
}

template <int Dim>
ReductionReport reduce(const Model<Dim>& model, const Settings& settings, const ReducePlan& plan, State<Dim>& state,
                       ReductionProgress<Dim>& progress, const RunHooks<Dim>& hooks, const TrialHook<Dim>& on_trial) {
  Search<Dim> search{model, settings, plan, state, progress, chosen_properties(model, plan), 0, {}};
  search.failure_displacement =
      plan.failure_displacement > 0 ? plan.failure_displacement : default_failure_displacement(model);
  search.search(hooks, on_trial);

  const std::string failed = fmt::format("failed: a body moved more than {:.3g} m", search.failure_displacement);
  const std::string stable = fmt::format("stable: unbalanced ratio below {:.0e}", settings.equilibrium.unbalanced);
  switch (plan.method) {
    case ReductionMethod::bisection:
      search.report.rule = "bisection from the last stable state; " + stable + "; " + failed;
      break;
    case ReductionMethod::steps:
      search.report.rule = fmt::format("steps of {:.4g} deg; ", plan.step / degree) + stable + "; " + failed;
      break;
    case ReductionMethod::rate:
      search.report.rule = fmt::format("constant rate {:.4g} deg/s, found too low by up to {:.2g} deg; ",
                                       plan.rate / degree, search.report.error_bar / degree) +
                           failed;
      break;
    case ReductionMethod::two_rates:
      search.report.rule = fmt::format("{:.6g} deg at {:.4g} deg/s, {:.6g} at {:.4g}, extrapolated by rate^(2/3); ",
                                       progress.failed_faster / degree, plan.rate / degree, progress.failed / degree,
                                       plan.slower_rate / degree) +
                           failed;
      break;
  }
  if (search.report.bracketed && !search.report.message.empty())
    search.report.rule += "; the search ended early: " + search.report.message;
  return search.report;
}

template std::vector<int> chosen_properties<2>(const Model<2>&, const ReducePlan&);
template std::vector<int> chosen_properties<3>(const Model<3>&, const ReducePlan&);
template ReductionReport reduce<2>(const Model<2>&, const Settings&, const ReducePlan&, State<2>&,
                                   ReductionProgress<2>&, const RunHooks<2>&, const TrialHook<2>&);
template ReductionReport reduce<3>(const Model<3>&, const Settings&, const ReducePlan&, State<3>&,
                                   ReductionProgress<3>&, const RunHooks<3>&, const TrialHook<3>&);

}  // namespace voussoir
