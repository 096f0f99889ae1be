// Rows of a study as `--rows` takes them and `study status` prints them: "120-139,7"; and `--chunk k/n`.
#pragma once

#include <set>
#include <string>

namespace voussoir {

// rows from 1 to `count`; throws BadInput
std::set<int> rows_of_ranges(const std::string& text, int count);

// in rising order; empty for none
std::string ranges_of_rows(const std::set<int>& rows);

// the k-th of n shares, from 1
struct Chunk {
  int place = 1, count = 1;
};

// throws BadInput
Chunk chunk_of(const std::string& text);

}  // namespace voussoir
