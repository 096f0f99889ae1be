// The trials of a run's searches as a table (core/output/search_csv.hpp).
#pragma once

#include <filesystem>

#include "core/output/results.hpp"

namespace voussoir {

inline constexpr const char* search_table = "search.csv";

// nothing without trials; throws OutputError
void write_search(const std::filesystem::path& folder, const Results& results);

}  // namespace voussoir
