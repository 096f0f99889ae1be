// The summary that `voussoir run` and `resume` print at the end.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/output/results_json.hpp"

namespace voussoir {

// `rounds`: results that were found, of which the last one is printed
void print_summary(const std::string& title, const Results& results, const std::vector<AccuracyRound>& rounds,
                   const std::filesystem::path& folder);

}  // namespace voussoir
