#include "core/step/relaxation.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/on_threads.hpp"
#include "core/step/integrate.hpp"
#include "core/step/time_step.hpp"
#include "core/step/work.hpp"

namespace voussoir {
namespace {

// The step as a fraction of a body's stability limit: near one, since the work is proportional to its inverse. A body
// that may rotate takes less: its face's contact point moves as it rocks, which makes rocking up to √3 times as fast as
// the limit assumes (in 2-D: the centre of a contact of width w and overlap u, rotated by θ, moves by θ w²/(4u); moment
// k w³ θ/4).
constexpr double fraction_of_limit = 0.9, fraction_turning = 0.5;

// A body at rest first gets only this fraction of a kick: blocks that just touch have no joint yet, and slip before it
// closes would meet no resistance.
constexpr double nudge = 1e-3;

// Lower bound of damping times step. Sliding meets no stiffness, so a body sliding at constant speed would never stop;
// this stops it in a thousand steps. Less than the critical damping of a column of 2,000 blocks.
constexpr double least_damping = 1e-3;

// Steps between two renewals of every body's inertia; bodies that outgrow their rating do not wait for it. Inertia kept
// from a stiffer state lets a stack oscillate before equilibrium, and oscillations reduce shear by slip: with a hundred
// steps the top block of the case overhang rotated by 0.16 % too little, with twenty by 0.04 %, with ten by 0.01 %.
constexpr int steps_between_renewals = 10;

// differences of relaxation and motion: the time step, and the energy removed by stopping
void change_ways(EnergyBalance& energy, TimeStep& time_step) {
  time_step.frequency.clear();
  time_step.allowed = 0;
  if (energy.phase == BalancePhase::running) energy.phase = BalancePhase::model_changed;
}

template <int Dim>
double fraction_of_own_limit(const Body<Dim>& body) {
  return std::any_of(body.free_rotation.begin(), body.free_rotation.end(), [](bool free) { return free; })
             ? fraction_turning
             : fraction_of_limit;
}

// The inertia for which a body's limit 2/ω times its fraction is the common step, with stiffness increased by the area
// margin. A body keeps its own until one of its contacts outgrows its rating; at every tenth step all are renewed.
template <int Dim>
void scale_inertia(const Model<Dim>& model, const Settings& settings, const BodiesState<Dim>& bodies,
                   const LoadsState<Dim>& loads, ContactsState<Dim>& contacts, TimeStep& time_step,
                   Relaxation<Dim>& relaxation) {
  if (relaxation.until_renewal-- == 0) time_step.frequency.clear();
  if (time_step.frequency.empty()) relaxation.until_renewal = steps_between_renewals;
  const auto renewed = renew_time_step(model, settings, {.viscous_ratio = 0}, bodies, loads, contacts, time_step);
  if (!renewed) return;
  if (time_step.allowed == 0)
    time_step.allowed =
        settings.time.step.value_or(std::isfinite(renewed->limit) ? fraction_of_limit * renewed->limit : 0);
  demand_time_step(time_step);
  // a body that was not updated still has its frequency, and so the same inertia to the bit
  relaxation.inertia.assign(model.bodies.size(), 1);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const double to_limit = 0.5 * time_step.allowed * time_step.frequency[b] / fraction_of_own_limit(model.bodies[b]);
    if (to_limit > 0) relaxation.inertia[b] = area_margin * to_limit * to_limit;
  }
}

// Critical damping of the present motion, 1/s, by Rayleigh's quotient: K v is the decrease of the forces of contacts
// and water over the last step, except the part imposed by rising or falling water; relief loads are imposed. Sums in
// the order of the bodies.
template <int Dim>
double critical_damping(const Model<Dim>& model, const Schedule& schedule, const BodiesState<Dim>& bodies,
                        const LoadsState<Dim>& loads, double dt, Relaxation<Dim>& r) {
  const bool first = r.contact_load.size() != model.bodies.size();
  r.contact_load.resize(model.bodies.size());
  double stiffness = 0, inertia = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].fixed) continue;
    const Motion<Dim>& m = bodies.motions[b];
    const Spin<Dim> spin = angular_velocity(model.bodies[b], m);
    Load<Dim> now{loads.total[b].force - weight(model, schedule, b), loads.total[b].moment};
    if (const std::vector<Load<Dim>>& held = loads.by_source[Source::excavation_forces]; !held.empty()) {
      now.force -= held[b].force;
      now.moment -= held[b].moment;
    }
    const bool counts =
        bodies.left_behind.empty() || !bodies.left_behind[b];  // else falling bodies would end all damping
    if (!first && counts) {
      stiffness -= m.velocity.dot(now.force - r.contact_load[b].force);
      stiffness -= spin.dot(now.moment - r.contact_load[b].moment);
      if (!r.imposed.empty()) stiffness += m.velocity.dot(r.imposed[b].force) + spin.dot(r.imposed[b].moment);
    }
    if (counts)
      inertia += r.inertia[b] * (model.bodies[b].mass * m.velocity.squaredNorm() +
                                 m.angular_momentum.dot(m.angular_momentum.cwiseQuotient(model.bodies[b].inertia)));
    r.contact_load[b] = now;
  }
  const double least = least_damping / dt, most = 4 / dt;  // 2 ω at the stability limit
  if (!(stiffness > 0 && inertia > 0)) return least;
  return std::clamp(2 * std::sqrt(stiffness / (inertia * dt)), least, most);
}

template <int Dim>
bool at_rest(const Motion<Dim>& m) {
  return m.velocity.isZero(0) && m.angular_momentum.isZero(0);
}

bool at_constant_rate(const StagePlan& stage) {
  const auto* plan = std::get_if<ReducePlan>(&stage.plan);
  return plan && (plan->method == ReductionMethod::rate || plan->method == ReductionMethod::two_rates);
}

}  // namespace

bool begins_relaxing(const StagePlan& stage, const StaticsSettings& statics) {
  return relaxes(!std::holds_alternative<RunPlan>(stage.plan), statics);
}

bool ends_relaxed(const StagePlan& stage, const StaticsSettings& statics) {
  return begins_relaxing(stage, statics) && !at_constant_rate(stage);
}

template <int Dim>
void begin_relaxation(State<Dim>& state) {
  stop(state.bodies.motions);
  change_ways(state.ledger.energy, state.time_step);
  for (const Source of_motion : {Source::local_damping, Source::prescribed_motion})
    state.loads.by_source[of_motion].clear();
  state.relaxation = {};
  state.increment = {};
  state.relaxation.under_way = true;
}

template <int Dim>
void end_relaxation(State<Dim>& state) {
  stop(state.bodies.motions);
  state.loads.by_source[Source::relaxation].clear();
  change_ways(state.ledger.energy, state.time_step);
  state.relaxation = {};
  state.increment = {};
  state.relaxation.rested = true;
}

template <int Dim>
void begin_motion(TimeStep& time_step, Relaxation<Dim>& relaxation) {
  if (!relaxation.rested) return;
  relaxation.rested = false;
  time_step.length = 0;
}

template <int Dim>
void relax_bodies(const Model<Dim>& model, const Settings& settings, BodiesState<Dim>& bodies,
                  ContactsState<Dim>& contacts, LoadsState<Dim>& loads, Schedule& schedule, Ledger& ledger,
                  TimeStep& time_step, Relaxation<Dim>& relaxation) {
  scale_inertia(model, settings, bodies, loads, contacts, time_step, relaxation);
  const double dt = time_step.allowed;
  const double half = 0.5 * dt * critical_damping(model, schedule, bodies, loads, dt, relaxation);

  // the kick is centred: damping acts at the mean of the velocities before and after it
  static thread_local std::vector<KickRule> rules;
  rules.clear();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const double fraction = at_rest(bodies.motions[b]) ? nudge : 1;
    rules.push_back({.keeps = (1 - half) / (1 + half), .gain = fraction / (relaxation.inertia[b] * (1 + half))});
  }
  const auto& kicks = advance_bodies<Dim>(model, settings.threads, rules, {dt, dt}, loads.total, bodies.motions);
  std::vector<Load<Dim>>& taken = loads.by_source[Source::relaxation];  // all work of the loads
  taken.resize(model.bodies.size());
  each_on_threads(settings.threads, taken.size(), [&](int b) {
    taken[b] = {-loads.total[b].force, -loads.total[b].moment};
  });
  add_work(model, settings.threads, kicks, loads, relaxation, ledger.energy);
  time_step.length = dt;
  schedule.time += dt;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                             \
  template void begin_relaxation<Dim>(State<Dim>&);                                                           \
  template void end_relaxation<Dim>(State<Dim>&);                                                             \
  template void begin_motion<Dim>(TimeStep&, Relaxation<Dim>&);                                               \
  template void relax_bodies<Dim>(const Model<Dim>&, const Settings&, BodiesState<Dim>&, ContactsState<Dim>&, \
                                  LoadsState<Dim>&, Schedule&, Ledger&, TimeStep&, Relaxation<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
