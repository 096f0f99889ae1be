#pragma once
// The page "What accuracy costs": the studies of all cases beside each other.
#include <string>
#include <vector>

#include "reports/case_page.hpp"

namespace voussoir::reports {

// What could not be shown is named on the page, and in `missing`, one sentence each.
std::string trade_page(const Folders& folders, std::vector<std::string>& missing);

}  // namespace voussoir::reports
