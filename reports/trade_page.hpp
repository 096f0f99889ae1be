#pragma once
// Pages that set all cases beside each other: "What accuracy costs", of their studies, and "All checks at one look".
#include <string>
#include <vector>

#include "reports/case_page.hpp"

namespace voussoir::reports {

// What could not be shown is named on the page, and in `missing`, one sentence each.
std::string trade_page(const Folders& folders, std::vector<std::string>& missing);
std::string checks_page(const Folders& folders, std::vector<std::string>& missing);

}  // namespace voussoir::reports
