#include "core/scene/judge_records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/load/record_measures.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr double largest_peak = 3,
                 least_peak = 1e-4;  // g: beyond the strongest records, below what instruments resolve
constexpr double of_peak = 0.01;     // a drift or a begin of so much of the peak is doubtful

const std::vector<double>& recorded_values(const GroundMotion& motion) {
  if (motion.quantity == MotionQuantity::acceleration) return motion.acceleration;
  return motion.quantity == MotionQuantity::velocity ? motion.velocity : motion.displacement;
}

void judge_motion(const RecordSpec& record, const GroundMotion& motion, std::vector<std::string>& warnings) {
  const RecordMeasures measures = measures_of(motion);
  const auto warn = [&](const char* key, const std::string& doubt) {
    warnings.push_back(complaint(record.subject, key, doubt));
  };
  if (measures.acceleration) {
    const double peak = measures.acceleration->peak / standard_gravity;
    if (peak > largest_peak || peak < least_peak)
      warn("record", fmt::format("has a peak acceleration of {:.3g} g, {:g} to {:g} is usual; is the unit right?", peak,
                                 least_peak, largest_peak));
  }
  if (measures.peak_velocity && std::abs(measures.end_velocity) > of_peak * *measures.peak_velocity)
    warn("record",
         fmt::format("ends with a velocity of {:.3g} m/s, {:.3g} % of its peak, which the ground keeps; {}",
                     measures.end_velocity, 100 * std::abs(measures.end_velocity) / *measures.peak_velocity,
                     motion.quantity == MotionQuantity::acceleration ? "is baseline = \"mean\" or \"end\" meant?"
                                                                     : "is the record cut?"));
  const std::vector<double>& values = recorded_values(motion);
  const auto larger = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto peak = std::max_element(values.begin(), values.end(), larger);
  if (std::abs(*peak) > 0 && (peak == values.begin() || peak + 1 == values.end()) &&
      motion.quantity != MotionQuantity::displacement)
    warn("record",
         fmt::format("has its peak at its {} value; is the record cut?", peak == values.begin() ? "first" : "last"));
  else if (motion.quantity != MotionQuantity::displacement && std::abs(values.front()) > of_peak * std::abs(*peak))
    warn("record", fmt::format("begins with {:.2g} % of its peak, at rest until then; is its begin cut?",
                               100 * std::abs(values.front() / *peak)));
}

// the header's azimuth, if it is a number, against the scene's
void judge_azimuth(const RecordSpec& record, std::vector<std::string>& warnings) {
  const std::string& component = record.samples.component;
  double header = 0;
  const auto [end, error] = std::from_chars(component.data(), component.data() + component.size(), header);
  if (!record.azimuth || error != std::errc() || end != component.data() + component.size()) return;
  if (!(header >= 0 && header <= 360)) return;
  constexpr double same = 0.5;  // degrees: headers state whole ones
  const double apart = std::abs(std::remainder(to_degrees(*record.azimuth) - header, 360.0));
  if (apart > same)
    warnings.push_back(complaint(
        record.subject, "azimuth_deg",
        fmt::format("differs from the {:g} in the file's header; is the component the one that is meant?", header)));
}

}  // namespace

void judge_records(const StageSpec& stage, std::vector<std::string>& warnings) {
  std::size_t next = 0;
  const auto judge = [&](const std::vector<RecordedMotion>& records) {
    for (const RecordedMotion& recorded : records) {
      const RecordSpec& record = stage.records[next++];
      const GroundMotion& motion = *recorded.motion;
      judge_motion(record, motion, warnings);
      judge_azimuth(record, warnings);
      const auto* run = std::get_if<RunPlan>(&stage.plan.plan);
      constexpr double rounding = 1e-9;
      const double ends = motion.begins + motion.duration();
      if (run && ends > run->duration * (1 + rounding))
        warnings.push_back(complaint(record.subject, "record",
                                     fmt::format("continues until {:g} s, and its stage ends at duration_s = {:g}; "
                                                 "lengthen the stage, or cut the record by to_s",
                                                 ends, run->duration)));
    }
  };
  for (const MovePlan& move : stage.plan.change.move)
    judge(move.records);
  for (const BoundaryPlan& boundary : stage.plan.change.boundary)
    if (boundary.quiet) judge(boundary.quiet->records);
}

}  // namespace voussoir
