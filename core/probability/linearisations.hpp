// The memory of a search for a design point: linearisations of g at the last points it looked at.
#pragma once

#include <string>
#include <vector>

#include "core/probability/nearest_point.hpp"

namespace voussoir {

// an answer and its differences at a point
struct LocalAnswer {
  StandardPoint u, gradient;
  double g = 0;
  std::string mode;
};

struct Linearisation {
  FailedHalfSpace half_space;
  double slope = 0;  // of g against the direction, > 0
  StandardPoint at;  // where it was taken
  double pull = 0;   // on the next point

  double g_at(const StandardPoint& u) const;
};

struct Linearisations {
  std::vector<Linearisation> kept;  // the newest last

  // Adds that of an answer whose gradient is not 0. An old one is dropped if its direction is within `parallel` (a
  // cosine) of the newest's, or if it lies above the answer by more than `allowance`: where all pieces of a kink must
  // fail g is the largest of them, so it is none.
  void add(const LocalAnswer& local, double parallel, double allowance);

  void keep_newest();

  // One was taken afar if it is farther from the newest than a third of the change of direction (or `within`): then a
  // curved limit state gives such a change too, and no kink.
  bool is_pulled_from_afar(double within) const;
  void forget_afar(double within);

  // The nearest point to the medians that all of them call failed, its pulls noted; older ones are given up where there
  // is none. Of a single one it is the foot of the plane, wherever the medians are.
  StandardPoint next();

  // the cosine between the newest's direction and u
  double alignment(const StandardPoint& u) const;

  // As few of them as hold the nearest point within `tolerance` of u; rather older ones, for at a kink the newest may
  // be of differences across it.
  std::vector<FailedHalfSpace> pieces(const StandardPoint& u, double tolerance) const;
};

}  // namespace voussoir
