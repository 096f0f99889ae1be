// `[accuracy] error = "1 %"`: a result whose error bar is wider is found again with the largest contributions of its
// budget refined, until its bar is within the request, or nothing is left to refine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/base/run_scene.hpp"
#include "core/scene/accuracy_target.hpp"

namespace voussoir {

// greatest number of rounds
inline constexpr int most_rounds = 5;

std::optional<AccuracyTarget> wanted_accuracy(const LoadedScene& scene);

// Whether a search bracket by itself exceeds the target, so that a budget would be wasted.
bool brackets_too_wide(const LoadedScene& scene, const AccuracyTarget& target, const Results& results);

// The settings to refine in `scene`, whose results are `results`, and a summary for the user; nothing if every bar is
// within the target, or if nothing can be refined: then the results report it.
struct Refinement {
  std::vector<std::string> overrides;
  std::string summary;  // "normal stiffness 8 times, tolerance a third"
  double cost = 1;      // of a result, over the last one's: an estimate
};
std::optional<Refinement> refinement(const LoadedScene& scene, const AccuracyTarget& target, int rounds,
                                     Results& results);

}  // namespace voussoir
