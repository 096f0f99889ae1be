#pragma once
// The verdicts as HTML: the summary on the front page, and each check with its reason on the page of its case.
#include <string>
#include <vector>

#include "verification/verdicts.hpp"

namespace voussoir::reports {

// A coloured word: "passed", "FAILED", "reported", "not run", "not yet modelled".
std::string badge(std::string_view verdict);

// One line per case, all or some of them: state and number of checks of each sort passed.
std::string case_overview(const verification::Verdicts& verdicts, const std::vector<std::string>& cases);

// All rows of some cases, verification, validation, drift and reported numbers in tables of their own; failures without
// a row first.
std::string tables_of(const verification::Verdicts& verdicts, const std::vector<std::string>& cases);

// The first judged rows of one case, values beside those of the reference; empty when there are none.
std::string answer_table(const verification::Verdicts& verdicts, const std::string& case_name);

// The rows of one case, each with its source and the reason for its tolerance; empty when there are none.
std::string case_tables(const verification::Verdicts& verdicts, const std::string& case_name);

}  // namespace voussoir::reports
