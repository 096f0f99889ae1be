// Works at rows of a planned study, beside others that may do the same.
#pragma once

#include <string>
#include <vector>

#include "app/base/exit_codes.hpp"
#include "app/study/folder.hpp"
#include "app/study/work_options.hpp"

namespace voussoir {

// Does what is not done of these rows, in their order, and first what they begin with. `plan_name` is what a complaint
// about the plan names. Throws as carry_out_runs.
RunsEnded work_at(const StudyFolder& study, const std::vector<PlannedRow>& rows, const WorkOptions& how,
                  const std::string& plan_name);

// the exit code of a worker that a signal stopped, told in one line
ExitCode tell_interruption(const std::filesystem::path& folder);

// the folder of a row's run
std::filesystem::path run_folder_of(const StudyFolder& study, const PlannedRow& row);

}  // namespace voussoir
