// What a run of a study found: the quantity that the plan asks for, and what it cost.
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
  std::string status = "ok";  // or why there is no result
  long long contact_evaluations = 0, steps = 0;
  double seconds = 0;
  std::vector<std::string> warnings = {};  // of its results
  std::vector<Origin> origins = {};        // of all that computed it; empty where it does not say
};

// reads results.json, and history.csv where the plan takes the quantity from there
RunFound found_in(const std::filesystem::path& folder, const StudyPlan& plan);

// Whether a run has what the plan asks for: empty where it has, a sentence with the names that there are where it has
// not; nothing where the run did not reach its end, so that neither is known.
std::optional<std::string> missing_quantity(const std::filesystem::path& folder, const StudyPlan& plan);

}  // namespace voussoir
