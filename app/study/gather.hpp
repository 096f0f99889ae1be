// The results of a study's runs, from one folder or from several copies of it.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/base/exit_codes.hpp"
#include "app/study/folder.hpp"
#include "app/study/origins.hpp"
#include "app/study/table.hpp"
#include "app/study/warnings.hpp"
#include "app/study/work_options.hpp"

namespace voussoir {

struct Gathered {
  std::vector<StudyRow> rows;
  std::set<int> missing;                 // neither results nor a failure
  std::vector<std::string> differences;  // two different results of a row, a line each
  std::vector<std::string> damaged;      // results that cannot be read, a line each: their rows are missing
  std::vector<RowOrigins> origins;       // of the rows that have results
  std::vector<RowWarning> warnings;      // of these
};

// The first folder's results come first; all contain the same plan. Results that a run did not write
// (app/run_folder/results_hash.hpp) are a BadInput with the row's name.
Gathered gather(const StudyFolder& study, const std::vector<std::filesystem::path>& folders);

// Writes study.csv and prints a summary; `remark` is a line after the first, or empty; `how`: of rows that it draws
// itself, and of reliability analyses.
ExitCode write_gathered(const StudyFolder& study, const Gathered& gathered, const std::string& remark,
                        const WorkOptions& how);

// study.csv of a planned study, from its folder or copies of it
ExitCode study_gather_command(const std::vector<std::filesystem::path>& folders);

// prints the rows that are done and those that are missing
ExitCode study_status_command(const std::filesystem::path& folder);

}  // namespace voussoir
