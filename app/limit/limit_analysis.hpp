// Limit analysis of a scene: from the loaded scene to values and messages, without files. Cases call it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/base/run_scene.hpp"
#include "core/limit/mechanism.hpp"
#include "core/output/results.hpp"

namespace voussoir {

enum class LimitLoad { gravity, left, right, applied };

struct LimitRequest {
  std::optional<LimitLoad> load;        // whose factor is sought; none: the critical friction under gravity
  std::vector<std::string> properties;  // whose friction is sought, or whose strength is divided; none: all
  bool factor = false;                  // the factor of safety is sought instead
  bool cohesion = false;                // also joints that only a stage bonds have their cohesion
};

struct LimitAnalysis {
  std::string title, input_hash;
  Model<2> model;
  Loads water;  // by body, at full gravity; none of a scene without water
  std::vector<Interface> interfaces;
  std::string sought;  // "critical friction angle of all joints", "factor of safety of all joints", …
  LimitStatus status = LimitStatus::found;
  bool answered = false;  // a value was found, that no friction is needed included
  std::string message;    // the reason and the repair if no value was found, or the meaning of the value; else empty
  std::vector<std::string> caveats;  // limitations of any result, and of this one
  std::vector<std::pair<std::string, Value>> values;
  LimitState state;
  Evidence evidence;
  Mechanism mechanism;
  std::vector<std::string> warnings;
};

// Throws BadInput if there is nothing to analyse: a scene in space, no free block, no gravity, no applied force, an
// unknown name.
LimitAnalysis analyse_limit(const LoadedScene& scene, const LimitRequest& request = {});

}  // namespace voussoir
