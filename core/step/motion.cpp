#include "core/step/motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/integrate.hpp"
#include "core/motion/prescribed.hpp"
#include "core/motion/relaxation.hpp"
#include "core/motion/time_step.hpp"
#include "core/motion/work.hpp"
#include "core/on_threads.hpp"

namespace voussoir {
namespace {

// The next step of a motion: as long as allowed, or as much shorter as lets equal steps end the run when it shall end.
template <int Dim>
double next_step(const State<Dim>& state) {
  if (!std::isfinite(state.schedule.ends)) return state.step_allowed;
  constexpr double rounding = 1e-6;  // of a step: a million steps do not sum up to one more
  const double left = state.schedule.ends - state.time;
  return left / std::max(1.0, std::ceil(left / state.step_allowed - rounding));
}

}  // namespace

template <int Dim>
void add_gravity_ramp(const Model<Dim>& model, State<Dim>& state) {
  const double growth = state.schedule.gravity_factor - state.schedule.last_gravity_factor;
  state.schedule.last_gravity_factor = state.schedule.gravity_factor;
  if (growth == 0 || state.energy.phase == LedgerPhase::not_begun) return;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].immobile())
      state.energy.flows[Source::gravity_ramp] -=
          growth * model.bodies[b].mass * model.gravity.dot(state.motions[b].displacement);
}

template <int Dim>
void move_bodies(const Model<Dim>& model, const Settings& settings, State<Dim>& state) {
  if (state.relaxation.under_way) {
    add_gravity_ramp(model, state);
    return relax_bodies(model, settings, state);
  }

  // within a stage the step only shrinks, as soon as a contact is stiffer than it was chosen for
  const double last = state.time_step;
  if (state.counters.steps % steps_between_looks == 0) state.frequency.clear();  // rest is judged by them, too
  if (const auto renewed = renew_time_step(model, settings, settings.damping, state)) {
    state.step_allowed = state.step_allowed > 0 ? std::min(state.step_allowed, renewed->step) : renewed->step;
    demand_time_step(state);
  }
  state.time_step = next_step(state);

  add_gravity_ramp(model, state);
  const StepTimes times{0.5 * (last + state.time_step), state.time_step};
  const double elapsed = state.time + 0.5 * state.time_step - state.schedule.started;  // at the middle of the step
  const KickRule rule{.local_damping = settings.damping.local};
  std::vector<Kick<Dim>>& kicks = advance_bodies<Dim>(model, settings.threads, {&rule, 1}, times, state);

  std::vector<Load<Dim>>& damping = state.loads_of[Source::local_damping];
  damping.resize(rule.local_damping > 0 ? kicks.size() : 0);
  each_on_threads(settings.threads, damping.size(), [&](int b) { damping[b] = kicks[b].damping; });

  std::vector<Load<Dim>>& reactions = state.loads_of[Source::prescribed_motion];
  reactions.assign(model.prescribed.empty() ? 0 : kicks.size(), {});
  for (const PrescribedMotion<Dim>& p : model.prescribed)
    reactions[p.body] = apply_prescribed_motion(model.bodies[p.body], p, state.loads[p.body], elapsed, times,
                                                state.motions[p.body], kicks[p.body]);

  add_work(model, settings.threads, kicks, state);
  const bool ends = state.time_step == state.schedule.ends - state.time;
  state.time = ends ? state.schedule.ends : state.time + state.time_step;
}

template void add_gravity_ramp<2>(const Model<2>&, State<2>&);
template void add_gravity_ramp<3>(const Model<3>&, State<3>&);
template void move_bodies<2>(const Model<2>&, const Settings&, State<2>&);
template void move_bodies<3>(const Model<3>&, const Settings&, State<3>&);

}  // namespace voussoir
