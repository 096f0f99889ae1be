// Other mechanisms that fail near the first design point. One that is missed makes first order and importance sampling
// too low without a sign of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/probability/design_point.hpp"

namespace voussoir {

struct OtherPointsRequest {
  std::uint64_t seed = 0;
  int pilots = 200;
  int most_starts = 4;
  LimitFunction failed{};       // of the pilots, whose sign alone counts; empty: g
  DesignPointRequest search{};  // of every further search; its start is not used
};

// a row of the search, no part of any estimate
struct PilotRow {
  StandardPoint u;
  StateAnswer answer;
};

struct OtherPoints {
  std::vector<DesignPoint> points;  // the first one included, by rising beta
  int evaluations = 0;              // pilots and searches
  int pilots = 0, starts = 0;
  std::vector<PilotRow> history;  // the pilots
  int lost = 0;                   // starts that led to no point: the answer jumps there, or has gaps
  // modes that failed among the pilots and have no point: from `behind` ones a search ended at a point above, so that
  // they fail nowhere nearer
  std::vector<std::string> modes_behind, modes_without;
};

// Pilot rows spread by max(1, (β + 1)/√keys); a failed one that no known half-space α·u >= β explains, α = u*/β,
// starts a search, the nearest first; so does a mode that failed and has no design point. A point is kept if it is
// farther than 0.3 β from the others and Φ(-β) above a thousandth of theirs. Row k depends on (seed, k) alone. For a
// reversed first point hand -g over, as to its search.
OtherPoints find_other_design_points(const LimitFunction& g, const DesignPoint& first,
                                     const OtherPointsRequest& request);

}  // namespace voussoir
