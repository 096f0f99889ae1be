// Importance sampling around design points: rows u from h, the mean of unit normals at the points u*_k; the estimate is
// the mean of φ(u)/h(u) over all rows, counted 0 where a row stands. Free of bias wherever the points are.
#pragma once

#include <cstdint>
#include <vector>

#include "core/probability/design_point.hpp"

namespace voussoir {

struct SamplingRequest {
  std::uint64_t seed = 0;
  double target = 0.1;  // error/probability at which it stops, but not before 50 rows failed
  int most_rows = 20000;
  int batch = 50;  // rows asked for at once
};

struct SamplingRow {
  StandardPoint u;
  double weight = 0;  // φ/h, also of a row that stands
  bool failed = false;
  bool answered = true;
};

struct SamplingEstimate {
  double probability = 0;
  double error = 0;          // standard error of it
  double low = 0, high = 1;  // 95 %: p exp(±1.96 error/p); 0 to 1 if nothing failed
  int rows = 0, failed = 0;
  int unanswered = 0;    // rows without an answer; they are counted as standing
  bool reached = false;  // the target
  std::vector<SamplingRow> history;
};

// Row k is drawn at point k modulo their number and depends on (seed, k) alone. The sign of g decides. Where the
// medians fail the caller passes -g and the points found with it, and the estimate is the probability to stand.
// Precondition: at least one point.
SamplingEstimate sample_by_importance(const LimitFunction& g, const std::vector<DesignPoint>& points,
                                      const SamplingRequest& request);

}  // namespace voussoir
