// `[accuracy] error = "1 %"`: a result whose error bar is wider is found again with the largest contributions of its
// budget refined, until its bar is within the request, or nothing is left to refine.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/base/run_scene.hpp"
#include "core/output/results_json.hpp"
#include "core/scene/accuracy_target.hpp"

namespace voussoir {

// greatest number of rounds
inline constexpr int most_rounds = 5;

std::optional<AccuracyTarget> wanted_accuracy(const LoadedScene& scene);

// Whether a search bracket by itself exceeds the target, so that a budget would be wasted.
bool brackets_too_wide(const LoadedScene& scene, const AccuracyTarget& target, const Results& results);

// The settings to refine in `scene`, whose results are `results`, and a summary for the user; nothing if every bar is
// within the target, or if nothing can be refined, or a part was refined in vain: then the results report it. `rounds`:
// those before. A bar that is wider than in one of them is explained in the results' warnings.
struct Refinement {
  std::vector<std::string> overrides;
  std::string summary;  // "normal stiffness 8 times, tolerance a third"
  double cost = 1;      // of a result, over the last one's: an estimate
};
std::optional<Refinement> refinement(const LoadedScene& scene, const AccuracyTarget& target,
                                     const std::vector<AccuracyRound>& rounds, Results& results);

// AccuracyRound::parts of results with a budget
std::map<std::string, double> parts_of_bars(const LoadedScene& scene, const Results& results);

}  // namespace voussoir
