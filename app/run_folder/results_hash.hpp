// Whether the results of a study's run are those that the run wrote.
#pragma once

#include <filesystem>
#include <string>

namespace voussoir {

inline constexpr std::uintmax_t largest_results = 64 << 20;    // bytes, of results.json
inline constexpr std::uintmax_t largest_history = 2ull << 30;  // of history.csv

// Writes results.json, the last file of a run. If a worker of a study holds the folder, its hash and that of
// history.csv are written before, so that no results lack them. Throws OutputError.
void write_results(const std::filesystem::path& folder, const std::string& results);

// none: there are none. damaged: a file or its hash is missing, truncated or no JSON, so that the run must be done
// again. changed: readable, but different from the file that the run wrote.
enum class ResultsState { none, sound, damaged, changed };

struct CheckedResults {
  ResultsState state = ResultsState::none;
  std::filesystem::path file = {};  // the one that is damaged or changed
};

CheckedResults check_results(const std::filesystem::path& folder, bool with_history);

// "'F/runs/…/results.json' is damaged", "… differs from the file that its run wrote"
std::string describe(const CheckedResults& checked);

}  // namespace voussoir
