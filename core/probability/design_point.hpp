// First-order reliability: the design point u* is the failed point nearest to the medians u = 0, β = |u*|, and the
// probability of failure about Φ(-β) (Hasofer & Lind 1974; Rackwitz & Fiessler 1978).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/probability/limit_state.hpp"

namespace voussoir {

struct DesignPoint {
  StandardPoint u;
  double beta = 0;  // |u|; of a reversed search -|u|
  double g = 0;     // of the function searched, in its last answer: where g is smooth, `tolerance` away at most
  // those that hold the point where it is; one: g is smooth there; two or more: a kink, where all of them must fail
  std::vector<FailedHalfSpace> pieces;
  std::string mode;  // the mechanism's name there
  int iterations = 0;
};

struct DesignPointRequest {
  // Of the forward differences, in u; about 0.3 for answers that are brackets. Of exact answers they shrink as the
  // search closes in, to 1e-3.
  double step = 0.1;
  double tolerance = 1e-3;  // of u relative to max(1, |u|), of g relative to g at the medians or its change by one u
  // The width to which g is known; 0: to all digits. No smaller |g| is asked for, and the tolerance is at least
  // twice this, relative to the same.
  double bracket = 0;
  int most_iterations = 40;            // of the first try
  StandardPoint start;                 // empty: the medians
  std::optional<double> g_at_medians;  // if it is known: saves an evaluation
  // The medians fail: the caller hands -g over, so that the point searched is the nearest that stands, and beta is told
  // negative. Nothing else changes: g, pieces and modes are those of the function handed over.
  bool reversed = false;
};

struct DesignPointSearch {
  std::optional<DesignPoint> found;
  std::string reason;  // a sentence, if nothing was found
  StandardPoint last;  // where the search ended
  int evaluations = 0;
  std::vector<StandardPoint> looked_at;  // by iteration
};

// FORM with memory: the next point is the nearest to the medians that all of the last linearisations call failed. With
// one of them this is the method of Hasofer, Lind, Rackwitz & Fiessler, which does not converge at kinks and cycles
// where g = 0 curves much. A batch is a point and its differences, keys + 1 points; a step on which |g| grows or that
// ends without an answer is halved, at the cost of a point each. If this finds none, a search from where it ended takes
// half steps without memory, then one with differences three times as wide; each at most half as long. Precondition:
// keys > 0.
DesignPointSearch find_design_point(const LimitFunction& g, std::size_t keys, const DesignPointRequest& request);

// First-order probability of failure: Φ(-β) of one piece, Φ₂ of two that must both fail; none for more. Of a reversed
// point 1 minus these, for they are probabilities to stand.
std::optional<double> probability_of_pieces(const DesignPoint& point);

}  // namespace voussoir
