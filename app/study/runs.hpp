// The runs of a study: each in a process and a folder of its own, several at a time, kept for the next time.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/run_folder/run_folder.hpp"

namespace voussoir {

struct StudyRun {
  std::filesystem::path scene;
  std::vector<std::string> overrides;
  std::optional<std::vector<std::string>> limit;  // by `voussoir limit` with these options, not `voussoir run`
  std::vector<std::filesystem::path> files;       // that the scene reads
  std::string name;        // of its folder: tells scene and program apart from all others; equal runs share one
  std::string until = {};  // the stage that it ends with, its end kept; empty: the last
  std::filesystem::path begin = {};  // the folder of the run at whose end it begins; empty: at the start
};

// What to do about a run that another process works at. nobody: there is none, and no lock and no note of a failure is
// kept in the run's folder.
enum class Others { nobody, leave_theirs, wait_for_theirs };

struct RunsOptions {
  std::filesystem::path folder;  // holds a folder for every run
  int jobs = 1;                  // at the same time
  int threads = 1;               // of each run
  double time_limit = 0;         // s of wall clock for each run; 0: none
  bool quiet = false;
  // Asked about the folder of each run that has results, until one is found good: empty for a good one, nothing for one
  // that tells nothing, else why no run is worth its time.
  std::function<std::optional<std::string>(const std::filesystem::path&)> doubt = {};
  Others others = Others::nobody;
  // Whether the results of this folder are kept; otherwise they are removed, and the run is done again.
  std::function<bool(const std::filesystem::path&)> keeps = holds_results;
};

struct RunsEnded {
  std::vector<std::string> failures;  // for every run why it has no results; empty where it has
  std::vector<std::string> holders;   // for every run which other process works at it; empty for none
  int runs = 0, kept = 0;             // different ones, and how many of these were there before
  bool interrupted = false;           // by a signal: what is done is kept, what was going on has a checkpoint
};

// Why the run of this folder has no results, as it was noted last; empty for none.
std::string noted_failure(const std::filesystem::path& folder);
// A note that cannot be written is none: the run then counts as not done.
void note_failure(const std::filesystem::path& folder, const std::string& failure);

// Does what is not done yet. A failure is repeated at the next call, a run that was interrupted continues from its
// checkpoint. Throws BadInput with the doubt about the first run that ended.
RunsEnded carry_out_runs(const std::vector<StudyRun>& runs, const RunsOptions& options);

}  // namespace voussoir
