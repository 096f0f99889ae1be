// Runs rows of a planned study; other processes may do the same.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/base/exit_codes.hpp"
#include "app/study/folder.hpp"
#include "app/study/work_options.hpp"

namespace voussoir {

// options of a worker of a planned study
struct WorkArguments {
  std::filesystem::path folder;
  std::string rows;          // "120-139,7"; empty: all
  std::string chunk;         // "k/n": that share of them
  bool any_program = false;  // even if another one has planned it
  WorkOptions options = {};
};

// Runs the rows of a planned study: any number of processes may do so, here and on machines that share its folder or
// have a copy of it.
ExitCode study_run_command(const WorkArguments& arguments);

// Executes the rows that are not done, in their order, after the runs they begin with. `plan_name` appears in messages
// about the plan. Throws as carry_out_runs.
RunsEnded work_at(const StudyFolder& study, const std::vector<PlannedRow>& rows, const WorkOptions& how,
                  const std::string& plan_name);

// the exit code of a worker that a signal stopped, with one line for the user
ExitCode tell_interruption(const std::filesystem::path& folder);

// the folder of a row's run
std::filesystem::path run_folder_of(const StudyFolder& study, const PlannedRow& row);

}  // namespace voussoir
