// Limit analysis of a scene: from the loaded scene to values and messages, without files. Cases call it.
#pragma once

#include "app/base/run_scene.hpp"
#include "app/limit/limit_answer.hpp"
#include "core/limit/mechanism.hpp"

namespace voussoir {

template <int Dim>
struct LimitAnalysis : LimitAnswer {
  Model<Dim> model;
  CornerAssembly<Dim> assembly;
  LimitState<Dim> state;
  Mechanism<Dim> mechanism;
};

// Throws BadInput if there is nothing to analyse: no free block, no gravity, no applied force, an unknown name.
template <int Dim>
LimitAnalysis<Dim> analyse_limit(const LoadedScene& scene, const LimitRequest& request = {});

}  // namespace voussoir
