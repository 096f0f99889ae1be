#include "core/motion/prescribed.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voussoir {
double value_at(const TimeFactor& factor, double time) {
  double value = 1;
  if (!factor.times.empty()) {
    const auto later = std::upper_bound(factor.times.begin(), factor.times.end(), time);
    const auto i = later - factor.times.begin();
    if (later == factor.times.begin())
      value = factor.factors.front();
    else if (later == factor.times.end())
      value = factor.factors.back();
    else
      value = factor.factors[i - 1] + (factor.factors[i] - factor.factors[i - 1]) *
                                          ((time - factor.times[i - 1]) / (factor.times[i] - factor.times[i - 1]));
  }
  if (factor.frequency > 0) value *= std::sin(2 * std::numbers::pi * factor.frequency * time + factor.phase);
  return value;
}

template <int Dim>
Load<Dim> apply_prescribed_motion(const Body<Dim>& body, const PrescribedMotion<Dim>& prescribed, const Load<Dim>& load,
                                  double middle, StepTimes times, Motion<Dim>& motion, Kick<Dim>& kick) {
  Load<Dim> reaction;
  const double factor = value_at(prescribed.factor, middle);
  // at the start there is no velocity before: it counts as having moved so already
  for (int k = 0; k < Dim; ++k) {
    if (!prescribed.translation[k]) continue;
    const double after = factor * prescribed.velocity[k], before = times.at_start() ? after : motion.velocity[k];
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
void stop_held(const Model<Dim>& model, State<Dim>& state) {
  auto prescribed = model.prescribed.begin();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    const PrescribedMotion<Dim>* forced = body.prescribed ? &*prescribed++ : nullptr;
    Motion<Dim>& motion = state.motions[b];
    for (int k = 0; k < Dim; ++k)
      if ((body.fixed || !body.free_translation[k]) && !(forced && forced->translation[k])) motion.velocity[k] = 0;
    const bool turns = !body.fixed && std::find(body.free_rotation.begin(), body.free_rotation.end(), true) !=
                                          body.free_rotation.end();
    if (!turns && !(forced && forced->rotation)) motion.angular_momentum.setZero();
  }
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                   \
  template Load<Dim> apply_prescribed_motion<Dim>(const Body<Dim>&, const PrescribedMotion<Dim>&, const Load<Dim>&, \
                                                  double, StepTimes, Motion<Dim>&, Kick<Dim>&);                     \
  template void stop_held<Dim>(const Model<Dim>&, State<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
