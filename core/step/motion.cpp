#include "core/step/motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/on_threads.hpp"
#include "core/model/water_surfaces.hpp"
#include "core/step/integrate.hpp"
#include "core/step/prescribed.hpp"
#include "core/step/relaxation.hpp"
#include "core/step/time_step.hpp"
#include "core/step/work.hpp"

namespace voussoir {
namespace {

// The next step of a motion: as long as allowed, or as much shorter as lets equal steps end the run when it shall end.
template <int Dim>
double next_step(const State<Dim>& state) {
  if (!std::isfinite(state.schedule.ends)) return state.time_step.allowed;
  constexpr double rounding = 1e-6;  // of a step: a million steps do not sum up to one more
  const double left = state.schedule.ends - state.schedule.time;
  return left / std::max(1.0, std::ceil(left / state.time_step.allowed - rounding));
}

template <int Dim>
void add_gravity_ramp(const Model<Dim>& model, State<Dim>& state) {
  const double growth = state.schedule.gravity_factor - state.schedule.last_gravity_factor;
  state.schedule.last_gravity_factor = state.schedule.gravity_factor;
  if (growth == 0 || state.ledger.energy.phase == LedgerPhase::not_begun) return;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].immobile())
      state.ledger.energy.flows[Source::gravity_ramp] -=
          growth * model.bodies[b].mass * model.gravity.dot(state.bodies.motions[b].displacement);
}

// The same bodies under the water of now and under that of the step before. Of a water that grows with gravity counts
// what it puts into the bodies' motion, as of gravity itself.
template <int Dim>
void add_water_change(const Model<Dim>& model, int threads, State<Dim>& state) {
  Schedule& schedule = state.schedule;
  std::vector<Load<Dim>>& imposed = state.relaxation.imposed;
  imposed.clear();
  if (schedule.water == schedule.last_water && schedule.gravity_factor == schedule.last_gravity_factor) return;
  static thread_local WaterSurfaces<Dim> own_before, own_now, own_grown;
  WaterSurfaces<Dim>&before = own_before, &now = own_now, &grown = own_grown;
  find_surfaces(model, schedule.last_water, schedule.last_gravity_factor, before);
  find_surfaces(model, schedule.water, schedule.gravity_factor, now);
  if (state.relaxation.under_way) {
    const std::vector<Load<Dim>>& loads =
        state.loads.by_source[model.water_by_volume ? Source::water : Source::water_pressure];
    imposed.resize(model.bodies.size());
    each_on_threads(threads, imposed.size(), [&](int b) {
      const Load<Dim> then = water_load<Dim>(model, before, b, standing(state.bodies.poses[b]));
      imposed[b] = {loads[b].force - then.force, loads[b].moment - then.moment};
    });
  }
  const double growth = schedule.gravity_factor - schedule.last_gravity_factor;
  find_surfaces(model, schedule.water, growth, grown);
  schedule.last_water = schedule.water;
  if (!model.water_by_volume || state.ledger.energy.phase == LedgerPhase::not_begun) return;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].immobile() || !model.bodies[b].present) continue;
    const int body = static_cast<int>(b);
    const Standing<Dim> at = standing(state.bodies.poses[b]), reference{.centroid = model.bodies[b].reference};
    state.ledger.energy.flows[Source::water_change] +=
        water_potential<Dim>(model, now, body, at) - water_potential<Dim>(model, before, body, at);
    if (growth != 0)
      state.ledger.energy.flows[Source::water_change] -= water_potential<Dim>(model, grown, body, reference);
  }
}

}  // namespace

template <int Dim>
void add_ramps(const Model<Dim>& model, const Settings& settings, State<Dim>& state) {
  if (!model.waters.empty()) add_water_change(model, settings.threads, state);
  add_gravity_ramp(model, state);
}

template <int Dim>
void move_bodies(const Model<Dim>& model, const Settings& settings, State<Dim>& state) {
  if (state.relaxation.under_way) {
    add_ramps(model, settings, state);
    return relax_bodies(model, settings, state);
  }

  // within a stage the step only shrinks, as soon as a contact is stiffer than it was chosen for
  const double last = state.time_step.length;
  if (state.counters.steps % steps_between_looks == 0)
    state.time_step.frequency.clear();  // rest is judged by them, too
  if (const auto renewed = renew_time_step(model, settings, settings.damping, state)) {
    state.time_step.allowed =
        state.time_step.allowed > 0 ? std::min(state.time_step.allowed, renewed->step) : renewed->step;
    demand_time_step(state);
  }
  state.time_step.length = next_step(state);

  add_ramps(model, settings, state);
  const StepTimes times{0.5 * (last + state.time_step.length), state.time_step.length};
  const double elapsed =
      state.schedule.time + 0.5 * state.time_step.length - state.schedule.started;  // at the middle of the step
  const KickRule rule{.local_damping = settings.damping.local};
  std::vector<Kick<Dim>>& kicks = advance_bodies<Dim>(model, settings.threads, {&rule, 1}, times, state);

  std::vector<Load<Dim>>& damping = state.loads.by_source[Source::local_damping];
  damping.resize(rule.local_damping > 0 ? kicks.size() : 0);
  each_on_threads(settings.threads, damping.size(), [&](int b) { damping[b] = kicks[b].damping; });

  std::vector<Load<Dim>>& reactions = state.loads.by_source[Source::prescribed_motion];
  reactions.assign(model.prescribed.empty() ? 0 : kicks.size(), {});
  for (const PrescribedMotion<Dim>& p : model.prescribed)
    reactions[p.body] = apply_prescribed_motion(model.bodies[p.body], p, state.loads.total[p.body], elapsed, times,
                                                state.bodies.motions[p.body], kicks[p.body]);

  add_work(model, settings.threads, kicks, state);
  const bool ends = state.time_step.length == state.schedule.ends - state.schedule.time;
  state.schedule.time = ends ? state.schedule.ends : state.schedule.time + state.time_step.length;
}

template void add_ramps<2>(const Model<2>&, const Settings&, State<2>&);
template void add_ramps<3>(const Model<3>&, const Settings&, State<3>&);
template void move_bodies<2>(const Model<2>&, const Settings&, State<2>&);
template void move_bodies<3>(const Model<3>&, const Settings&, State<3>&);

}  // namespace voussoir
