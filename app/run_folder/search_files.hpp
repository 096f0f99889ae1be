// The trials of a run's searches as a table (core/output/search_csv.hpp) and as a picture: strength against
// displacement, as users of 3DEC and UDEC look for the knee.
#pragma once

#include <filesystem>
#include <string>

#include "core/output/results.hpp"

namespace voussoir {

inline constexpr const char *search_table = "search.csv", *search_picture = "search.svg";

// A point for each trial: its strength over the largest displacement since the search began, on a logarithmic scale.
// Trials that moved less than a millionth of the farthest are left out. Empty without points.
std::string search_svg(const std::vector<TrialRow>& trials);

// nothing without trials; throws OutputError
void write_search(const std::filesystem::path& folder, const Results& results);

}  // namespace voussoir
