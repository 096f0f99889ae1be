// Work done by the contact kernels, summed into the state's counters.
#pragma once

namespace voussoir {

struct KernelCounters {
  long long evaluations = 0;   // pairs evaluated
  long long motion_skips = 0;  // not evaluated: too far apart for the bodies' motion (core/step/neighbours)
  long long axis_hits = 0;     // still separated by the axis of the step before
  long long point_hits = 0;    // still touching at the point of the step before
  long long cold_starts = 0;   // resolved without a start
  long long undecided = 0;     // nearer to touching than rounding resolves
  long long lp_solves = 0;
  long long lp_pivots = 0;
  long long newton_iterations = 0;
  long long areas = 0;
  long long normal_fallbacks = 0;  // normals taken from a face or from the LP's multipliers
  long long deep_overlaps = 0;     // overlaps beyond the potential particle's radius
};

}  // namespace voussoir
