// The folder of a study, which can be copied to other machines as a unit.
//
//   study.json       the plan's file, the program, and digests of all planned files
//   manifest.jsonl   one run a line, most expensive first: row of study.csv, hash, scene, overrides, expected cost
//   input/           the plan, its scenes and the files they read, unchanged
//   runs/<hash>/     of each different run (app/run_folder/run_folder.hpp)
//   study.csv        the gathered results; of grids and samples also grid_1.csv, … (findings.hpp)
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/run_folder/claimed_folder.hpp"
#include "app/study/rows.hpp"

namespace voussoir {

struct StudyFolder {
  std::filesystem::path folder;
  StudyPlan plan;
  std::vector<PlannedRow> rows;  // as in the manifest; scenes with their paths, begins by name
  std::string manifest_digest, program, program_digest;
};

// a file of the input and its name below input/
struct InputFile {
  std::filesystem::path from, to;
};

// The files that the plan and its rows read; names below input/ keep their relative places.
std::vector<InputFile> input_files(const std::filesystem::path& plan, const std::vector<PlannedRow>& rows);

// the files that `voussoir study` writes into its folder
Outputs study_outputs(const StudyPlan& plan, const std::vector<InputFile>& input, const std::vector<PlannedRow>& rows);

// Copies the input and writes manifest.jsonl and, last, study.json. Results gathered for another manifest are removed.
// The folder is claimed. Throws OutputError, BadInput.
void write_study_folder(const std::filesystem::path& folder, const StudyPlan& plan, const std::vector<InputFile>& input,
                        std::vector<PlannedRow> rows, const std::string& program_digest);

// Throws BadInput if there is no plan, or if a byte of it has changed.
StudyFolder read_study_folder(const std::filesystem::path& folder);

}  // namespace voussoir
