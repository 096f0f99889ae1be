// The warnings of a study's runs, by row.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace voussoir {

// warnings that differ only in their numbers: the text of the first such row, and all rows that have one
struct RowWarning {
  std::string text, kind;
  bool same = true;  // in all these rows
  std::set<int> rows;
};

void add_row(std::vector<RowWarning>& all, int row, const std::vector<std::string>& warnings);

// a line each, which names the rows; of many kinds the first ones
std::vector<std::string> warning_lines(const std::vector<RowWarning>& all);

}  // namespace voussoir
