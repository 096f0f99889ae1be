// What the page of a report shows, as JSON: the texts of the files of a run, a study, a kinematic analysis or a slice,
// and the title block of the user.
//
//   block     project, section, author, checked_by, date: as stated, or empty
//   of a run
//     results   results.json
//     files     scene (the input in full), history, search, lining:
//               as their files; absent if there is none
//     linings   of each its name and, as stated, thickness_m,
//               compressive_strength_Pa, tensile_strength_Pa
//     every     of history's rows each so many-th is kept
//   of a study
//     study     study.json
//     files     study, manifest: as their files; input: name and text of
//               each file; samples, grids: json and csv of each
//   of a kinematic analysis
//     kinematics  kinematics.json
//     files       pairs: as its file
//   of a slice
//     joints      joints.json (app/report/joints_data.hpp)
#pragma once

#include <filesystem>
#include <string>

namespace voussoir {

struct TitleBlock {
  std::string project, section, author, checked_by, date;
};

// Of the folder of a run that has ended, of a study that was gathered, of a kinematic analysis or of a slice with its
// report. Throws BadInput, with the repair, if it is another folder or a file cannot be read.
std::string report_data(const std::filesystem::path& folder, const TitleBlock& block);

}  // namespace voussoir
