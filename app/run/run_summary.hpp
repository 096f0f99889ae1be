// The summary that `voussoir run` and `resume` print at the end.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/output/monitor.hpp"
#include "core/output/results_json.hpp"

namespace voussoir {

// The values that are forces or moments per metre of thickness: in the plane those of all monitors but bolts, whose
// forces are those of one bolt.
template <int Dim>
std::set<std::string> forces_per_metre(const std::vector<Monitor>& monitors);

// `rounds`: results that were found, of which the last one is printed; `per_metre`: forces_per_metre
void print_summary(const std::string& title, const Results& results, const std::vector<AccuracyRound>& rounds,
                   const std::set<std::string>& per_metre, const std::filesystem::path& folder);

}  // namespace voussoir
