// Whether a trial of a search has lost its equilibrium: by the strength that its own motion requires.
//
// Between two looks the bodies move by Δq (translations and turns) and end under the unbalanced loads R. With
//
//   P = Σ R·Δq,   D = Σ N |Δs|  (N: normal force of a contact, Δs: its slip within Δq; joints that are reduced)
//
// the same motion would be in balance at tan φ_req = tan φ + P/D; in a search for a factor F, at
// 1/F_req = (1 + P/D)/F with D = Σ (N tan φ + c A) |Δs|, with the cohesion c of bonds over areas A. In equilibrium P =
// 0. As a trial that fails moves on, the elastic displacement of its joints and bolts is spent, φ_req falls ever more
// slowly and at last in a straight line, by which loads change with the motion. The trial has failed then, and the line
// taken to no displacement is the critical strength (core/NOTES.md has measurements).
#pragma once

#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/run/search_estimates.hpp"

namespace voussoir {

// what a search watches, from its first stable state on
struct WatchPlan {
  Searched searched = Searched::friction;
  std::vector<int> properties;     // those that are reduced, ascending
  std::vector<double> elastic;     // m, by body (core/step/elastic_displacement.hpp); empty: nothing is watched
  std::vector<double> moved_away;  // m, by body: bodies that moved so far have failed, whatever they require
  double tolerance = 0;            // of the search, tan φ or 1/F
};

// tan φ, or 1/F, that the motion up to a displacement required; m, of the body that moved most since the search began
struct RequiredStrength {
  double displacement = 0, strength = 0;
};

// what one trial has shown so far
template <int Dim>
struct TrialWatch {
  std::vector<Placement<Dim>> first, last;  // by body: where the trial began; at the last look
  double bolts = 0;                         // N: forces of bolts on bodies at the last look
  long long bonds = 0;                      // not lost at the begin
  double target = 0;                        // tan φ or 1/F of the trial's level
  int looks = 0;                            // half an elastic displacement, doubled so often, is the next look
  std::vector<RequiredStrength> required;   // at each look
  double elastic = 0;                       // m: of the bodies that move, at the last look
  bool lost = false;                        // equilibrium
  // at the last look: the line is straight; bodies turn; bonds have broken; bolts load up
  bool straight = false, turns = false, broke = false, loads = false;
};

template <int Dim>
struct FailureWatch {
  WatchPlan plan;
  TrialWatch<Dim> trial;
};

// What a trial at a level, rad or a factor, begins with.
template <int Dim>
void begin_watch(const State<Dim>& state, double level, FailureWatch<Dim>& watch);

// Looks at bodies at these places under the loads and contacts that the state has of them; `began`: by body, where the
// search began, m. Does nothing until the bodies have moved far enough for another look.
template <int Dim>
void look(const Model<Dim>& model, const State<Dim>& state, const std::vector<Placement<Dim>>& placed,
          const std::vector<Vector<Dim>>& began, FailureWatch<Dim>& watch);

// The bodies that move: those that have come at least half as far as the one that moved most since the displacements or
// placements `from`; held ones do not count. `values` by body.
struct MovingBodies {
  int body = -1;        // that moved most; -1: none has moved
  double farthest = 0;  // m, its
  double most_of = 0;   // the largest of their values
};
template <int Dim, class From>
MovingBodies moving_bodies(const Model<Dim>& model, const std::vector<From>& from,
                           const std::vector<Placement<Dim>>& placed, const std::vector<double>& values);

// m: of the body that moved most since these displacements
template <int Dim>
double farthest_since(const Model<Dim>& model, const std::vector<Vector<Dim>>& began,
                      const std::vector<Placement<Dim>>& placed);

// Whether the bodies that move have come as far as any of them may: a splinter that rides on blocks fails with them,
// one that moves alone by itself.
template <int Dim>
bool has_failed_by_displacement(const Model<Dim>& model, const std::vector<Vector<Dim>>& began,
                                const std::vector<Placement<Dim>>& placed, const WatchPlan& plan);

// without a stated displacement, bodies that moved by this fraction of their inscribed radius have failed
inline constexpr double failure_fraction_of_radius = 0.1;

// the joint properties whose strength a plan reduces: indices in Model::properties, ascending
template <int Dim>
std::vector<int> chosen_properties(const Model<Dim>& model, const ReducePlan& plan);

// m: the displacement at which a block has failed: as the plan states, or a tenth of the smallest inscribed radius, or
// the longest slip over which the strength of a joint's law changes, if that is more: before it the law may still gain
// what holds the block
template <int Dim>
double failure_displacement_of(const Model<Dim>& model, const ReducePlan& plan);

// Why a search of this kind is not judged by the strength that its motion requires, as a clause; empty: it is.
template <int Dim>
std::string not_watched(const Model<Dim>& model, const ReducePlan& plan, const SupportsState<Dim>& supports);

// What a search watches from its first stable state on; nothing (WatchPlan::elastic is empty) if the plan asks for
// displacement, or the search is of a kind that is not watched.
template <int Dim>
WatchPlan watch_plan(const Model<Dim>& model, const Settings& settings, const ReducePlan& plan, const Levels& levels,
                     const State<Dim>& stable);

// What a trial at a strength that has ended tells of the critical one. `began`: by body, where the search began, m.
template <int Dim>
void note_stable_trial(const Model<Dim>& model, const State<Dim>& state, const std::vector<Vector<Dim>>& began,
                       const WatchPlan& plan, double strength, SearchEstimates& known);
template <int Dim>
void note_failed_trial(const TrialWatch<Dim>& trial, double strength, SearchEstimates& known);

}  // namespace voussoir
