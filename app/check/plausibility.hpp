// What follows from a scene's numbers before anything is run: time step, overlap under own weight, steps to expect, and
// what looks wrong. Estimates for people, within a factor of a few.
#pragma once

#include <vector>

#include "app/base/run_scene.hpp"
#include "app/check/forecast.hpp"

namespace voussoir {

const char* text_of(EstimateKind kind);

// whether any stage comes to rest by Newton's method on the joints
bool asks_for_newton(const DampingSettings& damping, const std::vector<StagePlan>& stages);

// The scene's own warnings come first, then those that follow from the numbers.
Plausibility assess(const LoadedScene& scene);

}  // namespace voussoir
