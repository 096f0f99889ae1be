// `voussoir study` and its parts.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/base/exit_codes.hpp"
#include "app/study/work_options.hpp"

namespace voussoir {

struct StudyArguments {
  std::filesystem::path plan;
  std::filesystem::path out;
  bool overwrite = false;
  WorkOptions options = {};
};

// of a process that works at the rows of a planned study
struct WorkArguments {
  std::filesystem::path folder;
  std::string rows;          // "120-139,7"; empty: all
  std::string chunk;         // "k/n": that share of them
  bool any_program = false;  // though another one has planned it
  WorkOptions options = {};
};

// runs a scene as it is and with one setting changed at a time, in processes side by side; writes study.csv. What was
// done before is kept while scene and program are the same.
ExitCode study_command(const StudyArguments& arguments);

// The same in parts: what is to be run, with its input, into a folder; its rows by any number of processes, here and on
// machines that share the folder or have a copy; study.csv; what is done and what is missing.
ExitCode study_plan_command(const StudyArguments& arguments);

ExitCode study_run_command(const WorkArguments& arguments);

ExitCode study_gather_command(const std::vector<std::filesystem::path>& folders);

ExitCode study_status_command(const std::filesystem::path& folder);

}  // namespace voussoir
