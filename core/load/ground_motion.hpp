// From recorded values to a motion of the ground, and its displacement within any step.
#pragma once

#include <optional>
#include <vector>

#include "core/base/ground_motion.hpp"

namespace voussoir {

// none: as recorded. mean: a constant is taken off, so that the velocity (of recorded velocities the displacement) is
// zero at the end. end: of accelerations the straight line p + q t that makes velocity and displacement zero at the
// end: of all such corrections the one of least ∫c² dt.
enum class Baseline { none, mean, end };

struct RecordTreatment {
  double scale = 1;            // of the values; negative: reversed
  double from = 0;             // s of the record: values before are left out
  std::optional<double> to{};  // s: values after are left out
  double pad = 0;              // s of rest before the record
  Baseline baseline = Baseline::none;
};

// The values that the treatment leaves, by number: the first, and one after the last.
struct ValueRange {
  std::size_t first = 0, end = 0;
};
ValueRange values_kept(std::size_t count, double interval, const RecordTreatment& treatment);

// At least two values must be kept, in SI units. Integration is exact for values that are linear in between:
// v += h (a0 + a1)/2, d += v h + h² (2 a0 + a1)/6.
GroundMotion make_ground_motion(MotionQuantity quantity, double interval, const std::vector<double>& values,
                                const RecordTreatment& treatment);

// m: the displacement at one time less that at an earlier one, times in s since the stage began. Without cancellation
// however short the step.
double path_between(const GroundMotion& motion, double from, double to);

}  // namespace voussoir
