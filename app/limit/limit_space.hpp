// Limit analysis of a scene in space: from the loaded scene to values and messages, without files.
#pragma once

#include "app/base/run_scene.hpp"
#include "app/limit/limit_answer.hpp"
#include "core/limit/limit_in_space.hpp"

namespace voussoir {

struct BlockMotionInSpace {
  int body = 0;
  double speed = 0, turning = 0;  // of the centroid, and of the farthest corner about it: MotionInSpace
};

struct LimitAnalysisInSpace : LimitAnswer {
  std::string bound;  // what the value bounds where joints do not dilate
  Model<3> model;
  CornerAssembly assembly;
  LimitStateInSpace state;
  std::vector<BlockMotionInSpace> moving;  // faster than 1e-6 of the fastest, by body
  int turning = 0;                         // of them
};

// Of a scene in space. Throws BadInput if there is nothing to analyse: no free block, no gravity, no applied force, an
// unknown name.
LimitAnalysisInSpace analyse_limit_in_space(const LoadedScene& scene, const LimitRequest& request = {});

}  // namespace voussoir
