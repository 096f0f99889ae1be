#pragma once
// The page of the other engines: verification/others/README.md with its figure, and its tables (results.md).
#include <string>

#include "reports/case_page.hpp"

namespace voussoir::reports {

std::string others_page(const Folders& folders);

}  // namespace voussoir::reports
