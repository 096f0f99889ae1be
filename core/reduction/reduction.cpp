#include "core/reduction/reduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voussoir {
namespace {

constexpr double degree = std::numbers::pi / 180;

// without a stated displacement, a body that moved by this share of its inscribed radius has failed
constexpr double default_failure_share = 0.1;

template <int Dim>
struct Search {
  const Model<Dim>& model;
  const Settings& settings;
  const ReducePlan& plan;
  State<Dim>& state;
  const StepHook<Dim>& on_step;
  const TrialHook<Dim>& on_trial;
  std::vector<int> properties;
  double failure_displacement;
  ReductionReport report;

  // runs at an angle from the present state until it rests or has failed
  Trial attempt(double friction) {
    // friction falls gently to the trial's angle: dropped at once, it would set the model in motion, and slip that
    // inertia causes wipes out the shear that settlement has locked in
    const double present = state.schedule.friction[properties.front()];
    const double ramp = static_cast<double>(plan.ramp_steps) * state.time_step;
    state.schedule.started = state.time;
    RunSchedule schedule{0, 0, present, friction, properties};
    if (friction < present && ramp > 0)
      schedule.friction_rate = (present - friction) / ramp;
    else
      for (int p : properties)
        state.schedule.friction[p] = friction;

    RunGoal goal;
    goal.rest = true;
    goal.moved_away = failure_displacement;
    goal.step_limit = plan.step_limit;
    report.last = run(model, settings, goal, schedule, state, on_step);
    const Trial outcome = judge(report.last.reason);
    if (on_trial) on_trial(state, friction, outcome);
    if (outcome == Trial::undecided)
      report.message = fmt::format("neither rest nor failure at {:.6g} deg within {} steps (unbalanced {:.2g})",
                                   friction / degree, report.last.steps, report.last.unbalanced);
    if (outcome == Trial::broken) report.message = report.last.detail;
    return outcome;
  }

  static Trial judge(StopReason reason) {
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

  bool start() {
    const Trial first = attempt(plan.from);
    report.stable = plan.from;
    if (first == Trial::failed)
      report.message = fmt::format("fails already at from_deg = {:.6g}: start higher", plan.from / degree);
    return first == Trial::stable;
  }

  // the work done since is not forgotten
  void go_back_to(const State<Dim>& base) {
    const Counters spent = state.counters;
    state = base;
    state.counters = spent;
  }

  void close(double critical, double error_bar) {
    report.bracketed = true;
    report.critical = critical;
    report.error_bar = error_bar;
  }

  void bisect() {
    if (!start()) return;
    State<Dim> base = state;
    const auto trial_from_base = [&](double friction) {
      go_back_to(base);
      const Trial outcome = attempt(friction);
      if (outcome == Trial::stable) base = state;
      return outcome;
    };
    const Trial end = trial_from_base(plan.to);
    report.failed = plan.to;
    if (end == Trial::stable)
      report.message = fmt::format("still stable at to_deg = {:.6g}: end lower", plan.to / degree);
    if (end != Trial::failed) return;
    while (report.stable - report.failed > plan.tolerance) {
      const double middle = 0.5 * (report.stable + report.failed);
      const Trial outcome = trial_from_base(middle);
      if (outcome == Trial::undecided || outcome == Trial::broken) return;
      (outcome == Trial::stable ? report.stable : report.failed) = middle;
    }
    go_back_to(base);
    close(0.5 * (report.stable + report.failed), 0.5 * (report.stable - report.failed));
  }

  void descend() {
    if (!start()) return;
    State<Dim> base = state;
    for (long long k = 1;; ++k) {
      const double friction = std::max(plan.from - static_cast<double>(k) * plan.step, plan.to);
      const Trial outcome = attempt(friction);
      if (outcome == Trial::failed) {
        report.failed = friction;
        break;
      }
      if (outcome != Trial::stable) return;
      report.stable = friction;
      base = state;
      if (friction == plan.to) {
        report.message = fmt::format("still stable at to_deg = {:.6g}: end lower", plan.to / degree);
        return;
      }
    }
    go_back_to(base);
    close(0.5 * (report.stable + report.failed), 0.5 * (report.stable - report.failed));
  }

  void fall() {
    if (!start()) return;
    state.schedule.started = state.time;
    RunGoal goal;
    goal.moved_away = failure_displacement;
    goal.time_limit = state.time + (plan.from - plan.to) / plan.rate;
    goal.step_limit = plan.step_limit;
    const RunSchedule schedule{0, plan.rate, plan.from, plan.to, properties};
    report.last = run(model, settings, goal, schedule, state, on_step);
    const double found = state.schedule.friction[properties.front()];
    const Trial outcome = judge(report.last.reason);
    if (on_trial) on_trial(state, found, outcome);
    if (outcome == Trial::broken) report.message = report.last.detail;
    if (outcome == Trial::undecided)
      report.message = fmt::format("no failure down to {:.6g} deg ({})", found / degree, describe(report.last.reason));
    if (outcome != Trial::failed) return;
    report.failed = found;
    const double g = model.gravity.norm() * (1 - settings.damping.local);
    close(found, g > 0 ? std::cbrt(6 * failure_displacement * plan.rate * plan.rate / g) : 0);
  }
};

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
double default_failure_displacement(const Model<Dim>& model) {
  double smallest = 0;
  for (const Body<Dim>& b : model.bodies)
    if (!b.fixed) smallest = smallest == 0 ? b.size : std::min(smallest, b.size);
  return default_failure_share * smallest;
}

}  // namespace

template <int Dim>
ReductionReport reduce(const Model<Dim>& model, const Settings& settings, const ReducePlan& plan, State<Dim>& state,
                       const StepHook<Dim>& on_step, const TrialHook<Dim>& on_trial) {
  Search<Dim> search{model, settings, plan, state, on_step, on_trial, chosen_properties(model, plan), 0, {}};
  search.failure_displacement =
      plan.failure_displacement > 0 ? plan.failure_displacement : default_failure_displacement(model);
  const std::string failed = fmt::format("failed: a body moved more than {:.3g} m", search.failure_displacement);
  const std::string stable = fmt::format("stable: unbalanced ratio below {:.0e}", settings.equilibrium.unbalanced);
  switch (plan.method) {
    case ReductionMethod::bisection:
      search.bisect();
      search.report.rule = "bisection from the last stable state; " + stable + "; " + failed;
      break;
    case ReductionMethod::steps:
      search.descend();
      search.report.rule = fmt::format("steps of {:.4g} deg; ", plan.step / degree) + stable + "; " + failed;
      break;
    case ReductionMethod::rate:
      search.fall();
      search.report.rule = fmt::format("constant rate {:.4g} deg/s; ", plan.rate / degree) + failed;
      break;
  }
  return search.report;
}

template ReductionReport reduce<2>(const Model<2>&, const Settings&, const ReducePlan&, State<2>&, const StepHook<2>&,
                                   const TrialHook<2>&);
template ReductionReport reduce<3>(const Model<3>&, const Settings&, const ReducePlan&, State<3>&, const StepHook<3>&,
                                   const TrialHook<3>&);

}  // namespace voussoir
