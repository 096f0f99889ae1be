#include "core/implicit/implicit_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/implicit/advance.hpp"
#include "core/implicit/load_bounds.hpp"
#include "core/implicit/step_points.hpp"
#include "core/step/contacts.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/motion.hpp"
#include "core/step/static_solver_base.hpp"

namespace voussoir {
namespace {

// of the tolerance: by so much the geometry of a step may still move a body
constexpr double settled_geometry = 1e-3;

// Steps grow and shrink by the third root of the tolerance over the error, within these bounds.
constexpr double careful = 0.9, least_change = 0.2, most_change = 2;
constexpr double halved = 0.5;
constexpr int most_refusals = 60;

// of the time that is left: the first step
constexpr double first_part = 1e-3;

// m: the largest difference of two states' motions, velocities over the step
template <int Dim>
double difference(const Model<Dim>& model, double h, const State<Dim>& a, const State<Dim>& b) {
  double most = 0;
  for (std::size_t k = 0; k < model.bodies.size(); ++k) {
    const Body<Dim>& body = model.bodies[k];
    if (body.fixed || !body.present) continue;
    const Motion<Dim>&m = a.bodies.motions[k], &n = b.bodies.motions[k];
    const Spin<Dim> turn = rotation_vector(m.rotation) - rotation_vector(n.rotation),
                    spin = angular_velocity(body, m) - angular_velocity(body, n);
    most = std::max({most, (m.displacement - n.displacement).norm() + body.radius * turn.norm(),
                     h * ((m.velocity - n.velocity).norm() + body.radius * spin.norm())});
  }
  return most;
}

// velocities half a step behind, of explicit steps, are brought to the time of the positions
template <int Dim>
void catch_up(const Model<Dim>& model, State<Dim>& state) {
  if (state.time_step.length == 0) return;
  const double half = 0.5 * state.time_step.length;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    if (body.fixed || !body.present) continue;
    Motion<Dim>& m = state.bodies.motions[b];
    const Load<Dim>& load = state.loads.total[b];
    for (int k = 0; k < Dim; ++k)
      if (body.free_translation[k]) m.velocity[k] += half * load.force[k] / body.mass;
    Spin<Dim> turn = load.moment;
    for (int k = 0; k < spin_freedoms<Dim>; ++k)
      if (!body.free_rotation[k]) turn[k] = 0;
    const Spin<Dim> spin =
        angular_velocity(body, m) + Spin<Dim>(half * world_inertia<Dim>(body, m.rotation).inverse() * turn);
    m.angular_momentum = angular_momentum(body, m.rotation, spin);
  }
  state.time_step.length = 0;
}

template <int Dim>
void balance_now(const Model<Dim>& model, State<Dim>& state) {
  double kinetic = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed && model.bodies[b].present)
      kinetic += kinetic_energy(model.bodies[b], state.bodies.motions[b]);
  state.ledger.energy.kinetic = kinetic;
  balance(state.ledger.energy);
}

// what an implicit step left of the counters that a refused one cost
void add_cost(const Counters& before, const Counters& after, Counters& total) {
  for (long long Counters::*const count : {&Counters::contact_evaluations, &Counters::implicit_solutions,
                                           &Counters::implicit_iterations, &Counters::implicit_halved})
    total.*count += after.*count - before.*count;
}

// of the stated length, or in halves if that is not solved
template <int Dim>
void go(const Model<Dim>& model, const Settings& settings, double h, double within, State<Dim>& state, int depth = 0) {
  State<Dim> trial = state;
  if (advance(model, settings, h, within, trial)) {
    state = std::move(trial);
    return;
  }
  const Counters before = state.counters;
  add_cost(before, trial.counters, state.counters);
  ++state.counters.implicit_halved;
  if (depth == most_refusals) throw std::domain_error("an implicit step has no solution, however short");
  for (int half = 0; half < 2; ++half)
    go(model, settings, halved * h, within, state, depth + 1);
}

void note_step(double h, TimeStep& step) {
  step.shortest = step.shortest > 0 ? std::min(step.shortest, h) : h;
  step.longest = std::max(step.longest, h);
}

// A step and its halves, which are kept if they agree with it; otherwise nothing but the counters and the length of the
// next attempt changes.
template <int Dim>
bool try_step(const Model<Dim>& model, const Settings& settings, double h, double tolerance, State<Dim>& state) {
  const Counters before = state.counters;
  State<Dim> whole = state, halves = state;
  const double within = settled_geometry * tolerance;
  const auto carries_out = [&](double length, State<Dim>& of) { return advance(model, settings, length, within, of); };
  const bool solved = carries_out(h, whole) && carries_out(0.5 * h, halves) && carries_out(0.5 * h, halves);
  const double error = solved ? difference(model, 0.5 * h, whole, halves) : 0;
  const double factor = !solved     ? halved
                        : error > 0 ? std::clamp(careful * std::cbrt(tolerance / error), least_change, most_change)
                                    : most_change;
  const bool taken = solved && error <= tolerance;
  if (taken) {
    state = std::move(halves);
  } else {
    add_cost(before, halves.counters, state.counters);
    ++(solved ? state.counters.implicit_refused : state.counters.implicit_halved);
  }
  add_cost(before, whole.counters, state.counters);
  state.time_step.allowed = factor * h;
  return taken;
}

}  // namespace

template <int Dim>
void find_point_forces(const Model<Dim>& model, const Settings& settings, const Schedule& schedule, const JointStep&,
                       BodiesState<Dim>& bodies, ContactsState<Dim>& contacts, Ledger& ledger, Counters& counters) {
  find_contacts(model, settings, 0, bodies, contacts, counters);
  const std::vector<MeanMotion<Dim>> still(model.bodies.size());
  static thread_local StepPoints<Dim> all;
  find_step_points<Dim>(model, settings, schedule, bodies, contacts, histories_of(contacts), {still, 0, 0}, counters,
                        all);
  contacts.loads.assign(contacts.list.size(), {});
  ledger.energy.elastic = 0;
  for (Contact<Dim>& c : contacts.list)
    c.force.setZero();
  for (const StepContact<Dim>& whole : all.contacts)
    ledger.energy.elastic += whole.slipped;  // until the step
  for (const StepPoint<Dim>& p : all.points) {
    const double pressed = std::max(p.law.overlap, 0.0);
    ledger.energy.elastic += 0.5 * p.law.normal * pressed * pressed;
    if (p.law.shear > 0) ledger.energy.elastic += 0.5 * p.from.squaredNorm() / p.law.shear;
    const Vector<Dim> force = p.law.normal * pressed * p.normal + p.from;
    ContactLoad<Dim>& load = contacts.loads[p.contact];
    load.second = p.body_b;
    load.force += force;
    contacts.list[p.contact].force += force;
    load.about_first += moment(p.point, force);
    load.about_second += moment(p.from_b, force);
  }
}

template <int Dim>
void move_implicitly(const Model<Dim>& model, const Settings& settings, State<Dim>& state) {
  catch_up(model, state);
  add_ramps(model, settings, state.bodies, state.loads, state.schedule, state.ledger.energy, state.relaxation);
  balance_now(model, state);
  double ends_at = state.schedule.ends;
  if (!settings.time.step)
    ends_at = std::min({ends_at, next_bend(model, state.schedule), next_output(settings.time, state.schedule.time)});
  const double left = ends_at - state.schedule.time;
  const double tolerance = settings.time.error > 0 ? settings.time.error : default_step_error(model);
  if (settings.time.step) {
    const double h = equal_step(*settings.time.step, left);
    const double ends = h == left ? ends_at : state.schedule.time + h;
    go(model, settings, h, settled_geometry * tolerance, state);
    state.schedule.time = ends;
    return note_step(h, state.time_step);
  }
  const double longest = std::min(step_of_loads(model), left);
  if (!(state.time_step.allowed > 0)) state.time_step.allowed = std::isfinite(left) ? first_part * left : longest;
  for (int k = 0; k < most_refusals; ++k) {
    const bool by_load = state.time_step.allowed >= longest;
    const double h = equal_step(std::min(state.time_step.allowed, longest), left);
    const double ends = h == left ? ends_at : state.schedule.time + h;
    if (!try_step(model, settings, h, tolerance, state)) continue;
    ++(by_load ? state.counters.implicit_by_load : state.counters.implicit_by_error);
    state.schedule.time = ends;
    return note_step(0.5 * h, state.time_step);
  }
  throw std::domain_error("an implicit step has no solution, however short");
}

template <int Dim>
double default_step_error(const Model<Dim>& model) {
  constexpr double of_block = 1e-5;
  std::vector<double> sizes;
  for (const Body<Dim>& body : model.bodies)
    if (!body.fixed && body.present) sizes.push_back(body.size);
  if (sizes.empty()) return of_block;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::ranges::nth_element(sizes, middle);
  return of_block * *middle;
}

template <int Dim>
std::string not_followed_implicitly(const Model<Dim>& model, const Settings& settings) {
  for (const JointProperties& p : model.properties)
    if (const std::string why = not_followed_implicitly(p, settings.contact); !why.empty())
      return fmt::format("implicit steps do not follow the joint properties '{}': {}", p.name, why);
  if (settings.damping.local > 0)
    return "implicit steps have no local damping, a force against the velocity as large as the unbalanced one: set "
           "damping.local = 0; viscous_ratio acts";
  if (!model.bolts.empty() || !model.linings.empty())
    return "implicit steps do not follow bolts and linings yet: use time.integration = \"explicit\" in this stage";
  if (model.particles) return "implicit steps do not follow potential particles";
  return {};
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                             \
  template void find_point_forces<Dim>(const Model<Dim>&, const Settings&, const Schedule&, const JointStep&, \
                                       BodiesState<Dim>&, ContactsState<Dim>&, Ledger&, Counters&);           \
  template void move_implicitly<Dim>(const Model<Dim>&, const Settings&, State<Dim>&);                        \
  template double default_step_error<Dim>(const Model<Dim>&);                                                 \
  template std::string not_followed_implicitly<Dim>(const Model<Dim>&, const Settings&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
