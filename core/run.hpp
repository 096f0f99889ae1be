// Repeat step until equilibrium, end time or failure; say why it stopped.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/model.hpp"
#include "core/settings.hpp"
#include "core/state.hpp"

namespace voussoir {

enum class StopReason { equilibrium, end_time, moved_away, step_limit, time_limit, no_contact_answer, not_finite };

// what a run aims at; anything left out does not stop it
struct RunGoal {
  bool rest = false;          // stop at equilibrium
  double end_time = 1e300;    // s: simulated time at which the run is complete
  double time_limit = 1e300;  // s: simulated time at which it is given up
  long long step_limit = 0;   // of this run; 0: none
  double moved_away = 0;      // m: stop when a free body is this far from where it began; 0: never
};

// values that change while the run goes on, from State::schedule.started
struct RunSchedule {
  double gravity_ramp = 0;   // s: gravity grows from 0 to full
  double friction_rate = 0;  // rad/s: friction of `properties` falls from `friction_from` to `friction_to`
  double friction_from = 0, friction_to = 0;  // rad
  std::vector<int> properties;
};

struct RunReport {
  StopReason reason = StopReason::step_limit;
  std::string detail;  // which contact or body, for failures
  long long steps = 0;
  double unbalanced = 0;  // the equilibrium measure at the end
};

// called after every step with the state and the equilibrium measure (negative when the goal needs none)
template <int Dim>
using StepHook = std::function<void(const State<Dim>&, double unbalanced)>;

template <int Dim>
RunReport run(const Model<Dim>& model, const Settings& settings, const RunGoal& goal, const RunSchedule& schedule,
              State<Dim>& state, const StepHook<Dim>& hook = {});

// a sentence for people
std::string describe(StopReason reason);

}  // namespace voussoir
