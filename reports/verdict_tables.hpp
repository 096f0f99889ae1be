#pragma once
// The verdicts as HTML: the summary on the front page, and each check with its reason on the page of its case.
#include <string>

#include "verification/verdicts.hpp"

namespace voussoir::reports {

// A coloured word: "passed", "FAILED", "reported", "not run", "not yet modelled".
std::string badge(std::string_view verdict);

// One line per case: state and number of checks of each sort passed.
std::string case_overview(const verification::Verdicts& verdicts);

// All rows, verification, validation, drift and reported numbers in tables of their own; failures without a row first.
std::string all_tables(const verification::Verdicts& verdicts);

// The rows of one case, each with its source and the reason for its tolerance; empty when there are none.
std::string case_tables(const verification::Verdicts& verdicts, const std::string& case_name);

}  // namespace voussoir::reports
