#pragma once
// The page of the other engines: verification/others/README.md with its figure, and its tables (results.md).
#include <string>
#include <vector>

#include "reports/links.hpp"

namespace voussoir::reports {

// Pictures that could not be shown are named on the page, and in `missing`.
std::string others_page(const Folders& folders, std::vector<std::string>& missing);

}  // namespace voussoir::reports
