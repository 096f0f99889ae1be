// Repeats steps until equilibrium, end time or failure; reports why it stopped.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/run/failure_watch.hpp"

namespace voussoir {

enum class StopReason {
  equilibrium,
  end_time,
  lost_equilibrium,  // of a trial of a search: the strength that its motion requires says so
  moved_away,
  step_limit,
  time_limit,
  no_contact_answer,
  not_finite,
  falls_free,    // a body that nothing can catch: there is no equilibrium
  lining_loose,  // nothing exerts a force, and a lining has left its rock: unbalanced forces have no reference
  interrupted    // the hooks asked for a pause: the run continues when it is called again
};

// the goal of a run; unstated members do not stop it
struct RunGoal {
  bool rest = false;  // stop at equilibrium
  // s: simulated time at which the run is complete: its equal steps end there
  std::optional<double> end_time = {};
  std::optional<double> time_limit = {};     // s: simulated time at which the run gives up
  std::optional<long long> step_limit = {};  // of this run
  std::optional<double> moved_away = {};     // m: stop when a free body is this far from RunProgress::begin
  double moved_fraction = 0;                 // or when bodies of this fraction of the free mass are; 0: any body
  bool bonds = false;                        // joints are to be bonded when they are first compressed
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
  std::string detail;     // the contact or body of a failure, or of a missing equilibrium
  std::string unreached;  // "; not reached: …": parts of schedule and equilibrium that a limit of steps or time
                          // prevented; or empty
  long long steps = 0;
  double unbalanced = 0;  // the equilibrium measure at the end
};

// The progress of a run: with it an interrupted run continues as if nothing had happened.
template <int Dim>
struct RunProgress {
  bool under_way = false;
  long long steps = 0;
  int at_rest = 0;            // steps in a row
  long long unconverged = 0;  // Counters::unconverged at the start
  std::vector<Vector<Dim>>
      begin;  // m: displacements from which `moved_away` is measured; those at the start, or set before by the caller
};

// Callbacks; each may be empty. Neither can change the run.
template <int Dim>
struct RunHooks {
  // within every step, when its forces are found and its bodies not yet moved: everything is at one time except
  // velocities, which are half a step earlier
  std::function<void(const State<Dim>&)> with_forces;
  // after every step, with the equilibrium measure (negative if the goal needs none)
  std::function<void(const State<Dim>&, double unbalanced)> after_step;
  // before every step, when state and progress contain everything that the next steps need; true stops the run
  std::function<bool()> pause;
};

// Begins, or continues if `progress` is under way; the goal and the schedule must then be the same. A watch
// ends the run when it finds that equilibrium is lost.
template <int Dim>
RunReport run(const Model<Dim>& model, const Settings& settings, const RunGoal& goal, const RunSchedule& schedule,
              State<Dim>& state, RunProgress<Dim>& progress, const RunHooks<Dim>& hooks = {},
              FailureWatch<Dim>* watch = nullptr);

// from the start, without hooks
template <int Dim>
RunReport run(const Model<Dim>& model, const Settings& settings, const RunGoal& goal, const RunSchedule& schedule,
              State<Dim>& state) {
  RunProgress<Dim> progress;
  return run(model, settings, goal, schedule, state, progress);
}

// where the bodies are; while the static solver is at work, at the last trial that it accepted
template <int Dim>
void note_accepted(const Model<Dim>& model, const State<Dim>& state, std::vector<Placement<Dim>>& placed);

// a sentence for messages
std::string describe(StopReason reason);

// the name of a body in messages: "body 3 (left)"
template <int Dim>
std::string label_of(const Model<Dim>& model, int body);

}  // namespace voussoir
