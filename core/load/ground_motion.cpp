#include "core/load/ground_motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace voussoir {
namespace {

// from rest, exact for values that are linear in between
void integrate_from_rest(GroundMotion& motion) {
  const double h = motion.interval;
  if (motion.quantity == MotionQuantity::displacement) return;
  const std::size_t count = std::max(motion.acceleration.size(), motion.velocity.size());
  motion.displacement.assign(count, 0);
  if (motion.quantity == MotionQuantity::acceleration) motion.velocity.assign(count, 0);
  for (std::size_t i = 1; i < count; ++i) {
    const double v = motion.velocity[i - 1];
    if (motion.quantity == MotionQuantity::velocity) {
      motion.displacement[i] = motion.displacement[i - 1] + 0.5 * h * (v + motion.velocity[i]);
      continue;
    }
    const double a0 = motion.acceleration[i - 1], a1 = motion.acceleration[i];
    motion.velocity[i] = v + 0.5 * h * (a0 + a1);
    motion.displacement[i] = motion.displacement[i - 1] + h * v + h * h * (2 * a0 + a1) / 6;
  }
}

std::vector<double>& recorded(GroundMotion& motion) {
  if (motion.quantity == MotionQuantity::acceleration) return motion.acceleration;
  return motion.quantity == MotionQuantity::velocity ? motion.velocity : motion.displacement;
}

double largest_magnitude(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values)
    most = std::max(most, std::abs(value));
  return most;
}

// takes off p + q t
void take_off(GroundMotion& motion, double p, double q) {
  std::vector<double>& values = recorded(motion);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] -= p + q * (motion.interval * static_cast<double>(i));
  motion.taken_off = std::max(std::abs(p), std::abs(p + q * motion.duration()));
  integrate_from_rest(motion);
}

void correct(GroundMotion& motion, Baseline baseline) {
  const double D = motion.duration(), d = motion.displacement.back();
  if (motion.quantity == MotionQuantity::velocity && baseline == Baseline::mean) take_off(motion, d / D, 0);
  if (motion.quantity != MotionQuantity::acceleration) return;
  const double v = motion.velocity.back();
  if (baseline == Baseline::mean) take_off(motion, v / D, 0);
  if (baseline == Baseline::end) take_off(motion, (6 * d - 2 * v * D) / (D * D), (6 * v * D - 12 * d) / (D * D * D));
}

// the path between two times after value i, within its interval
double path_within(const GroundMotion& motion, std::size_t i, double from, double to) {
  const double h = motion.interval, length = to - from;
  if (motion.quantity == MotionQuantity::displacement)
    return length / h * (motion.displacement[i + 1] - motion.displacement[i]);
  if (motion.quantity == MotionQuantity::velocity)
    return length * (motion.velocity[i] + 0.5 * (from + to) / h * (motion.velocity[i + 1] - motion.velocity[i]));
  const double rise = (motion.acceleration[i + 1] - motion.acceleration[i]) / h;
  return length * (motion.velocity[i] + 0.5 * motion.acceleration[i] * (from + to) +
                   rise * (from * from + from * to + to * to) / 6);
}

}  // namespace

ValueRange values_kept(std::size_t count, double interval, const RecordTreatment& treatment) {
  constexpr double same = 1e-6;  // of an interval: a time that is meant to be that of a value
  const auto last = static_cast<double>(count) - 1;
  const double first = std::clamp(std::ceil(treatment.from / interval - same), 0.0, last + 1);
  const double end = treatment.to ? std::clamp(std::floor(*treatment.to / interval + same), -1.0, last) : last;
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(std::max(end + 1, first))};
}

GroundMotion make_ground_motion(MotionQuantity quantity, double interval, const std::vector<double>& values,
                                const RecordTreatment& treatment) {
  const ValueRange kept = values_kept(values.size(), interval, treatment);
  assert(kept.end - kept.first >= 2);
  GroundMotion motion;
  motion.quantity = quantity;
  motion.interval = interval;
  motion.begins = treatment.pad;
  std::vector<double>& own = recorded(motion);
  own.assign(values.begin() + static_cast<std::ptrdiff_t>(kept.first),
             values.begin() + static_cast<std::ptrdiff_t>(kept.end));
  const double origin = quantity == MotionQuantity::displacement ? own.front() : 0;
  for (double& value : own)
    value = treatment.scale * (value - origin);
  integrate_from_rest(motion);
  motion.stated_peak = largest_magnitude(own);
  motion.stated_end_velocity = motion.velocity.empty() ? 0 : motion.velocity.back();
  motion.stated_end_displacement = motion.displacement.back();
  correct(motion, treatment.baseline);
  return motion;
}

double path_between(const GroundMotion& motion, double from, double to) {
  from = std::max(from - motion.begins, 0.0);
  to = to - motion.begins;
  if (to <= from) return 0;
  const double duration = motion.duration();
  double path = 0;
  if (to > duration) {
    if (!motion.velocity.empty()) path = motion.velocity.back() * (to - std::max(from, duration));
    if (from >= duration) return path;
    to = duration;
  }
  const auto interval_at = [&](double time) {
    return std::min(static_cast<std::size_t>(time / motion.interval), motion.displacement.size() - 2);
  };
  const std::size_t i = interval_at(from), j = interval_at(to);
  const double after_i = from - motion.interval * static_cast<double>(i);
  const double after_j = to - motion.interval * static_cast<double>(j);
  if (i == j) return path + path_within(motion, i, after_i, after_j);
  path += path_within(motion, i, after_i, motion.interval);
  path += motion.displacement[j] - motion.displacement[i + 1];
  return path + path_within(motion, j, 0, after_j);
}

}  // namespace voussoir
