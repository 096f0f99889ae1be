#include "core/step/integrate.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "core/base/on_threads.hpp"
#include "core/step/support_table.hpp"

namespace voussoir {
namespace {

template <int Dim>
bool all_free(const std::array<bool, Dim>& freedoms) {
  return std::all_of(freedoms.begin(), freedoms.end(), [](bool f) { return f; });
}

template <std::size_t Size>
bool none_free(const std::array<bool, Size>& freedoms) {
  return std::none_of(freedoms.begin(), freedoms.end(), [](bool f) { return f; });
}

// world axes
template <int Dim>
Spin<Dim> damped_moment(const Load<Dim>& load, double local_damping, const Spin<Dim>& spin) {
  Spin<Dim> moment = load.moment;
  if (local_damping == 0) return moment;
  for (int k = 0; k < spin_freedoms<Dim>; ++k)
    moment[k] = damped(load.moment[k], spin[k], local_damping);
  return moment;
}

// the velocity before a kick: at the start half a step earlier than the given one
template <class Velocity>
Velocity velocity_before(StepTimes times, const Velocity& given, const Velocity& after) {
  return times.at_start() ? Velocity(2 * given - after) : given;
}

template <int Dim>
void note_turn(StepTimes times, const Spin<Dim>& before, const Spin<Dim>& after, Kick<Dim>& kick) {
  kick.turn_before = 0.5 * times.worked() * before;
  kick.turn_after = 0.5 * times.worked() * after;
}

void kick_spin(const Body<2>& body, const Load<2>& load, const KickRule& rule, StepTimes times, Motion<2>& motion,
               Kick<2>& kick) {
  const Spin<2> given = angular_velocity(body, motion);
  const Spin<2> left = damped_moment(load, rule.local_damping, given);
  motion.angular_momentum = rule.keeps * motion.angular_momentum + rule.gain * times.kick * left;
  const Spin<2> after = angular_velocity(body, motion), before = velocity_before(times, given, after);
  kick.damping.moment = left - load.moment;
  note_turn(times, before, after, kick);
  kick.kinetic += 0.5 * body.inertia[0] * before[0] * after[0];
}

void drift_spin(const Body<2>& body, double dt, Motion<2>& motion) {
  motion.rotation.angle += dt * motion.angular_momentum[0] / body.inertia[0];
}

// some axes are held: the free components of the angular velocity obey the free block of the inertia tensor
void kick_partly(const Body<3>& body, const Spin<3>& moment, double keeps, double dt, Motion<3>& motion) {
  const Matrix<3> axes = matrix(motion.rotation) * body.principal_axes;
  Matrix<3> inertia = axes * body.inertia.asDiagonal() * axes.transpose();
  Spin<3> spin = angular_velocity(body, motion), kick = moment;
  for (int k = 0; k < 3; ++k) {
    if (body.free_rotation[k]) continue;
    inertia.row(k).setZero();
    inertia.col(k).setZero();
    inertia(k, k) = 1;
    kick[k] = 0;
    spin[k] = 0;
  }
  spin = keeps * spin + dt * Spin<3>(inertia.inverse() * kick);
  motion.angular_momentum = angular_momentum(body, motion.rotation, spin);
}

void kick_spin(const Body<3>& body, const Load<3>& load, const KickRule& rule, StepTimes times, Motion<3>& motion,
               Kick<3>& kick) {
  const Spin<3> given = angular_velocity(body, motion), given_momentum = motion.angular_momentum;
  const Spin<3> left = damped_moment(load, rule.local_damping, given);
  if (all_free<3>(body.free_rotation)) {
    const Matrix<3> axes = matrix(motion.rotation) * body.principal_axes;
    motion.angular_momentum = rule.keeps * motion.angular_momentum + rule.gain * times.kick * (axes.transpose() * left);
  } else {
    kick_partly(body, left, rule.keeps, rule.gain * times.kick, motion);
  }
  const Spin<3> after = angular_velocity(body, motion), before = velocity_before(times, given, after);
  kick.damping.moment = left - load.moment;
  note_turn(times, before, after, kick);
  const Spin<3> momentum_before = velocity_before(times, given_momentum, motion.angular_momentum);
  kick.kinetic += 0.5 * momentum_before.dot(motion.angular_momentum.cwiseQuotient(body.inertia));
}

// rotates the body about its principal axis k for the fraction of a step; the momentum in body axes rotates back
void turn_about(int k, double dt, const Body<3>& body, Motion<3>& motion) {
  Spin<3>& momentum = motion.angular_momentum;
  const double half_angle = 0.5 * dt * momentum[k] / body.inertia[k];
  const double c = std::cos(half_angle), s = std::sin(half_angle);
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const double mi = momentum[i], mj = momentum[j];
  // as an increment: a cosine near one is rounded in the same direction step after step, and the momentum would drift
  momentum[i] += 2 * s * (c * mj - s * mi);
  momentum[j] -= 2 * s * (c * mi + s * mj);
  const Vector<3> axis = s * body.principal_axes.col(k);
  motion.rotation.quaternion *= Quaternion(c, axis[0], axis[1], axis[2]);
}

void drift_spin(const Body<3>& body, double dt, Motion<3>& motion) {
  if (!all_free<3>(body.free_rotation)) {
    const Spin<3> spin = angular_velocity(body, motion);
    motion.rotation = turned(motion.rotation, dt * spin);
    motion.angular_momentum = angular_momentum(body, motion.rotation, spin);
    return;
  }
  turn_about(0, 0.5 * dt, body, motion);
  turn_about(1, 0.5 * dt, body, motion);
  turn_about(2, dt, body, motion);
  turn_about(1, 0.5 * dt, body, motion);
  turn_about(0, 0.5 * dt, body, motion);
  motion.rotation.quaternion.normalize();
}

// N: the force on a body and the force equivalent of its momentum, momentum times highest frequency
template <int Dim>
double unbalanced_force(const Model<Dim>& model, const State<Dim>& state, int b) {
  const Body<Dim>& body = model.bodies[b];
  if (body.fixed) return 0;
  double frequency = static_cast<std::size_t>(b) < state.time_step.frequency.size() ? state.time_step.frequency[b] : 0;
  // mass times frequency is proportional to the root of the mass
  if (frequency > 0 && state.relaxation.under_way) frequency *= std::sqrt(state.relaxation.inertia[b]);
  double squares = 0, momentum = 0;
  for (int k = 0; k < Dim; ++k) {
    if (!body.free_translation[k]) continue;
    squares += state.loads.total[b].force[k] * state.loads.total[b].force[k];
    momentum += std::pow(body.mass * state.bodies.motions[b].velocity[k], 2);
  }
  for (int k = 0; k < spin_freedoms<Dim>; ++k) {
    if (!body.free_rotation[k]) continue;
    squares += std::pow(state.loads.total[b].moment[k] / body.radius, 2);
    momentum += std::pow(state.bodies.motions[b].angular_momentum[k] / body.radius, 2);
  }
  return std::sqrt(squares) + frequency * std::sqrt(momentum);
}

// N: mean over the free bodies on which one of these sources acts
template <int Dim>
double mean_load(const Model<Dim>& model, const State<Dim>& state, std::initializer_list<Source> sources) {
  double forces = 0;
  int loaded = 0;
  for (const Source source : sources) {
    const std::vector<Load<Dim>>& loads = state.loads.by_source[source];
    for (std::size_t b = 0; b < loads.size(); ++b) {
      if (model.bodies[b].fixed || loads[b].force.isZero(0)) continue;
      forces += loads[b].force.norm();
      ++loaded;
    }
  }
  return loaded > 0 ? forces / loaded : 0;
}

// N: reference of the unbalanced force. Contacts may transfer almost nothing of the loads: a floating body touches
// nothing, and relief loads or the water in a joint may support everything that contacts supported.
template <int Dim>
double force_at_rest(const Model<Dim>& model, int threads, const State<Dim>& state) {
  const auto add_contact = [&](int i, ForceSum& sum) {
    const ContactLoad<Dim>& c = state.contacts.loads[i];
    if (c.second < 0) return;
    sum.forces += c.force.norm();
    ++sum.acting;
  };
  ForcesAtRest sums;
  for (const ForceSum& some : sums_in_groups<ForceSum>(threads, state.contacts.loads.size(), add_contact)) {
    sums.all.forces += some.forces;
    sums.all.acting += some.acting;
  }
  for (const StepSupport<Dim>& row : step_supports<Dim>)
    if (row.add_forces) row.add_forces(state.supports, sums);
  return std::max({sums.all.mean(), sums.supports.mean(), mean_load(model, state, {Source::excavation_forces}),
                   mean_load(model, state, {Source::applied_forces}),
                   mean_load(model, state, {Source::water, Source::water_pressure})});
}

}  // namespace

double damped(double force, double velocity, double local_damping) {
  if (velocity == 0) return force;
  return force - local_damping * std::abs(force) * (velocity > 0 ? 1 : -1);
}

template <int Dim>
Kick<Dim> advance(const Body<Dim>& body, const Load<Dim>& load, const KickRule& rule, StepTimes times,
                  Motion<Dim>& motion) {
  Kick<Dim> kick;
  for (int k = 0; k < Dim; ++k) {
    if (!body.free_translation[k]) continue;
    const double given = motion.velocity[k], left = damped(load.force[k], given, rule.local_damping);
    motion.velocity[k] = rule.keeps * given + rule.gain * times.kick * left / body.mass;
    const double before = velocity_before(times, given, motion.velocity[k]);
    kick.damping.force[k] = left - load.force[k];
    kick.kinetic += 0.5 * body.mass * before * motion.velocity[k];
    kick.path_before[k] = 0.5 * times.worked() * before;
    kick.path_after[k] = 0.5 * times.worked() * motion.velocity[k];
    motion.displacement[k] += times.drift * motion.velocity[k];
  }
  if (!none_free(body.free_rotation)) {
    kick_spin(body, load, rule, times, motion, kick);
    drift_spin(body, times.drift, motion);
  }
  return kick;
}

template <int Dim>
std::vector<Kick<Dim>>& advance_bodies(const Model<Dim>& model, int threads, std::span<const KickRule> rules,
                                       StepTimes times, const std::vector<Load<Dim>>& loads,
                                       std::vector<Motion<Dim>>& motions) {
  static thread_local std::vector<Kick<Dim>> own;
  std::vector<Kick<Dim>>& kicks = own;  // of this thread, filled by all
  kicks.resize(model.bodies.size());
  each_on_threads(threads, kicks.size(), [&](int b) {
    kicks[b] = model.bodies[b].fixed
                   ? Kick<Dim>()
                   : advance(model.bodies[b], loads[b], rules[rules.size() == 1 ? 0 : b], times, motions[b]);
  });
  return kicks;
}

template <int Dim>
double unbalanced_ratio(const Model<Dim>& model, int threads, const State<Dim>& state) {
  const auto raise = [&](int b, double& most) {
    if (!state.bodies.left_behind.empty() && state.bodies.left_behind[b]) return;
    most = std::max(most, unbalanced_force(model, state, b));
  };
  double largest = 0;
  for (const double of_some : sums_in_groups<double>(threads, model.bodies.size(), raise))
    largest = std::max(largest, of_some);
  if (largest == 0) return 0;
  const double mean = force_at_rest(model, threads, state);
  return mean > 0 ? largest / mean : std::numeric_limits<double>::infinity();
}

template Kick<2> advance<2>(const Body<2>&, const Load<2>&, const KickRule&, StepTimes, Motion<2>&);
template Kick<3> advance<3>(const Body<3>&, const Load<3>&, const KickRule&, StepTimes, Motion<3>&);
template std::vector<Kick<2>>& advance_bodies<2>(const Model<2>&, int, std::span<const KickRule>, StepTimes,
                                                 const std::vector<Load<2>>&, std::vector<Motion<2>>&);
template std::vector<Kick<3>>& advance_bodies<3>(const Model<3>&, int, std::span<const KickRule>, StepTimes,
                                                 const std::vector<Load<3>>&, std::vector<Motion<3>>&);
template double unbalanced_ratio<2>(const Model<2>&, int, const State<2>&);
template double unbalanced_ratio<3>(const Model<3>&, int, const State<3>&);

}  // namespace voussoir
