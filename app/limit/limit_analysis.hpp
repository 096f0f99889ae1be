// Limit analysis of a scene in the plane: from the loaded scene to values and messages, without files. Cases call it.
#pragma once

#include "app/base/run_scene.hpp"
#include "app/limit/limit_answer.hpp"
#include "core/limit/mechanism.hpp"

namespace voussoir {

struct LimitAnalysis : LimitAnswer {
  Model<2> model;
  Loads water;  // by body, at full gravity; none of a scene without water
  std::vector<Interface> interfaces;
  LimitState state;
  Mechanism mechanism;
};

// Of a scene in the plane. Throws BadInput if there is nothing to analyse: no free block, no gravity, no applied force,
// an unknown name.
LimitAnalysis analyse_limit(const LoadedScene& scene, const LimitRequest& request = {});

}  // namespace voussoir
