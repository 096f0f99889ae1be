#include "core/step/motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/integrate.hpp"
#include "core/motion/prescribed.hpp"
#include "core/motion/relaxation.hpp"
#include "core/motion/time_step.hpp"
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

// gravity that grows lifts or lowers the potential energy of what has already moved
template <int Dim>
void book_gravity_ramp(const Model<Dim>& model, State<Dim>& state) {
  const double growth = state.schedule.gravity_factor - state.schedule.last_gravity_factor;
  state.schedule.last_gravity_factor = state.schedule.gravity_factor;
  if (growth == 0 || state.energy.phase == LedgerPhase::not_begun) return;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].still())
      state.energy.flows.ramp -= growth * model.bodies[b].mass * model.gravity.dot(state.motions[b].displacement);
}

// What the motion of some bodies adds to the books: kinetic energy, and flows before and after the time of the
// positions.
struct Booked {
  double kinetic = 0;
  EnergyFlows before, after;
};

void book(EnergyFlows& flows, double gravity, double boundary, double load, double damping, double prescribed) {
  flows.gravity += gravity;
  flows.boundary += boundary;
  flows.contacts += load - gravity - boundary;
  flows.local += damping;
  flows.prescribed += prescribed;
}

void add(EnergyFlows& flows, const EnergyFlows& more) {
  flows.gravity += more.gravity;
  flows.boundary += more.boundary;
  flows.contacts += more.contacts;
  flows.local += more.local;
  flows.prescribed += more.prescribed;
}

template <int Dim>
void book(const Model<Dim>& model, const State<Dim>& state, const std::vector<KickEnergy<Dim>>& kicks, int b,
          Booked& booked) {
  const Body<Dim>& body = model.bodies[b];
  if (body.still()) return;
  const KickEnergy<Dim>& kick = kicks[b];
  const Vector<Dim> gravity = weight(model, state, static_cast<std::size_t>(b));
  const BoundaryWork push = boundary_work(body, state.stances[b].axes, kick);
  booked.kinetic += kick.kinetic;
  book(booked.before, gravity.dot(kick.path_before), push.before, kick.load_before, kick.damping_before,
       kick.prescribed_before);
  book(booked.after, gravity.dot(kick.path_after), push.after, kick.load_after, kick.damping_after,
       kick.prescribed_after);
}

}  // namespace

template <int Dim>
void move_bodies(const Model<Dim>& model, const Settings& settings, State<Dim>& state) {
  if (state.relaxation.under_way) {
    book_gravity_ramp(model, state);
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

  book_gravity_ramp(model, state);
  const StepTimes times{0.5 * (last + state.time_step), state.time_step};
  const double elapsed = state.time + 0.5 * state.time_step - state.schedule.started;  // at the middle of the step
  const KickRule rule{.local_damping = settings.damping.local};
  std::vector<KickEnergy<Dim>>& kicks = advance_bodies<Dim>(model, settings.threads, {&rule, 1}, times, state);
  for (const PrescribedMotion<Dim>& p : model.prescribed)
    force(model.bodies[p.body], p, state.loads[p.body], elapsed, times, state.motions[p.body], kicks[p.body]);

  EnergyLedger& energy = state.energy;
  energy.kinetic = 0;
  EnergyFlows after;
  const auto work = [&](int b, Booked& sum) { book(model, state, kicks, b, sum); };
  for (const Booked& sum : sums_in_groups<Booked>(settings.threads, kicks.size(), work)) {
    energy.kinetic += sum.kinetic;
    add(energy.flows, sum.before);
    add(after, sum.after);
  }
  balance(energy);
  add(energy.flows, after);
  const bool ends = state.time_step == state.schedule.ends - state.time;
  state.time = ends ? state.schedule.ends : state.time + state.time_step;
}

template void move_bodies<2>(const Model<2>&, const Settings&, State<2>&);
template void move_bodies<3>(const Model<3>&, const Settings&, State<3>&);

}  // namespace voussoir
