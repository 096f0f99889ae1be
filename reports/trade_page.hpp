#pragma once
// Pages that compare all cases: "Cost of accuracy", of their studies, and "All checks at a glance".
#include <string>
#include <vector>

#include "reports/case_page.hpp"

namespace voussoir::reports {

// Parts that could not be shown are named on the page, and in `missing`, one sentence each.
std::string trade_page(const Folders& folders, std::vector<std::string>& missing);
std::string checks_page(const Folders& folders, std::vector<std::string>& missing);

}  // namespace voussoir::reports
