#include "core/implicit/load_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/multiples.hpp"

namespace voussoir {
namespace {

// of the shortest period of the loads, and of the shortest interval of their tables
constexpr double of_period = 1.0 / 40, of_interval = 1.0 / 20;

// s over one, and the time since the stage began: what is no later time but rounding
constexpr double nearly_now = 1e-12;

// s: of a factor of the time
double step_of(const TimeFactor& factor) {
  double longest = std::numeric_limits<double>::infinity();
  if (factor.frequency > 0) longest = of_period / factor.frequency;
  for (std::size_t k = 1; k < factor.times.size(); ++k)
    longest = std::min(longest, of_interval * (factor.times[k] - factor.times[k - 1]));
  return longest;
}

// of a motion: its factor, and its records
double step_of_motion(const TimeFactor& factor, const auto& records) {
  double longest = step_of(factor);
  for (const auto& record : records)
    longest = std::min(longest, record.motion->interval);
  return longest;
}

}  // namespace

template <int Dim>
double step_of_loads(const Model<Dim>& model) {
  double longest = std::numeric_limits<double>::infinity();
  for (const PrescribedMotion<Dim>& p : model.prescribed)
    longest = std::min(longest, step_of_motion(p.factor, p.records));
  for (const AppliedForce<Dim>& f : model.applied)
    longest = std::min(longest, step_of(f.factor));
  for (const OpenSide<Dim>& side : model.open_sides)
    longest = std::min(longest, step_of_motion(side.wave.factor, side.wave.records));
  return longest;
}

double step_of_loads(const Change& change) {
  double longest = std::numeric_limits<double>::infinity();
  for (const MovePlan& move : change.move)
    longest = std::min(longest, step_of_motion(move.factor, move.records));
  for (const BoundaryPlan& plan : change.boundary)
    if (plan.quiet) longest = std::min(longest, step_of_motion(plan.quiet->factor, plan.quiet->records));
  return longest;
}

// s: the next time at which a table of the loads bends, or a record has a value
template <int Dim>
double next_bend(const Model<Dim>& model, const Schedule& schedule) {
  const double now = schedule.time - schedule.started, after = now + nearly_now * (1 + now);
  double next = std::numeric_limits<double>::infinity();
  const auto look = [&](const TimeFactor& factor) {
    const auto at = std::upper_bound(factor.times.begin(), factor.times.end(), after);
    if (at != factor.times.end()) next = std::min(next, *at);
  };
  const auto look_at = [&](const auto& motion) {
    look(motion.factor);
    for (const RecordedAxis<Dim>& record : motion.records) {
      const GroundMotion& m = *record.motion;
      const double at = m.begins + std::max(std::floor((after - m.begins) / m.interval) + 1, 0.0) * m.interval;
      if (at <= m.begins + m.duration() + 0.5 * m.interval) next = std::min(next, at);
    }
  };
  for (const PrescribedMotion<Dim>& p : model.prescribed)
    look_at(p);
  for (const OpenSide<Dim>& side : model.open_sides)
    look_at(side.wave);
  for (const AppliedForce<Dim>& f : model.applied)
    look(f.factor);
  return schedule.started + next;
}

double next_output(const TimeSettings& time, double now) {
  double next = std::numeric_limits<double>::infinity();
  for (const double interval : {time.row_interval, time.frame_interval})
    if (interval > 0) next = std::min(next, next_multiple(now, interval));
  return next;
}

#define VOUSSOIR_INSTANTIATE(Dim)                        \
  template double step_of_loads<Dim>(const Model<Dim>&); \
  template double next_bend<Dim>(const Model<Dim>&, const Schedule&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
