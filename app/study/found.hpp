// The result of a study's run: the quantity that the plan asks for, and its cost.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/run_folder/results_hash.hpp"
#include "app/study/sweep.hpp"
#include "core/output/origin.hpp"
#include "core/output/results.hpp"

namespace voussoir {

struct RunFound {
  std::optional<Value> result = {};
  std::string status = "ok";  // or the reason why there is no result
  long long contact_evaluations = 0, steps = 0;
  double seconds = 0;
  std::vector<std::string> warnings = {};  // of its results
  std::vector<Origin> origins = {};        // of all processes that computed it; empty if not recorded
};

// reads results.json, and history.csv if the plan takes the quantity from there
RunFound found_in(const std::filesystem::path& folder, const StudyPlan& plan);

// Whether a run has the quantity that the plan asks for: empty if it has, a sentence with the existing names if it has
// not; nothing if the run did not reach its end, so that neither is known.
std::optional<std::string> missing_quantity(const std::filesystem::path& folder, const StudyPlan& plan);

}  // namespace voussoir
