// The runs of a study: each in its own process and folder, several at a time, kept for later calls.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/run_folder/run_folder.hpp"
#include "app/study/sweep.hpp"

namespace voussoir {

struct StudyRun {
  std::filesystem::path scene;
  std::vector<std::string> overrides;
  std::optional<OtherCommand> other;         // instead of `voussoir run`
  std::vector<std::filesystem::path> files;  // that the scene reads
  std::string name;                          // of its folder: identifies scene and program; equal runs share one
  std::string until = {};                    // the stage after which it ends, with its state kept; empty: the last
  std::filesystem::path begin = {};          // the folder of the run at whose end it begins; empty: none
};

// Treatment of a run that another process works at. nobody: there is no other process, and the run's folder has neither
// a lock nor a record of failure.
enum class Others { nobody, leave_theirs, wait_for_theirs };

struct RunsOptions {
  std::filesystem::path folder;  // contains a folder for every run
  int jobs = 1;                  // at the same time
  int threads = 1;               // of each run
  double time_limit = 0;         // s of wall clock for each run; 0: none
  bool quiet = false;
  // Called for the folder of each run that has results, until one is valid: empty for a valid one, nothing for an
  // undecided one, else the reason why no run is worth its time.
  std::function<std::optional<std::string>(const std::filesystem::path&)> doubt = {};
  Others others = Others::nobody;
  // Whether the results of this folder are kept; otherwise they are removed, and the run is done again.
  std::function<bool(const std::filesystem::path&)> keeps = holds_results;
};

struct RunsEnded {
  std::vector<std::string> failures;  // for every run the reason if it has no results; else empty
  std::vector<std::string> holders;   // for every run the other process that works at it; empty for none
  int runs = 0, kept = 0;             // number of different runs, and of those that existed before
  bool interrupted = false;           // by a signal: completed runs are kept, active ones have a checkpoint
};

// The recorded reason why the run of this folder has no results; empty for none.
std::string noted_failure(const std::filesystem::path& folder);
// If the reason cannot be recorded, the run counts as not done.
void note_failure(const std::filesystem::path& folder, const std::string& failure);

// Executes the runs that are not done. A failed run is repeated at the next call, an interrupted one continues from its
// checkpoint. Throws BadInput with the doubt about the first run that ended.
RunsEnded carry_out_runs(const std::vector<StudyRun>& runs, const RunsOptions& options);

}  // namespace voussoir
