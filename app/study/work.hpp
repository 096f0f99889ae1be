// Works at rows of a planned study, beside others that may do the same.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/base/exit_codes.hpp"
#include "app/study/folder.hpp"
#include "app/study/work_options.hpp"

namespace voussoir {

// of a process that works at the rows of a planned study
struct WorkArguments {
  std::filesystem::path folder;
  std::string rows;          // "120-139,7"; empty: all
  std::string chunk;         // "k/n": that share of them
  bool any_program = false;  // though another one has planned it
  WorkOptions options = {};
};

// Works at the rows of a planned study: any number of processes may, here and on machines that share its folder or have
// a copy of it.
ExitCode study_run_command(const WorkArguments& arguments);

// Does what is not done of these rows, in their order, and first what they begin with. `plan_name` is what a complaint
// about the plan names. Throws as carry_out_runs.
RunsEnded work_at(const StudyFolder& study, const std::vector<PlannedRow>& rows, const WorkOptions& how,
                  const std::string& plan_name);

// the exit code of a worker that a signal stopped, told in one line
ExitCode tell_interruption(const std::filesystem::path& folder);

// the folder of a row's run
std::filesystem::path run_folder_of(const StudyFolder& study, const PlannedRow& row);

}  // namespace voussoir
