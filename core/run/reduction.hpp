// Strength reduction: the friction angle at which a model loses its equilibrium, or its factor of safety, the divisor
// of tan φ and cohesion of its joints at which it does. Both are called a level here.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/output/results.hpp"
#include "core/run/search_estimates.hpp"
#include "core/run/search_trial.hpp"

namespace voussoir {

struct ReductionReport {
  bool bracketed = false;         // both a stable and a failed level are known; `critical` lies between
  double stable = 0, failed = 0;  // rad or 1: the stable one nearest to failure, the failed one nearest to stability
  double critical = 0;            // same unit
  double error_bar = 0;           // same unit: of the search
  double bracket = 0;             // same unit: half of it; 0 of searches at a rate
  CriticalBy by = CriticalBy::bracket;
  double taken_out = 0;         // same unit: by the extrapolation to no displacement; by the fit, from the bracket
  std::string bracket_because;  // of a result that is the bracket although the plan asks for the required strength
  bool watched = false;         // trials are judged by the strength that their motion requires
  bool turned = false;          // bodies of the last failed trial turned
  std::optional<FollowedTrial> followed{};
  std::string rule;        // the criterion of failure
  std::string message;     // why there is no result, or none within the tolerance; empty: the search is complete
  RunReport last;          // the last run
  double unbalanced = -1;  // the equilibrium measure of the final state; negative if no equilibrium was sought
};

// The last failed trial of a search, beyond the displacement at which it was judged.
enum class FollowLeg {
  none,
  on,      // to ten times that displacement: which blocks move, and how
  to_rest  // for `ReducePlan::follow_steps`
};

// The progress of a search: with it an interrupted one continues as if nothing had happened.
template <int Dim>
struct ReductionProgress {
  int trial = 0;                          // from 0, which is the start at `from`
  double target = 0;                      // level of the trial under way, rad or 1
  double level_from = 0, level_rate = 0;  // start and rate of its change; the rate, 1/s, is positive
  double time_limit = 0;                  // s, constant rate: when the angle reaches `to`
  double stable = 0, failed = 0;          // the bracket so far
  double failed_faster = 0;               // rad, two rates: found at the faster
  double unbalanced = -1;                 // the equilibrium measure of the last stable state
  bool true_motion = false;               // the method of the present round: true motion, or relaxation
  long long trial_steps = 0;              // of the trial up to this round
  bool avoids = false;                    // a bisection has found a level that no trial decides,
  double undecided = 0;                   // this one
  RunProgress<Dim> run;                   // of the trial under way
  std::vector<Vector<Dim>> begin;         // m: displacements when the search began
  std::vector<double> water;              // N: the water's force on each body then; empty without water
  State<Dim> base;                        // the last stable state
  double failed_from = 0;                 // the stable level that the failed one was tried from
  FailureWatch<Dim> watch;                // of the trial under way
  SearchEstimates known;                  // of its trials
  std::vector<Placement<Dim>> begun;      // by body: where they were when the search began
  FollowLeg leg = FollowLeg::none;        // of the last failed trial, beyond its failure
  double failed_way = 0;                  // m: from the stable state to where the failed trial was judged
  long long searched_steps = 0;           // of all trials that have ended
};

// the outcome at a level; called at the end of each trial, and of the leg FollowLeg::on, with its final state
template <int Dim>
using TrialHook = std::function<void(const State<Dim>&, double level, SearchTrial outcome)>;

// Reduces the friction of the plan's joint properties from `from` towards `to`, or increases the factor that divides
// their tan φ and cohesion; a bonded joint then supports cA/F + tan φ/F · Fn, its tensile strength is unchanged. A
// factor is searched by bisection or in steps only: with another method the report's message states this.
//   bisection  every trial starts from the last stable state; ends with a bracket within the tolerance
//   steps      each step runs to equilibrium (thesis, Method B); ends at the first that does not
//   rate       constant rate (Method A); ends when a body has moved by the failure displacement. The angle found is
//              too low by (6 X cos θ r² / ((1-α) g))^(1/3) on a plane of dip θ: the error bar takes cos θ = 1
//   two_rates  the same at two rates from one path of equilibria, the slower starting closer to the failure of the
//   faster. Since the bias
// is proportional to r^(2/3), the two give its size at the slower and the result without it. The error bar is a quarter
// of that correction: the margin of a grid convergence index of known order. The order is not known if the joints
// soften Trials to equilibrium have failed if a body has moved by the failure displacement since the search began, in
// any number of trials: measured from each trial's own start, a slope that yields a little in each would seem the
// stronger the smaller the steps. A reduction at constant rate measures from its start. In a trial that relaxation
// cannot decide, true motion under local damping and relaxation alternate: near the critical angle sliding blocks
// vibrate, and critical damping of the vibration slows the slide, while local damping does not end a slide with nearly
// balanced forces. Afterwards the state is the last stable one (rates: the failed one). If a fraction of the free mass
// must have moved, bodies that have moved that far without reaching it are left behind: equilibrium is that of the
// others. If a trial of a bisection stays undecided, the bracket is closed around its level from both sides; at a
// second such level the search ends, with its present bracket and a message. A search that the hooks interrupted
// (`last.reason`) continues when it is called again with its progress.
template <int Dim>
ReductionReport reduce(const Model<Dim>& model, const Settings& settings, const ReducePlan& plan, State<Dim>& state,
                       ReductionProgress<Dim>& progress, const RunHooks<Dim>& hooks = {},
                       const TrialHook<Dim>& on_trial = {});

}  // namespace voussoir
