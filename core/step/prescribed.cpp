#include "core/step/prescribed.hpp"

#include <algorithm>

#include "core/load/ground_motion.hpp"
#include "core/load/time_factor.hpp"

namespace voussoir {
namespace {

// s, of the interval of a record: around a time at which its velocity is asked for
constexpr double instant = 1e-6;

// Mean velocity of the records over a step, m/s: their displacement is right at the end of every step, however long.
template <int Dim>
Vector<Dim> recorded_velocity(const PrescribedMotion<Dim>& prescribed, double middle, double step) {
  Vector<Dim> velocity = Vector<Dim>::Zero();
  for (const RecordedAxis<Dim>& record : prescribed.records)
    velocity += path_between(*record.motion, middle - 0.5 * step, middle + 0.5 * step) / step * record.direction;
  return velocity;
}

}  // namespace

template <int Dim>
Vector<Dim> path_of(const PrescribedMotion<Dim>& prescribed, double from, double to) {
  Vector<Dim> path = (to - from) * mean_of(prescribed.factor, from, to) * prescribed.velocity;
  for (const RecordedAxis<Dim>& record : prescribed.records)
    path += path_between(*record.motion, from, to) * record.direction;
  return path;
}

template <int Dim>
Vector<Dim> velocity_at(const PrescribedMotion<Dim>& prescribed, double time) {
  Vector<Dim> velocity = value_at(prescribed.factor, time) * prescribed.velocity;
  for (const RecordedAxis<Dim>& record : prescribed.records) {
    const double around = instant * record.motion->interval;
    velocity += path_between(*record.motion, time - around, time + around) / (2 * around) * record.direction;
  }
  return velocity;
}

template <int Dim>
Load<Dim> apply_prescribed_motion(const Body<Dim>& body, const PrescribedMotion<Dim>& prescribed, const Load<Dim>& load,
                                  double middle, StepTimes times, Motion<Dim>& motion, Kick<Dim>& kick) {
  Load<Dim> reaction;
  const double factor = value_at(prescribed.factor, middle);
  const Vector<Dim> velocity = factor * prescribed.velocity + recorded_velocity(prescribed, middle, times.drift);
  // at the start there is no earlier velocity: the present one is used
  for (int k = 0; k < Dim; ++k) {
    if (!prescribed.translation[k]) continue;
    const double after = velocity[k], before = times.at_start() ? after : motion.velocity[k];
    reaction.force[k] = -load.force[k];
    kick.path_before[k] = 0.5 * times.worked() * before;
    kick.path_after[k] = 0.5 * times.worked() * after;
    motion.velocity[k] = after;
    motion.displacement[k] += times.drift * after;
  }
  if (!prescribed.rotation) return reaction;
  const Spin<Dim> after = factor * prescribed.angular_velocity;
  const Spin<Dim> before = times.at_start() ? after : angular_velocity(body, motion);
  reaction.moment = -load.moment;
  kick.turn_before = 0.5 * times.worked() * before;
  kick.turn_after = 0.5 * times.worked() * after;
  motion.rotation = turned(motion.rotation, Spin<Dim>(times.drift * after));
  motion.angular_momentum = angular_momentum(body, motion.rotation, after);
  return reaction;
}

template <int Dim>
void stop_held(const Model<Dim>& model, std::vector<Motion<Dim>>& motions) {
  auto prescribed = model.prescribed.begin();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    const PrescribedMotion<Dim>* forced = body.prescribed ? &*prescribed++ : nullptr;
    Motion<Dim>& motion = motions[b];
    for (int k = 0; k < Dim; ++k)
      if ((body.fixed || !body.free_translation[k]) && !(forced && forced->translation[k])) motion.velocity[k] = 0;
    const bool turns = !body.fixed && std::find(body.free_rotation.begin(), body.free_rotation.end(), true) !=
                                          body.free_rotation.end();
    if (!turns && !(forced && forced->rotation)) motion.angular_momentum.setZero();
  }
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                   \
  template Vector<Dim> path_of<Dim>(const PrescribedMotion<Dim>&, double, double);                                  \
  template Vector<Dim> velocity_at<Dim>(const PrescribedMotion<Dim>&, double);                                      \
  template Load<Dim> apply_prescribed_motion<Dim>(const Body<Dim>&, const PrescribedMotion<Dim>&, const Load<Dim>&, \
                                                  double, StepTimes, Motion<Dim>&, Kick<Dim>&);                     \
  template void stop_held<Dim>(const Model<Dim>&, std::vector<Motion<Dim>>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
