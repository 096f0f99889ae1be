// Whether the results of a study's run are what the run wrote.
#pragma once

#include <filesystem>
#include <string>

namespace voussoir {

inline constexpr std::uintmax_t largest_results = 64 << 20;    // bytes, of results.json
inline constexpr std::uintmax_t largest_history = 2ull << 30;  // of history.csv

// Writes results.json, the last file of a run. Where a worker of a study holds the folder, its hash and that of
// history.csv are written before, so that no results are without. Throws OutputError.
void write_results(const std::filesystem::path& folder, const std::string& results);

// none: there are none. damaged: a file is missing, cut or no JSON, or the hashes are, so that the run is to be done
// again. changed: readable, but not what the run wrote.
enum class ResultsState { none, sound, damaged, changed };

struct CheckedResults {
  ResultsState state = ResultsState::none;
  std::filesystem::path file = {};  // the one that is damaged or changed
};

CheckedResults check_results(const std::filesystem::path& folder, bool with_history);

// "'F/runs/…/results.json' is damaged", "… is not what its run wrote"
std::string describe(const CheckedResults& checked);

}  // namespace voussoir
