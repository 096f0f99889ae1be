// `[accuracy] error = "1 %"`: an answer whose error bar is wider is found again with what matters most in its budget
// finer, until its bar is within what was asked, or nothing is left that could be refined.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/base/run_scene.hpp"
#include "core/scene/accuracy_target.hpp"

namespace voussoir {

// an answer is found so often at most
inline constexpr int most_rounds = 5;

std::optional<AccuracyTarget> wanted_accuracy(const LoadedScene& scene);

// Whether a bracket alone is so wide that a budget would be wasted on it.
bool brackets_too_wide(const LoadedScene& scene, const AccuracyTarget& target, const Results& results);

// What to make finer than in `scene`, of which `results` are the answer, and what a user reads of it; nothing where
// every bar is within the target, or nothing can be refined: then the results say so.
struct Refinement {
  std::vector<std::string> overrides;
  std::string summary;  // "normal stiffness 8 times, tolerance a third"
  double cost = 1;      // of an answer, over the last one's: an estimate
};
std::optional<Refinement> refinement(const LoadedScene& scene, const AccuracyTarget& target, int rounds,
                                     Results& results);

}  // namespace voussoir
