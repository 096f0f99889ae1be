// The programs, and the functions of the C library, that computed the rows of a study.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/output/origin.hpp"

namespace voussoir {

// rows that have the same origins
struct RowOrigins {
  std::vector<Origin> origins;  // empty: not recorded in their results
  std::set<int> rows;
};

void add_row(std::vector<RowOrigins>& all, int row, const std::vector<Origin>& origins);

// a line for each; `planned_by` is the hash of the program that planned the study
std::vector<std::string> origin_lines(const std::vector<RowOrigins>& all, const std::string& planned_by);

// reasons why rows may differ in more than the keys that the study varies, a line each
std::vector<std::string> origin_warnings(const std::vector<RowOrigins>& all);

}  // namespace voussoir
