// Derivatives of a run's answers by numbers of its scene, without a run for each: beside the run two twins follow for
// each number p, one with p + h and one with p - h. At the end of each increment of Newton's method, where the run has
// motion q, histories h and tangent K, a twin's motion q + x has the same unbalanced forces,
//
//   x += K^-1 (r_twin(q + x) - r(q)),
//
// with the factors of K that serve all twins; then the twin's joints take their own histories. At rest the answer's
// derivative is the twins' difference over 2 h: dq/dp = K^-1 (dr/dp + dr/dh dh/dp), direct differentiation with all
// histories. Near the collapse that a search looks for, K is nearly singular and a twin may have no rest at the run's
// level F. There its level changes by y, and it has come as far as the run along w = K^-1 dr/dF, in the measure D of
// the unknowns (D w . total difference of places = 0):
//
//   r_twin(q + x, F + y) = r(q, F),   y += -D w . (difference + way)/(D w . w),   x += way + y w,   way = K^-1 (...).
//
// With both at the same places before, this is dF/dp = -v . (dr/dp + dr/dh dh/dp)/(v . dr/dF) in the limit, v the left
// null vector of K; but it holds at a distance, too: the level that rest takes at given places depends on p alone, and
// the bordered system is regular.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/run/twin_scenes.hpp"
#include "core/run/watcher.hpp"

namespace voussoir {

struct RunDerivative {
  double value = 0;             // by the number's unit
  double below = 0, above = 0;  // from one side; equal but for the curvature if no contact changes its branch
  double bar = 0;               // estimated from these
  std::string reason{};         // why there is none
};

// How far a stable trial is from collapse: the smallest singular value of its tangent falls with the root of the
// distance to the critical level, the second does not.
struct TangentOfTrial {
  double level = 0;                 // rad or 1
  double smallest = 0, second = 0;  // over the unknowns' scale
};

// Of a search: at its last stable state.
struct CriticalDerivatives {
  double level = 0, critical = 0;      // of that state; that the search found; rad or 1
  double smallest = 0, second = 0;     // singular values of the tangent, over the unknowns' scale
  bool near_collapse = false;          // smallest / second is that of a mechanism, not of a shear spring
  Eigen::VectorXd motion{}, weight{};  // u: the motion with which the collapse begins; v; by degree of freedom
  std::vector<RunDerivative> by{};     // by number; rad or 1 per its unit
  std::vector<TangentOfTrial> way{};   // by stable trial in which a lower strength moves the blocks
};

struct TwinCounters {
  long long increments = 0;          // whose ends were followed
  long long factorisations = 0;      // of tangents
  long long evaluations = 0;         // of residuals, by all twins
  long long back_substitutions = 0;  // likewise
};

struct RunDerivatives {
  std::string reason{};                               // why there are none
  std::vector<double> answers{};                      // at the end of the run
  std::vector<std::vector<RunDerivative>> at_rest{};  // by number, by answer
  std::optional<CriticalDerivatives> critical{};      // of the last stage, if it is a search
  TwinCounters counters{};
  double seconds = 0, seconds_of_run = 0;  // of the twins; of the run
};

// numbers at rest that the forces and motions of a state give
template <int Dim>
using AnswersAtRest = std::function<std::vector<double>(const Prepared<Dim>&, const Model<Dim>&, const State<Dim>&)>;

// Runs the scene, whose progress is that of `simulate` to the bit, with its twins.
template <int Dim>
RunDerivatives run_with_derivatives(const Prepared<Dim>& scene, const std::vector<TwinScenes<Dim>>& numbers,
                                    const AnswersAtRest<Dim>& answers, Progress<Dim>& progress);

}  // namespace voussoir
