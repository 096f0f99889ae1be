#include "core/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/model/body_title.hpp"
#include "core/step.hpp"
#include "core/step/free_fall.hpp"
#include "core/step/integrate.hpp"
#include "core/step/prescribed.hpp"
#include "core/step/relaxation.hpp"
#include "core/step/static_solver.hpp"
#include "core/step/static_solver_base.hpp"
#include "core/step/support_table.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// steps between two checks for freely falling bodies; a check costs less than a step
constexpr long long steps_between_falls = 100;

// Steps of a relaxation before the implicit static solver tries its increment, and again after the same number of
// further steps. An equilibrium not found by then involves a mode too soft for relaxation, whose steps grow with the
// root of the stiffness ratio.
constexpr long long steps_until_newton = 80'000;

// Steps of relaxation before Newton's method in a stage that bonds joints: the first compresses whole faces, of which
// an increment would compress only the part that the entire load leaves closed.
constexpr long long steps_that_bond = 5;

constexpr double never = std::numeric_limits<double>::infinity();  // s

// sets the scheduled values to those at the time of the positions; true while they still change
template <int Dim>
bool follow(const Model<Dim>& model, const RunSchedule& plan, Schedule& schedule,
            std::vector<ReliefLoad<Dim>>& relief) {
  const double began = schedule.started, elapsed = schedule.time - began;
  bool changing = false;
  if (plan.gravity.ramp > 0) {
    // the sum, not the difference, is reached exactly by a stage that ends with its ramp
    const double fraction = schedule.time >= began + plan.gravity.ramp ? 1 : elapsed / plan.gravity.ramp;
    const double from = plan.gravity.from;
    schedule.gravity_factor = from + (plan.gravity.to.value_or(1) - from) * fraction;
    changing = fraction < 1;
  } else if (plan.gravity.to) {
    schedule.gravity_factor = *plan.gravity.to;
  }
  if (plan.strength_rate > 0) {
    const double level = plan.searched == Searched::friction
                             ? std::max(plan.strength_to, plan.strength_from - plan.strength_rate * elapsed)
                             : std::min(plan.strength_to, plan.strength_from + plan.strength_rate * elapsed);
    set_strength(model, plan.searched, plan.properties, level, schedule);
    changing = changing || level != plan.strength_to;
  }
  for (const WaterPlan& water : plan.water) {
    const double fraction = schedule.time >= began + water.ramp ? 1 : elapsed / water.ramp;
    std::vector<double>& numbers = schedule.water[water.water];
    for (std::size_t k = 0; k < numbers.size(); ++k)
      numbers[k] = fraction < 1 ? water.from[k] + (water.to[k] - water.from[k]) * fraction : water.to[k];
    changing = changing || fraction < 1;
  }
  if (plan.excavation_forces && !relief.empty()) {
    const double fraction =
        schedule.time >= began + plan.excavation_forces->duration ? 1 : elapsed / plan.excavation_forces->duration;
    for (ReliefLoad<Dim>& held : relief)
      held.share = held.begun + (std::min(held.begun, plan.excavation_forces->remaining) - held.begun) * fraction;
    changing = changing || fraction < 1;
  }
  return changing;
}

// Whether enough bodies have moved away. If one body is not enough, those that have are left behind.
template <int Dim>
bool has_moved_away(const Model<Dim>& model, const RunGoal& goal, const std::vector<Vector<Dim>>& begin,
                    const StaticIncrement<Dim>& increment, BodiesState<Dim>& bodies) {
  const bool trials = increment.under_way;  // a trial that is not yet judged is not a motion
  const std::vector<Placement<Dim>> accepted =
      trials ? accepted_placements(model, increment) : std::vector<Placement<Dim>>{};
  double moved = 0, free = 0;  // kg
  if (goal.moved_fraction > 0) bodies.left_behind.assign(model.bodies.size(), false);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].fixed) continue;
    free += model.bodies[b].mass;
    const double way = ((trials ? accepted[b].displacement : bodies.motions[b].displacement) - begin[b]).norm();
    if (!(way > *goal.moved_away)) continue;
    if (goal.moved_fraction == 0) return true;
    bodies.left_behind[b] = true;
    moved += model.bodies[b].mass;
  }
  return moved > 0 && moved >= goal.moved_fraction * free;
}

// s: how long gravity, strength, water and what excavated rock holds still change
double ramp_of(const RunSchedule& plan) {
  const double fall = plan.strength_rate > 0 ? std::abs(plan.strength_from - plan.strength_to) / plan.strength_rate : 0;
  double ramp = std::max(plan.gravity.ramp, fall);
  for (const WaterPlan& water : plan.water)
    ramp = std::max(ramp, water.ramp);
  if (plan.excavation_forces) ramp = std::max(ramp, plan.excavation_forces->duration);
  return ramp;
}

double ramp_left(const RunSchedule& plan, const Schedule& schedule) {
  return std::max(ramp_of(plan) - (schedule.time - schedule.started), 0.0);
}

// The ramps that a run ending now has not completed, and their progress; else the missing steps of equilibrium.
template <int Dim>
std::string unreached(const Model<Dim>& model, const Settings& settings, const RunSchedule& plan,
                      const RunProgress<Dim>& progress, const State<Dim>& state, double unbalanced) {
  const double elapsed = state.schedule.time - state.schedule.started;
  std::vector<std::string> ramps;
  const auto add = [&](const std::string& what, double ramp) {
    if (elapsed < ramp) ramps.push_back(fmt::format("{} (at {:.3g} % of {:g} s)", what, 100 * elapsed / ramp, ramp));
  };
  add("gravity", plan.gravity.ramp);
  if (plan.strength_rate > 0)
    add("the reduction of strength", std::abs(plan.strength_from - plan.strength_to) / plan.strength_rate);
  for (const WaterPlan& water : plan.water)
    add(fmt::format("the water '{}'", model.waters[water.water].name), water.ramp);
  if (plan.excavation_forces && !state.loads.relief.empty())
    add("what excavated rock still holds", plan.excavation_forces->duration);
  if (ramps.empty() && state.increment.under_way) ramps.emplace_back("the increments of Newton's method");
  if (ramps.empty() && unbalanced <= settings.equilibrium.unbalanced)
    ramps.push_back(fmt::format("equilibrium in {} consecutive steps (equilibrium.window), it lasted for {}",
                                settings.equilibrium.window, progress.at_rest));
  return ramps.empty() ? "" : fmt::format("; not reached: {}", fmt::join(ramps, ", "));
}

// the support that has left its rock, as a sentence; empty: none
template <int Dim>
std::string loose_support(const Model<Dim>& model, const State<Dim>& state) {
  for (const StepSupport<Dim>& row : step_supports<Dim>)
    if (std::string found = row.loose ? row.loose(model, state.supports) : ""; !found.empty()) return found;
  return {};
}

// falling bodies may still be lifted by a water, or lose their weight
bool may_return(const RunSchedule& plan, bool changing) {
  return changing && (!plan.water.empty() || plan.gravity.to == 0);
}

// the first body whose motion is not a number, or else whose load is, because a wrong motion spoils its neighbours'
// loads; -1: none
template <int Dim>
int first_not_finite(const State<Dim>& state) {
  for (std::size_t b = 0; b < state.bodies.motions.size(); ++b) {
    const Motion<Dim>& m = state.bodies.motions[b];
    if (!std::isfinite(m.displacement.sum() + m.velocity.sum() + m.angular_momentum.sum())) return static_cast<int>(b);
  }
  for (std::size_t b = 0; b < state.loads.total.size(); ++b)
    if (!std::isfinite(state.loads.total[b].force.sum() + state.loads.total[b].moment.sum()))
      return static_cast<int>(b);
  return -1;
}

// rad; in 3-D at most half a turn
double turn_of(const Rotation<2>& rotation) {
  return std::abs(rotation.angle);
}
double turn_of(const Rotation<3>& rotation) {
  return 2 * std::atan2(rotation.quaternion.vec().norm(), std::abs(rotation.quaternion.w()));
}

// the body that prevents equilibrium, and its motion; to be called while it moves
template <int Dim>
std::string restless(const Model<Dim>& model, const State<Dim>& state) {
  const int body = fastest(model, state);
  if (body < 0) return {};
  const Motion<Dim>& m = state.bodies.motions[body];
  return fmt::format("{} moves most, {:.3g} m from its initial position and rotated by {:.3g} degrees",
                     label_of(model, body), m.displacement.norm(), to_degrees(turn_of(m.rotation)));
}

template <int Dim>
std::string moment_of(const State<Dim>& state) {
  return fmt::format("step {}, t = {:.6g} s", state.counters.steps, state.schedule.time);
}

const char* name(ContactStatus status) {
  switch (status) {
    case ContactStatus::apart:
      return "apart";
    case ContactStatus::separated:
      return "separated";
    case ContactStatus::undecided:
      return "undecided";
    case ContactStatus::touching:
      return "touching";
    case ContactStatus::lp_not_converged:
      return "the LP did not converge";
    case ContactStatus::centre_not_converged:
      return "the analytic centre, or the least point of potential particles, did not converge";
    case ContactStatus::no_normal:
      return "no normal was found";
    case ContactStatus::no_face:
      return "a search along the normal found no face";
  }
  return "unknown";
}

template <int Dim>
std::string first_unanswered(const Model<Dim>& model, const State<Dim>& state) {
  for (const Contact<Dim>& c : state.contacts.list)
    if (c.unanswered())
      return fmt::format("contact of {} and {} at {}: {}", label_of(model, model.parts[c.part_a].body),
                         label_of(model, model.parts[c.part_b].body), moment_of(state), name(c.status));
  return "bar of a grouted bolt at " + moment_of(state) + ": no equilibrium";
}

// Stops bodies that must not move. The forces have been found: until then velocities are those of the last step, by
// which the joints slip.
template <int Dim>
void stop_bodies(const Model<Dim>& model, bool relaxing, State<Dim>& state) {
  stop_held(model, state.bodies.motions);
  if (relaxing)
    begin_relaxation(state);
  else
    begin_motion(state.time_step, state.relaxation);
}

// the step with which Newton's method begins, if the scene chooses it
long long first_of_newton(const RunGoal& goal) {
  return goal.bonds ? steps_that_bond : 0;
}

// Whether Newton's method begins with this step: the first, if the scene chooses it, or one of a slow relaxation.
template <int Dim>
bool begins_newton(const Model<Dim>& model, const Settings& settings, const RunGoal& goal,
                   const RunProgress<Dim>& progress, bool changing, const State<Dim>& state) {
  const bool lingers = progress.steps > 0 && progress.steps % steps_until_newton == 0 && progress.at_rest == 0 &&
                       !changing && !state.increment.under_way;
  const bool first = progress.steps == first_of_newton(goal) && settings.statics.method == Statics::newton;
  return (lingers || first) && newton_applies(model);
}

template <int Dim>
RunProgress<Dim> begin_run(const RunGoal& goal, bool by_displacement, const Counters& counters,
                           BodiesState<Dim>& bodies, Schedule& schedule) {
  schedule.ends = goal.end_time.value_or(never);
  bodies.left_behind.clear();
  RunProgress<Dim> progress;
  progress.under_way = true;
  progress.unconverged = counters.unconverged;
  if (by_displacement) progress.begin = displacements(bodies);
  return progress;
}

}  // namespace

std::string describe(StopReason reason) {
  switch (reason) {
    case StopReason::equilibrium:
      return "equilibrium";
    case StopReason::end_time:
      return "end time";
    case StopReason::lost_equilibrium:
      return "equilibrium lost";
    case StopReason::moved_away:
      return "failure displacement exceeded";
    case StopReason::step_limit:
      return "step limit";
    case StopReason::time_limit:
      return "time limit";
    case StopReason::no_contact_answer:
      return "a contact has no solution";
    case StopReason::not_finite:
      return "a number is not finite";
    case StopReason::falls_free:
      return "a body falls freely";
    case StopReason::lining_loose:
      return "a lining has left its rock";
    case StopReason::interrupted:
      return "interrupted";
  }
  return "unknown";
}

template <int Dim>
void note_accepted(const Model<Dim>& model, const State<Dim>& state, std::vector<Placement<Dim>>& placed) {
  if (state.increment.under_way)
    placed = accepted_placements(model, state.increment);
  else
    note_placements(state.bodies, placed);
}

template <int Dim>
std::string label_of(const Model<Dim>& model, int body) {
  return fmt::format("body {} ({})", body, title_of(model, body));
}

template <int Dim>
RunReport run(const Model<Dim>& model, const Settings& settings, const RunGoal& goal, const RunSchedule& schedule,
              State<Dim>& state, RunProgress<Dim>& progress, const RunHooks<Dim>& hooks, FailureWatch<Dim>* watch) {
  const bool relaxing = relaxes(goal.rest, settings.statics), by_displacement = goal.moved_away || watch;
  if (!progress.under_way) {
    std::vector<Vector<Dim>> stated = std::move(progress.begin);
    progress = begin_run(goal, by_displacement, state.counters, state.bodies, state.schedule);
    if (!stated.empty()) progress.begin = std::move(stated);
  }
  RunReport report;
  const auto stop = [&](StopReason reason, const std::string& detail = {}) {
    if (goal.rest && (reason == StopReason::step_limit || reason == StopReason::time_limit))
      report.unreached = unreached(model, settings, schedule, progress, state, report.unbalanced);
    progress.under_way = reason == StopReason::interrupted;
    if (relaxing && !progress.under_way) end_relaxation(state);
    if (!progress.under_way) state.schedule.ends = never;
    report.reason = reason;
    report.detail = detail;
    report.steps = progress.steps;
    return report;
  };

  // the forces of a step, and evaluations after the run, use the schedule at the time of the positions
  bool changing = follow(model, schedule, state.schedule, state.loads.relief);
  std::vector<Placement<Dim>> placed;  // for the watch
  // made once: no step allocates memory
  const std::function<void(State<Dim>&)> with_forces = [&](State<Dim>& now) {
    if (progress.steps == 0) stop_bodies(model, relaxing, now);
    if (relaxing && begins_newton(model, settings, goal, progress, changing, now))
      begin_newton(model, settings, ramp_left(schedule, now.schedule),
                   watch ? watch->plan.elastic : std::vector<double>{}, now);
    // a trial of the static solver is looked at when it has been judged
    if (watch && !now.increment.under_way) {
      note_placements(now.bodies, placed);
      look(model, now, placed, progress.begin, *watch);
    }
    if (hooks.with_forces) hooks.with_forces(now);
  };
  while (true) {
    if (hooks.pause && hooks.pause()) return stop(StopReason::interrupted);
    const bool tried = state.increment.under_way;
    step<Dim>(model, settings, state, with_forces);
    if (watch) note_accepted(model, state, placed);
    if (watch && tried) look(model, state, placed, progress.begin, *watch);
    const bool changed = std::exchange(changing, follow(model, schedule, state.schedule, state.loads.relief));
    ++progress.steps;
    report.unbalanced = goal.rest ? unbalanced_ratio(model, settings.threads, state) : -1;
    if (hooks.after_step) hooks.after_step(state, report.unbalanced);

    // no step with a wrong force
    if (state.counters.unconverged > progress.unconverged)
      return stop(StopReason::no_contact_answer, first_unanswered(model, state));
    if (const int body = first_not_finite(state); body >= 0)
      return stop(StopReason::not_finite, label_of(model, body) + " at " + moment_of(state));

    // equilibrium must last, and is not possible while gravity, friction or water still changes
    const bool evaluated = tried || state.increment.under_way;  // a trial of Newton's method is not yet an equilibrium
    const bool settled = goal.rest && !changed && !evaluated && report.unbalanced <= settings.equilibrium.unbalanced;
    progress.at_rest = settled ? progress.at_rest + 1 : 0;
    if (progress.at_rest >= settings.equilibrium.window) return stop(StopReason::equilibrium);
    if (watch && watch->trial.lost) return stop(StopReason::lost_equilibrium);
    if (goal.moved_away && has_moved_away(model, goal, progress.begin, state.increment, state.bodies))
      return stop(StopReason::moved_away);
    if (watch && has_failed_by_displacement(model, progress.begin, placed, watch->plan))
      return stop(StopReason::moved_away);
    if (goal.end_time && state.schedule.time >= *goal.end_time) return stop(StopReason::end_time);
    if (goal.rest && !evaluated && std::isinf(report.unbalanced))
      if (const std::string loose = loose_support(model, state); !loose.empty())
        return stop(StopReason::lining_loose, loose + ", and nothing else exerts a force");
    if (goal.rest && !by_displacement && !may_return(schedule, changing) && !state.increment.under_way &&
        progress.steps % steps_between_falls == 0)
      if (const int body = falling_free(model, state); body >= 0)
        return stop(StopReason::falls_free,
                    fmt::format("{} has left all others behind, {:.3g} m from its initial position",
                                label_of(model, body), state.bodies.motions[body].displacement.norm()));
    if (goal.time_limit && state.schedule.time >= *goal.time_limit)
      return stop(StopReason::time_limit, goal.rest ? restless(model, state) : "");
    if (goal.step_limit && progress.steps >= *goal.step_limit)
      return stop(StopReason::step_limit, goal.rest ? restless(model, state) : "");
  }
}

template void note_accepted<2>(const Model<2>&, const State<2>&, std::vector<Placement<2>>&);
template void note_accepted<3>(const Model<3>&, const State<3>&, std::vector<Placement<3>>&);
template std::string label_of<2>(const Model<2>&, int);
template std::string label_of<3>(const Model<3>&, int);
template RunReport run<2>(const Model<2>&, const Settings&, const RunGoal&, const RunSchedule&, State<2>&,
                          RunProgress<2>&, const RunHooks<2>&, FailureWatch<2>*);
template RunReport run<3>(const Model<3>&, const Settings&, const RunGoal&, const RunSchedule&, State<3>&,
                          RunProgress<3>&, const RunHooks<3>&, FailureWatch<3>*);

}  // namespace voussoir
