// An error in a file that is read line by line, and its place.
#pragma once

#include <stdexcept>
#include <string>

namespace voussoir {

// `what()` is the reason with its repair. Line and column count from 1, columns in bytes; 0: the file has no lines (a
// binary one), or the fault is that of the entire file or line.
struct FileFault : std::runtime_error {
  FileFault(int where_line, int where_column, const std::string& reason)
      : std::runtime_error(reason), line(where_line), column(where_column) {}
  int line, column;
};

// A note to the user about a file that is read: one line.
struct FileRemark {
  int line = 0;  // 0: of the entire file
  std::string text;
};

}  // namespace voussoir
