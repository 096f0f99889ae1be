#include "core/step/motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/on_threads.hpp"
#include "core/model/water_surfaces.hpp"
#include "core/step/integrate.hpp"
#include "core/step/open_sides.hpp"
#include "core/step/prescribed.hpp"
#include "core/step/relaxation.hpp"
#include "core/step/time_step.hpp"
#include "core/step/work.hpp"

namespace voussoir {
namespace {

template <int Dim>
void add_gravity_ramp(const Model<Dim>& model, const BodiesState<Dim>& bodies, Schedule& schedule,
                      EnergyBalance& energy) {
  const double growth = schedule.gravity_factor - schedule.last_gravity_factor;
  schedule.last_gravity_factor = schedule.gravity_factor;
  if (growth == 0 || energy.phase == BalancePhase::not_begun) return;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].immobile())
      energy.flows[Source::gravity_ramp] -=
          growth * model.bodies[b].mass * model.gravity.dot(bodies.motions[b].displacement);
}

// The same bodies under the present water and under that of the step before. For a water that grows with gravity only
// its work on the bodies' motion counts, as for gravity itself.
template <int Dim>
void add_water_change(const Model<Dim>& model, int threads, const BodiesState<Dim>& bodies,
                      const LoadsBySource<Dim>& by_source, Schedule& schedule, EnergyBalance& energy,
                      Relaxation<Dim>& relaxation) {
  std::vector<Load<Dim>>& imposed = relaxation.imposed;
  imposed.clear();
  if (schedule.water == schedule.last_water && schedule.gravity_factor == schedule.last_gravity_factor) return;
  static thread_local WaterSurfaces<Dim> own_before, own_now, own_grown;
  WaterSurfaces<Dim>&before = own_before, &now = own_now, &grown = own_grown;
  find_surfaces(model, schedule.last_water, schedule.last_gravity_factor, before);
  find_surfaces(model, schedule.water, schedule.gravity_factor, now);
  if (relaxation.under_way) {
    const std::vector<Load<Dim>>& loads = by_source[model.water_by_volume ? Source::water : Source::water_pressure];
    imposed.resize(model.bodies.size());
    each_on_threads(threads, imposed.size(), [&](int b) {
      const Load<Dim> then = water_load<Dim>(model, before, b, standing(bodies.poses[b]));
      imposed[b] = {loads[b].force - then.force, loads[b].moment - then.moment};
    });
  }
  const double growth = schedule.gravity_factor - schedule.last_gravity_factor;
  find_surfaces(model, schedule.water, growth, grown);
  schedule.last_water = schedule.water;
  if (!model.water_by_volume || energy.phase == BalancePhase::not_begun) return;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].immobile() || !model.bodies[b].present) continue;
    const int body = static_cast<int>(b);
    const Standing<Dim> at = standing(bodies.poses[b]), reference{.centroid = model.bodies[b].reference};
    energy.flows[Source::water_change] +=
        water_potential<Dim>(model, now, body, at) - water_potential<Dim>(model, before, body, at);
    if (growth != 0) energy.flows[Source::water_change] -= water_potential<Dim>(model, grown, body, reference);
  }
}

template <int Dim>
Kick<Dim> kick_of_image(const Body<Dim>& body, const Motion<Dim>& of_column, const ImageOffset<Dim>& offset,
                        StepTimes times, Motion<Dim>& motion) {
  const Vector<Dim> velocity = motion.velocity;
  const Spin<Dim> spin = angular_velocity(body, motion);
  place_image(body, of_column, offset, motion);
  Kick<Dim> kick;
  kick.path_after = 0.5 * times.worked() * motion.velocity;
  kick.turn_after = 0.5 * times.worked() * angular_velocity(body, motion);
  kick.path_before = times.at_start() ? kick.path_after : Vector<Dim>(0.5 * times.worked() * velocity);
  kick.turn_before = times.at_start() ? kick.turn_after : Spin<Dim>(0.5 * times.worked() * spin);
  return kick;
}

// The images of free-field columns follow their bodies, which have moved; what the contacts put on them is taken.
template <int Dim>
void repeat_columns(const Model<Dim>& model, LoadsState<Dim>& loads, StepTimes times, std::vector<Motion<Dim>>& motions,
                    std::vector<Kick<Dim>>& kicks) {
  for (std::size_t i = 0; i < model.column_images.size(); ++i) {
    const ColumnImage<Dim>& image = model.column_images[i];
    const Load<Dim>& load = loads.total[image.body];
    loads.by_source[Source::prescribed_motion][image.body] = {-load.force, -load.moment};
    kicks[image.body] = kick_of_image(model.bodies[image.body], motions[image.of_column], loads.open_sides.images[i],
                                      times, motions[image.body]);
  }
}

}  // namespace

double equal_step(double longest, double left) {
  if (!std::isfinite(left)) return longest;
  constexpr double rounding = 1e-6;  // of a step: a million steps do not add up to one more
  return left / std::max(1.0, std::ceil(left / longest - rounding));
}

template <int Dim>
void add_ramps(const Model<Dim>& model, const Settings& settings, const BodiesState<Dim>& bodies,
               const LoadsState<Dim>& loads, Schedule& schedule, EnergyBalance& energy, Relaxation<Dim>& relaxation) {
  if (!model.waters.empty())
    add_water_change(model, settings.threads, bodies, loads.by_source, schedule, energy, relaxation);
  add_gravity_ramp(model, bodies, schedule, energy);
}

template <int Dim>
void move_bodies(const Model<Dim>& model, const Settings& settings, const Counters& counters, BodiesState<Dim>& bodies,
                 ContactsState<Dim>& contacts, LoadsState<Dim>& loads, Schedule& schedule, Ledger& ledger,
                 TimeStep& time_step, Relaxation<Dim>& relaxation) {
  if (relaxation.under_way) {
    add_ramps(model, settings, bodies, loads, schedule, ledger.energy, relaxation);
    return relax_bodies(model, settings, bodies, contacts, loads, schedule, ledger, time_step, relaxation);
  }

  // within a stage the step only shrinks, as soon as a contact is stiffer than at its choice
  const double last = time_step.length;
  if (counters.steps % steps_between_looks == 0) time_step.frequency.clear();  // equilibrium is judged by them, too
  if (const auto renewed = renew_time_step(model, settings, settings.damping, bodies, loads, contacts, time_step)) {
    time_step.allowed = time_step.allowed > 0 ? std::min(time_step.allowed, renewed->step) : renewed->step;
    demand_time_step(time_step);
  }
  time_step.length = equal_step(time_step.allowed, schedule.ends - schedule.time);

  add_ramps(model, settings, bodies, loads, schedule, ledger.energy, relaxation);
  const StepTimes times{0.5 * (last + time_step.length), time_step.length};
  const double elapsed = schedule.time + 0.5 * time_step.length - schedule.started;  // at the middle of the step
  const KickRule rule{.local_damping = settings.damping.local};
  std::vector<Kick<Dim>>& kicks =
      advance_bodies<Dim>(model, settings.threads, {&rule, 1}, times, loads.total, bodies.motions);

  std::vector<Load<Dim>>& damping = loads.by_source[Source::local_damping];
  damping.resize(rule.local_damping > 0 ? kicks.size() : 0);
  each_on_threads(settings.threads, damping.size(), [&](int b) { damping[b] = kicks[b].damping; });

  std::vector<Load<Dim>>& reactions = loads.by_source[Source::prescribed_motion];
  reactions.assign(model.prescribed.empty() ? 0 : kicks.size(), {});
  for (const PrescribedMotion<Dim>& p : model.prescribed)
    if (p.repeats < 0)
      reactions[p.body] = apply_prescribed_motion(model.bodies[p.body], p, loads.total[p.body], elapsed, times,
                                                  bodies.motions[p.body], kicks[p.body]);
  repeat_columns(model, loads, times, bodies.motions, kicks);

  add_work(model, settings.threads, kicks, loads, relaxation, ledger.energy);
  const bool ends = time_step.length == schedule.ends - schedule.time;
  schedule.time = ends ? schedule.ends : schedule.time + time_step.length;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                   \
  template void add_ramps<Dim>(const Model<Dim>&, const Settings&, const BodiesState<Dim>&, const LoadsState<Dim>&, \
                               Schedule&, EnergyBalance&, Relaxation<Dim>&);                                        \
  template void move_bodies<Dim>(const Model<Dim>&, const Settings&, const Counters&, BodiesState<Dim>&,            \
                                 ContactsState<Dim>&, LoadsState<Dim>&, Schedule&, Ledger&, TimeStep&,              \
                                 Relaxation<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
