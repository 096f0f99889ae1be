#include "core/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/motion/integrate.hpp"
#include "core/step.hpp"

namespace voussoir {
namespace {

// sets the scheduled values; true while they still change
template <int Dim>
bool follow(const RunSchedule& plan, State<Dim>& state) {
  const double elapsed = state.time - state.schedule.started;
  bool changing = false;
  if (plan.gravity_ramp > 0) {
    state.schedule.gravity_factor = std::min(1.0, elapsed / plan.gravity_ramp);
    changing = state.schedule.gravity_factor < 1;
  }
  if (plan.friction_rate > 0) {
    const double friction = std::max(plan.friction_to, plan.friction_from - plan.friction_rate * elapsed);
    for (int p : plan.properties)
      state.schedule.friction[p] = friction;
    changing = changing || friction > plan.friction_to;
  }
  return changing;
}

template <int Dim>
double farthest(const Model<Dim>& model, const State<Dim>& state, const std::vector<Motion<Dim>>& begin) {
  double largest = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed)
      largest = std::max(largest, (state.motions[b].displacement - begin[b].displacement).norm());
  return largest;
}

template <int Dim>
bool finite(const State<Dim>& state) {
  double sum = 0;
  for (const Load<Dim>& l : state.loads)
    sum += l.force.sum() + l.moment.sum();
  return std::isfinite(sum);
}

const char* name(ContactStatus status) {
  switch (status) {
    case ContactStatus::apart:
      return "apart";
    case ContactStatus::separated:
      return "separated";
    case ContactStatus::touching:
      return "touching";
    case ContactStatus::lp_not_converged:
      return "the LP did not converge";
    case ContactStatus::centre_not_converged:
      return "the analytic centre did not converge";
    case ContactStatus::no_normal:
      return "no normal was found";
    case ContactStatus::no_face:
      return "a search along the normal met no face";
  }
  return "unknown";
}

template <int Dim>
std::string first_unanswered(const Model<Dim>& model, const State<Dim>& state) {
  for (const Contact<Dim>& c : state.contacts)
    if (c.unanswered())
      return fmt::format("contact of bodies {} and {} at t = {:.6g} s: {}", model.parts[c.part_a].body,
                         model.parts[c.part_b].body, state.time, name(c.status));
  return {};
}

}  // namespace

std::string describe(StopReason reason) {
  switch (reason) {
    case StopReason::equilibrium:
      return "equilibrium";
    case StopReason::end_time:
      return "end time";
    case StopReason::moved_away:
      return "failure displacement passed";
    case StopReason::step_limit:
      return "step limit";
    case StopReason::time_limit:
      return "time limit";
    case StopReason::no_contact_answer:
      return "a contact found no answer";
    case StopReason::not_finite:
      return "a force is not finite";
  }
  return "unknown";
}

template <int Dim>
RunReport run(const Model<Dim>& model, const Settings& settings, const RunGoal& goal, const RunSchedule& schedule,
              State<Dim>& state, const StepHook<Dim>& hook) {
  RunReport report;
  const std::vector<Motion<Dim>> begin = goal.moved_away > 0 ? state.motions : std::vector<Motion<Dim>>{};
  const long long unconverged = state.counters.unconverged;
  int at_rest = 0;

  while (true) {
    const bool changing = follow(schedule, state);
    step(model, settings, state);
    ++report.steps;
    report.unbalanced = goal.rest ? unbalanced_ratio(model, state) : -1;
    if (hook) hook(state, report.unbalanced);

    // a wrong force must not be stepped over
    if (state.counters.unconverged > unconverged) {
      report.reason = StopReason::no_contact_answer;
      report.detail = first_unanswered(model, state);
      return report;
    }
    if (!finite(state)) {
      report.reason = StopReason::not_finite;
      report.detail = fmt::format("at t = {:.6g} s", state.time);
      return report;
    }

    // rest must last, and cannot come while gravity or friction still changes
    const bool settled = goal.rest && !changing && report.unbalanced <= settings.equilibrium.unbalanced;
    at_rest = settled ? at_rest + 1 : 0;
    if (at_rest >= settings.equilibrium.window) {
      report.reason = StopReason::equilibrium;
    } else if (goal.moved_away > 0 && farthest(model, state, begin) > goal.moved_away) {
      report.reason = StopReason::moved_away;
    } else if (state.time >= goal.end_time - 1e-9 * state.time_step) {
      report.reason = StopReason::end_time;
    } else if (state.time >= goal.time_limit) {
      report.reason = StopReason::time_limit;
    } else if (goal.step_limit == 0 || report.steps < goal.step_limit) {
      continue;
    }
    return report;
  }
}

template RunReport run<2>(const Model<2>&, const Settings&, const RunGoal&, const RunSchedule&, State<2>&,
                          const StepHook<2>&);
template RunReport run<3>(const Model<3>&, const Settings&, const RunGoal&, const RunSchedule&, State<3>&,
                          const StepHook<3>&);

}  // namespace voussoir
