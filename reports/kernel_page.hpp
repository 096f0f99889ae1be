#pragma once
// The page on the contact kernel's speed: contact_kernel.md, its figures, and the tables of the last benchmark.
#include <string>
#include <vector>

#include "reports/links.hpp"

namespace voussoir::reports {

// Parts that could not be shown are named on the page, and in `missing`, one sentence each.
std::string kernel_page(const Folders& folders, std::vector<std::string>& missing);

}  // namespace voussoir::reports
