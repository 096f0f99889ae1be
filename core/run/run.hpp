// Repeat step until equilibrium, end time or failure; say why it stopped.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

enum class StopReason {
  equilibrium,
  end_time,
  moved_away,
  step_limit,
  time_limit,
  no_contact_answer,
  not_finite,
  falls_free,    // a body that nothing can catch: there will be no rest
  lining_loose,  // nothing exerts a force, and a lining has left its rock: there is nothing to measure rest against
  interrupted    // the hooks asked for a pause: the run continues when it is called again
};

// what a run aims at; anything left out does not stop it
struct RunGoal {
  bool rest = false;  // stop at equilibrium
  // s: simulated time at which the run is complete: its steps, as long as each other, end there
  std::optional<double> end_time = {};
  std::optional<double> time_limit = {};     // s: simulated time at which it is given up
  std::optional<long long> step_limit = {};  // of this run
  std::optional<double> moved_away = {};     // m: stop when a free body is this far from RunProgress::begin
  double moved_fraction = 0;                 // or when bodies of this fraction of the free mass are; 0: any body
};

// values that change while the run continues, from State::schedule.started
struct RunSchedule {
  GravityPlan gravity{};
  Searched searched = Searched::friction;
  double strength_rate = 0;                   // 1/s: the friction of `properties` falls, or their factor grows
  double strength_from = 0, strength_to = 0;  // rad, or 1
  std::vector<int> properties{};
  std::vector<WaterPlan> water{};
  std::optional<ExcavationForcesPlan> excavation_forces{};
};

struct RunReport {
  StopReason reason = StopReason::step_limit;
  std::string detail;     // which contact or body, for failures and where rest was not found
  std::string unreached;  // "; not reached: …": what of schedule and rest a limit of steps or time cut off; or empty
  long long steps = 0;
  double unbalanced = 0;  // the equilibrium measure at the end
};

// How far a run has come: with it an interrupted run continues as if nothing had happened.
template <int Dim>
struct RunProgress {
  bool under_way = false;
  long long steps = 0;
  int at_rest = 0;                 // steps in a row
  long long unconverged = 0;       // Counters::unconverged at the begin
  std::vector<Vector<Dim>> begin;  // m: displacements that `moved_away` counts from; those at the begin, or stated
                                   // before it by the caller
};

// Callbacks; each may be empty. Neither can change the run.
template <int Dim>
struct RunHooks {
  // within every step, when its forces are found and its bodies not yet moved: all is of one time but velocities, which
  // stand half a step before
  std::function<void(const State<Dim>&)> with_forces;
  // after every step, with the equilibrium measure (negative when the goal needs none)
  std::function<void(const State<Dim>&, double unbalanced)> after_step;
  // before every step, when everything that the next steps need lies in state and progress; true stops the run
  std::function<bool()> pause;
};

// Begins, or continues where `progress` says it is under way; the goal and the schedule must then be the same.
template <int Dim>
RunReport run(const Model<Dim>& model, const Settings& settings, const RunGoal& goal, const RunSchedule& schedule,
              State<Dim>& state, RunProgress<Dim>& progress, const RunHooks<Dim>& hooks = {});

// from the begin, without hooks
template <int Dim>
RunReport run(const Model<Dim>& model, const Settings& settings, const RunGoal& goal, const RunSchedule& schedule,
              State<Dim>& state) {
  RunProgress<Dim> progress;
  return run(model, settings, goal, schedule, state, progress);
}

// a sentence for people
std::string describe(StopReason reason);

// how messages name a body: "body 3 (left)"
template <int Dim>
std::string label_of(const Model<Dim>& model, int body);

}  // namespace voussoir
