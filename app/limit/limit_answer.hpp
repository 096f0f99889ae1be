// A question of `voussoir limit` and the part of its answer that plane and space share.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/limit/limit_loads.hpp"
#include "core/limit/without_dilation.hpp"
#include "core/output/results.hpp"

namespace voussoir {

// thrown by a hook: the answer is what is known so far
struct StopRounds {};

struct LimitRequest {
  std::optional<LimitLoad> load{};      // whose factor is sought; none: the critical friction under gravity
  std::vector<std::string> properties;  // whose friction is sought, or whose strength is divided; none: all
  bool factor = false;                  // the factor of safety is sought instead
  bool cohesion = false;                // also joints that only a stage bonds have their cohesion
  bool with_dilation = false;           // joints dilate by their friction angle: the bound alone, by one program
  bool decide = false;                  // by runs on elastic joints between and beside the ends
  // may throw StopRounds
  RoundHook after_round = {};                           // without dilation
  std::function<void(const std::string&)> on_run = {};  // of a decision
  bool proof = false;                                   // of a load: its bounds are proved without rounding
};

// Bounds of the load's factor, proved without rounding for joints that dilate; why not, if there is none.
struct ProvedBounds {
  std::optional<double> lower, upper;
  std::string no_lower, no_upper;
  std::string file;  // the proof (limit_proof.hpp); empty if neither is proved
};

// how the answer without dilation was found
struct DilationRounds {
  int rounds = 0;
  bool converged = false;
  bool apart = false;  // between its ends normal forces that the loads do not ask for hold the mechanism's blocks
};

struct LimitAnswer {
  std::string title, input_hash;
  std::string sought;  // "critical friction angle of all joints", "factor of safety of all joints", …
  LimitStatus status = LimitStatus::found;
  bool answered = false;  // a value was found, that no friction is needed included
  bool decided = false;   // by runs on elastic joints
  bool enclosed = false;  // without dilation: both ends of an interval were found
  std::optional<DilationRounds> without_dilation{};
  std::string message;  // the reason and the repair if no value was found, or the meaning of the value; else empty
  std::string flow = "associated flow";  // of the mechanism and the forces
  std::string bound;                     // what the value bounds where joints do not dilate
  std::vector<std::string> caveats;      // limitations of any result, and of this one
  std::vector<std::pair<std::string, Value>> values;
  Evidence evidence;
  std::optional<ProvedBounds> proof;  // if asked for
  std::vector<std::string> warnings;
};

}  // namespace voussoir
