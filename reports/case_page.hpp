#pragma once
// The page of one case: parameters, question, blocks, values against the reference, the rest of its README.md, the
// checks of the last run, its figures, its study, its scenes and its NOTES.md.
#include <string>
#include <vector>

#include "reports/links.hpp"
#include "verification/verdicts.hpp"

namespace voussoir::reports {

// Parts that could not be shown are named on the page, and in `missing`, one sentence each.
std::string case_page(const Folders& folders, const verification::Verdicts& verdicts,
                      const verification::CaseStatus& status, std::vector<std::string>& missing);

// The title of the case's README.md, or its name.
std::string case_title(const Folders& folders, const std::string& case_name);

}  // namespace voussoir::reports
